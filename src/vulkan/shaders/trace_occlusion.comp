// Whether given rays are blocked: 1 or 0.
// variants: tracers
#include "rays.glsl"
#include "scene_set.glsl"

layout(push_constant, scalar) uniform Push {
    RaysPush push;
};

void main() {
    const uint index = globalIndex();
    if (index >= push.count) return;
    useSceneOnly();
    Uints(push.results).at[index] = occluded(Rays(push.rays).at[index]) ? 1u : 0u;
}

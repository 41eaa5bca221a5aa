// Closest hits of given rays.
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
    Hits(push.hits).at[index] = closestHit(Rays(push.rays).at[index]);
}

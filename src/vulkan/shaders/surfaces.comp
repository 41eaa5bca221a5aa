// Surfaces at given hits; entries of rays that missed are not written.
// variants: tracers
#include "rays.glsl"
#include "scene_set.glsl"

layout(push_constant, scalar) uniform Push {
    RaysPush push;
};
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Surfaces {
    GpuSurface at[];
};

void main() {
    const uint index = globalIndex();
    if (index >= push.count) return;
    const Hit hit = Hits(push.hits).at[index];
    if (hit.primitive < 0) return;
    useSceneOnly();
    const Surface s = surfaceAt(Rays(push.rays).at[index], hit, push.spread);
    Surfaces(push.results).at[index] =
        GpuSurface(s.position, s.geometricNormal, s.shadingNormal, s.albedo, s.emission, s.metallic, s.roughness,
                   s.material, s.backface ? kSideBackface : (s.back ? kSideBack : kSideFront));
}

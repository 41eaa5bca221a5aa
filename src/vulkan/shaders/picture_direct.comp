// Punctual lights on the samples of a picture, with shadow rays, the whole material and not only its Lambert part.
// variants: tracers
#include "direct_light.glsl"
#include "picture.glsl"

#include "kernels/shade/bsdf.h"

layout(push_constant, scalar) uniform Push {
    PicturePush push;
};

void main() {
    const uint index = globalIndex();
    if (index >= push.sampleCount) return;
    const ScreenSample s = Samples(push.samples).at[index];
    if (s.kind != kSampleSurface) return;
    useLighting(push.lighting);
    const Surface surface = sampleSurface(s);
    const mat3 frame = orthonormalBasis(surface.shadingNormal);
    const Bsdf bsdf =
        makeBsdf(surface.albedo, surface.metallic, surface.roughness, (push.flags & kPictureDiffuseOnly) != 0);
    const vec3 toViewer = toLocal(frame, -s.viewDirection);
    vec3 direct = s.direct;
    for (int i = 0; i < PROBEGI_SCENE.lightCount; ++i) {
        const LightSample light = lightSampleAt(i, surface.position);
        const vec3 e = visibleLight(surface, light);
        if (e != vec3(0.0)) direct += e * evalBsdf(bsdf, toViewer, toLocal(frame, light.toLight));
    }
    Samples(push.samples).at[index].direct = direct;
}

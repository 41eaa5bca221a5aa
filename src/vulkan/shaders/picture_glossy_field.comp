// The field around mirror directions, as radiance: at samples that are too rough for rays, and at what the rays hit.
#include "picture_glossy.glsl"
#include "volume.glsl"

layout(push_constant, scalar) uniform Push {
    PicturePush push;
};

vec3 reflected(ScreenSample s) {
    return radianceOfIrradiance(probegiIrradiance(s.position, mirrorOf(s), s.shadingNormal));
}

void main() {
    const uint index = globalIndex();
    if (index >= push.sampleCount) return;
    const ScreenSample s = Samples(push.samples).at[index];
    if (s.kind == kSampleSurface && glossyRayShare(s.roughness) < 1.0) glossyLobes(push).at[index] = reflected(s);
    // There are no more blocks than samples.
    if ((push.flags & kPictureSecondGlossy) == 0 || index >= glossyCount(push)) return;
    const ScreenSample hit = glossyHits(push).at[index];
    if (hit.kind == kSampleSurface) glossySamples(push).at[index].radiance = reflected(hit);
}

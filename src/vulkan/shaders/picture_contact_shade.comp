// Contact light to the samples.
#include "picture_contact.glsl"

void main() {
    const uint index = globalIndex();
    if (index >= push.sampleCount) return;
    const ScreenSample s = Samples(push.samples).at[index];
    if (s.kind != kSampleSurface) return;
    Samples(push.samples).at[index].irradiance = withContact(s.irradiance, Vec4s(contactBlock().kept).at[index]);
}

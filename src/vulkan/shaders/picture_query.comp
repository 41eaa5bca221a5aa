// The field at the samples of a picture: E in W m^-2.
#include "picture.glsl"
#include "volume.glsl"

layout(push_constant, scalar) uniform Push {
    PicturePush push;
};

void main() {
    const uint index = globalIndex();
    if (index >= push.sampleCount) return;
    const ScreenSample s = Samples(push.samples).at[index];
    // The back of a wall receives nothing.
    if (s.kind != kSampleSurface) return;
    Samples(push.samples).at[index].irradiance = probegiIrradiance(s.position, s.shadingNormal, -s.viewDirection);
}

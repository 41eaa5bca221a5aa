// Linear light to 8-bit sRGB.
#include "common.glsl"

#include "kernels/abi/gpu_passes.h"
#include "kernels/screen/tone_map.h"

layout(push_constant, scalar) uniform Push {
    ToneMapPush push;
};

void main() {
    const uint index = globalIndex();
    if (index >= push.width * push.height) return;
    const vec3 display = toneMap(Vec3s(push.pixels).at[index], push.exposure, push.filmic != 0);
    const uvec3 code = displayCodes(display, push.dither != 0, int(index % push.width), int(index / push.width));
    Uints(push.display).at[index] = code.r | (code.g << 8) | (code.b << 16) | 0xff000000u;
}

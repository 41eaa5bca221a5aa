// Direct light: how far the samples on the right and below are away.
#include "vulkan/shaders/picture.glsl"

layout(push_constant, scalar) uniform Push {
    PicturePush push;
};

void main() {
    const int index = int(globalIndex());
    if (index >= int(push.sampleCount)) return;
    const int x = index % push.width;
    const int y = index / push.width;
    Samples samples = Samples(push.samples);
    const int right = y * push.width + min(x + 1, push.width - 1);
    const int below = min(y + 1, push.rows - 1) * push.width + x;
    samples.at[index].direct = vec3(samples.at[right].distance, samples.at[below].distance, 0.0);
}

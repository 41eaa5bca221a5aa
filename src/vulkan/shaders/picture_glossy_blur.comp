// The light of a block's ray and its neighbours'.
#include "glossy_blur.glsl"

void main() {
    const uint index = globalIndex();
    if (index >= glossyCount(push)) return;
    const GlossySample block = glossySamples(push).at[index];
    if (block.pixel < 0) return;
    const float reach = min(block.radius, float(kGlossyTaps) + 1.0);
    glossySamples(push).at[index].blurred = blurredAt(int(index), 1.0, reach, false);
}

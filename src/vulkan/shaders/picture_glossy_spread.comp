// The blurred light of blocks farther away, for wide lobes.
#include "glossy_blur.glsl"

void main() {
    const uint index = globalIndex();
    if (index >= glossyCount(push)) return;
    const GlossySample block = glossySamples(push).at[index];
    if (block.pixel < 0) return;
    const float radius = block.radius;
    const float step = glossyStep(radius);
    vec3 radiance = block.blurred;
    if (step > 0.0) {
        const vec3 wide = blurredAt(int(index), step, radius + step, true);
        radiance += glossyWideShare(radius) * (wide - block.blurred);
    }
    glossySamples(push).at[index].radiance = radiance;
}

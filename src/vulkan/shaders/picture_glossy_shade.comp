// Glossy light from the blocks to the samples, and through their materials.
#include "glossy_blur.glsl"

// Light around the glossy lobe of a sample, from the rays of its own and the adjacent blocks.
vec3 upsampled(int x, int y, ScreenSample s) {
    const ivec2 size = glossySize(push);
    const GlossyGuide centre = guideOf(s);
    const int column = x / 2;
    const int row = y / 2;
    GlossyMean mean = glossyMean(glossySamples(push).at[row * size.x + column].radiance, 0.0);
    for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i) {
            if (!isBlock(size, column + i, row + j)) continue;
            const GlossySample tap = glossySamples(push).at[(row + j) * size.x + column + i];
            if (tap.pixel < 0) continue;
            const float tent = glossyTent(float(tap.pixel % push.width - x), float(tap.pixel / push.width - y));
            if (tent <= 0.0) continue;
            const float guide = guideWeight(centre, guideOf(shownBy(tap)), 2.0, pixelAngle());
            addTap(mean, tap.radiance, tent * (guide + kGlossyLeastGuide));
        }
    return meanOf(mean);
}

void main() {
    const uint index = globalIndex();
    if (index >= push.sampleCount) return;
    const ScreenSample s = Samples(push.samples).at[index];
    if (s.kind != kSampleSurface) return;
    const float rays = glossyRayShare(s.roughness);
    vec3 mean = glossyLobes(push).at[index];
    if (rays > 0.0) mean += rays * (upsampled(int(index) % push.width, int(index) / push.width, s) - mean);
    glossyLobes(push).at[index] = glossyRadiance(materialOf(s), -dot(s.viewDirection, s.shadingNormal), mean);
}

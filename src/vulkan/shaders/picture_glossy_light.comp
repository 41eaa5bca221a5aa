// The light of each glossy ray, from what it hit, and how far it is to be blurred.
#include "glossy_blur.glsl"

// Of the rays around a block, as far as they stand for its own.
float meanReach(int column, int row) {
    const ivec2 size = glossySize(push);
    const GlossyGuide centre = guideOf(shownBy(glossySamples(push).at[row * size.x + column]));
    float sum = 0.0;
    float weights = 0.0;
    for (int j = -kGlossyReachTaps; j <= kGlossyReachTaps; ++j)
        for (int i = -kGlossyReachTaps; i <= kGlossyReachTaps; ++i) {
            if (!isBlock(size, column + i, row + j)) continue;
            const GlossySample tap = glossySamples(push).at[(row + j) * size.x + column + i];
            if (tap.pixel < 0) continue;
            const float weight =
                guideWeight(centre, guideOf(shownBy(tap)), 2.0 * sqrt(float(i * i + j * j)), pixelAngle());
            sum += weight * tap.reach;
            weights += weight;
        }
    return weights > 0.0 ? sum / weights : 0.0;
}

void main() {
    const uint index = globalIndex();
    if (index >= glossyCount(push)) return;
    const GlossySample block = glossySamples(push).at[index];
    if (block.pixel < 0) return;
    const ScreenSample hit = glossyHits(push).at[index];
    const int columns = glossySize(push).x;
    glossySamples(push).at[index].radius =
        glossyBlurRadius(shownBy(block).roughness, meanReach(int(index) % columns, int(index) / columns), pixelAngle());
    glossySamples(push).at[index].radiance = hitRadiance(materialOf(hit), -dot(hit.viewDirection, hit.shadingNormal),
                                                         hit.direct, hit.irradiance, block.radiance);
}

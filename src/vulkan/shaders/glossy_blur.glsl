// Loops of the glossy blur over the blocks of a frame.
#ifndef PROBEGI_GLOSSY_BLUR_GLSL
#define PROBEGI_GLOSSY_BLUR_GLSL

#include "picture_glossy.glsl"

layout(push_constant, scalar) uniform Push {
    PicturePush push;
};

float pixelAngle() {
    return pinholeSpread(push.camera, 1);
}

bool isBlock(ivec2 size, int column, int row) {
    return column >= 0 && row >= 0 && column < size.x && row < size.y;
}

ScreenSample shownBy(GlossySample block) {
    return Samples(push.samples).at[block.pixel];
}

// The weighted mean of (2 kGlossyTaps + 1)^2 blocks, `step` apart: of what was blurred once, or of the rays themselves.
vec3 blurredAt(int index, float step, float radius, bool again) {
    const ivec2 size = glossySize(push);
    const int column = index % size.x;
    const int row = index / size.x;
    const GlossySample own = glossySamples(push).at[index];
    const GlossyGuide centre = guideOf(shownBy(own));
    GlossyMean mean = glossyMean(again ? own.blurred : own.radiance, 1.0);
    for (int j = -kGlossyTaps; j <= kGlossyTaps; ++j)
        for (int i = -kGlossyTaps; i <= kGlossyTaps; ++i) {
            const int x = glossyOffset(i, step);
            const int y = glossyOffset(j, step);
            const float distance = sqrt(float(x * x + y * y));
            if ((x == 0 && y == 0) || distance >= radius || !isBlock(size, column + x, row + y)) continue;
            const GlossySample tap = glossySamples(push).at[(row + y) * size.x + column + x];
            if (tap.pixel < 0) continue;
            const float weight = guideWeight(centre, guideOf(shownBy(tap)), 2.0 * distance, pixelAngle());
            addTap(mean, again ? tap.blurred : tap.radiance, weight * glossyFalloff(distance, radius));
        }
    return meanOf(mean);
}

#endif

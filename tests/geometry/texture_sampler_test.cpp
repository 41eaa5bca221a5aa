// Texture look-ups against values computed by hand.
#include "geometry/texture_sampler.h"

#include <cmath>
#include <limits>

#include "tracer/tracer_scene.h"

namespace probegi::test {

namespace {

/// Two texels side by side: red 0 and 255, alpha 0 and 255, green 64 in both.
const TextureImage kStep{2, 1, {0, 64, 0, 0, 255, 64, 255, 255}, "step"};

TextureSampler stepSampler(Wrap wrap, bool nearest = false) {
    TextureRef ref;
    ref.image = 0;
    ref.wrapU = ref.wrapV = wrap;
    ref.nearest = nearest;
    return {ref, kStep};
}

/// Two by two texels whose red is 0, 51 above 102, 255.
const TextureImage kCorners{2, 2, {0, 0, 0, 255, 51, 0, 0, 255, 102, 0, 0, 255, 255, 0, 0, 255}, "corners"};

}  // namespace

TEST(SrgbToLinear, KnownCodes) {
    EXPECT_EQ(srgbToLinear(0), 0.0f);
    EXPECT_EQ(srgbToLinear(255), 1.0f);
    EXPECT_FLOAT_EQ(srgbToLinear(10), 10.0f / 255.0f / 12.92f);
    EXPECT_NEAR(srgbToLinear(128), 0.215861f, 1e-6f);
    EXPECT_NEAR(srgbToLinear(188), 0.502887f, 1e-6f);
    for (int code = 1; code < 256; ++code)
        EXPECT_GT(srgbToLinear(std::uint8_t(code)), srgbToLinear(std::uint8_t(code - 1)));
}

TEST(TextureSampler, AbsentTextureIsOne) {
    const TextureSampler sampler;
    EXPECT_FALSE(sampler.present());
    EXPECT_EQ(sampler.color({0.3f, 0.4f}), glm::vec3(1.0f));
    EXPECT_EQ(sampler.data({0.3f, 0.4f}), glm::vec3(1.0f));
    EXPECT_EQ(sampler.alpha({0.3f, 0.4f}), 1.0f);
}

TEST(TextureSampler, BlendsLinearValuesNotCodes) {
    const TextureSampler sampler = stepSampler(Wrap::clampToEdge);
    EXPECT_FLOAT_EQ(sampler.color({0.5f, 0.5f}).x, 0.5f);
    EXPECT_FLOAT_EQ(sampler.color({0.375f, 0.5f}).x, 0.25f);
    EXPECT_FLOAT_EQ(sampler.color({0.5f, 0.5f}).y, srgbToLinear(64));
    EXPECT_FLOAT_EQ(sampler.data({0.5f, 0.5f}).y, 64.0f / 255.0f);
    EXPECT_FLOAT_EQ(sampler.alpha({0.625f, 0.5f}), 0.75f);
}

TEST(TextureSampler, BilinearInBothAxes) {
    TextureRef ref;
    ref.image = 0;
    ref.wrapU = ref.wrapV = Wrap::clampToEdge;
    const TextureSampler sampler(ref, kCorners);
    EXPECT_FLOAT_EQ(sampler.data({0.25f, 0.25f}).x, 0.0f);
    EXPECT_FLOAT_EQ(sampler.data({0.75f, 0.25f}).x, 0.2f);
    EXPECT_FLOAT_EQ(sampler.data({0.25f, 0.75f}).x, 0.4f);
    EXPECT_FLOAT_EQ(sampler.data({0.75f, 0.75f}).x, 1.0f);
    EXPECT_FLOAT_EQ(sampler.data({0.5f, 0.5f}).x, 0.4f);
    // A quarter of the way along u, three quarters along v.
    EXPECT_NEAR(sampler.data({0.375f, 0.625f}).x, 0.25f * (0.25f * 0.2f) + 0.75f * (0.75f * 0.4f + 0.25f * 1.0f),
                1e-6f);
}

TEST(TextureSampler, WrapModes) {
    struct Row {
        float u, repeat, clamp, mirror;
    };
    for (const Row& row : {Row{0.25f, 0, 0, 0}, Row{0.75f, 1, 1, 1}, Row{0.0f, 0.5f, 0, 0}, Row{1.0f, 0.5f, 1, 1},
                           Row{-0.25f, 1, 0, 0}, Row{1.25f, 0, 1, 1}, Row{1.75f, 1, 1, 0}, Row{-0.5f, 0.5f, 0, 0.5f},
                           Row{2.5f, 0.5f, 1, 0.5f}, Row{7.25f, 0, 1, 1}, Row{-1e-9f, 0.5f, 0, 0}}) {
        EXPECT_NEAR(stepSampler(Wrap::repeat).color({row.u, 0.5f}).x, row.repeat, 1e-6f) << row.u;
        EXPECT_NEAR(stepSampler(Wrap::clampToEdge).color({row.u, 0.5f}).x, row.clamp, 1e-6f) << row.u;
        EXPECT_NEAR(stepSampler(Wrap::mirroredRepeat).color({row.u, 0.5f}).x, row.mirror, 1e-6f) << row.u;
    }
}

TEST(TextureSampler, NearestTakesOneTexel) {
    EXPECT_EQ(stepSampler(Wrap::repeat, true).color({0.49f, 0.5f}).x, 0.0f);
    EXPECT_EQ(stepSampler(Wrap::repeat, true).color({0.51f, 0.5f}).x, 1.0f);
    EXPECT_EQ(stepSampler(Wrap::clampToEdge, true).color({1.0f, 1.0f}).x, 1.0f);
    EXPECT_EQ(stepSampler(Wrap::repeat, true).color({-0.1f, 0.5f}).x, 1.0f);
}

TEST(TextureSampler, UvTransformIsAMatrixOnUv1) {
    TextureRef ref;
    ref.image = 0;
    ref.nearest = true;
    ref.wrapU = ref.wrapV = Wrap::clampToEdge;
    // u' = 0.5 v + 0.25, v' = -u + 0.75: glm is column-major.
    ref.uvTransform = glm::mat3(0, -1, 0, 0.5f, 0, 0, 0.25f, 0.75f, 1);
    const TextureSampler sampler(ref, kCorners);
    EXPECT_FLOAT_EQ(sampler.data({0.5f, 0.0f}).x, 0.0f);  // (0.25, 0.25)
    EXPECT_FLOAT_EQ(sampler.data({0.5f, 1.0f}).x, 0.2f);  // (0.75, 0.25)
    EXPECT_FLOAT_EQ(sampler.data({0.0f, 0.0f}).x, 0.4f);  // (0.25, 0.75)
    EXPECT_FLOAT_EQ(sampler.data({0.0f, 1.0f}).x, 1.0f);  // (0.75, 0.75)
}

TEST(TextureSampler, NonFiniteAndHugeUvsStayInside) {
    const float infinity = std::numeric_limits<float>::infinity();
    for (const float u : {infinity, -infinity, std::numeric_limits<float>::quiet_NaN(), 1e30f, -1e30f}) {
        for (const Wrap wrap : {Wrap::repeat, Wrap::clampToEdge, Wrap::mirroredRepeat}) {
            const float value = stepSampler(wrap).color({u, u}).x;
            EXPECT_TRUE(value >= 0.0f && value <= 1.0f) << u;
        }
    }
}

TEST(TextureSampler, AlphaRange) {
    EXPECT_EQ(stepSampler(Wrap::repeat).alphaRange(), glm::vec2(0.0f, 1.0f));
}

}  // namespace probegi::test

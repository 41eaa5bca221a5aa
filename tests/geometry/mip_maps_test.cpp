// Mip levels against means computed by hand, and the level for a footprint.
#include "geometry/mip_maps.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/texture_sampler.h"
#include "kernels/screen/colour.h"
#include "kernels/shade/texture.h"

namespace probegi::test {
namespace {

TextureImage checkerboard(int width, int height) {
    TextureImage image{width, height, {}, "checkerboard"};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 4; ++c) image.rgba.push_back((x ^ y) & 1 ? 255 : 0);
    return image;
}

TEST(MipMaps, EveryLevelIsTheMeanOfTheOneBelow) {
    const TextureImage image{4,
                             2,
                             {0, 0, 0, 255, 40,  0, 0, 255, 100, 0, 0, 255, 100, 0, 0, 255,
                              0, 0, 0, 255, 120, 0, 0, 255, 100, 0, 0, 255, 200, 0, 0, 255},
                             "steps"};
    const std::vector<std::uint8_t> mips = makeMips(image, TexelKind::data);
    ASSERT_EQ(mips.size(), 4u * 3);
    EXPECT_EQ(mips[0], 40);
    EXPECT_EQ(mips[4], 125);
    EXPECT_NEAR(mips[8], 82.5, 0.51);
}

TEST(MipMaps, ColoursAreAveragedAsLight) {
    for (const auto& [width, height] : {std::pair(16, 16), std::pair(2, 64)}) {
        const std::vector<std::uint8_t> light = makeMips(checkerboard(width, height), TexelKind::color);
        const std::vector<std::uint8_t> numbers = makeMips(checkerboard(width, height), TexelKind::data);
        ASSERT_EQ(light.size(), numbers.size());
        for (std::size_t i = 0; i < light.size(); ++i) {
            EXPECT_NEAR(light[i], 188, 1) << "half of the light";
            EXPECT_NEAR(numbers[i], 128, 1);
        }
    }
}

TEST(MipMaps, OddSizesAndOneTexel) {
    EXPECT_TRUE(makeMips(checkerboard(1, 1), TexelKind::color).empty());
    TextureImage image{5, 3, std::vector<std::uint8_t>(60, 77), "even"};
    const std::vector<std::uint8_t> mips = makeMips(image, TexelKind::data);
    EXPECT_EQ(mips.size(), 4u * (2 * 1 + 1 * 1));
    for (const std::uint8_t texel : mips) EXPECT_EQ(texel, 77);
}

// An odd number of texels, halved: each new one covers a little more than two, with equal weights, so the mean stays.
TEST(MipMaps, OddSizesCoverEachTexelAlike) {
    for (const int lit : {0, 1, 2, 3, 4}) {
        TextureImage image{5, 1, std::vector<std::uint8_t>(20, 0), "one lit"};
        for (int c = 0; c < 4; ++c) image.rgba[std::size_t(4 * lit + c)] = 250;
        const std::vector<std::uint8_t> mips = makeMips(image, TexelKind::data);
        ASSERT_EQ(mips.size(), 4u * 3);
        EXPECT_EQ(mips[0] + mips[4], 100) << lit;
        EXPECT_EQ(mips[8], 50) << lit;
        EXPECT_EQ(mips[0], lit < 2 ? 100 : lit == 2 ? 50 : 0);
    }
}

// For every code, the mean of equal texels is that code; of two codes it is the one nearest to their mean light.
TEST(MipMaps, EveryCodeStays) {
    for (int code = 0; code < 256; ++code)
        for (const TexelKind kind : {TexelKind::color, TexelKind::data})
            for (const int width : {2, 3}) {
                const TextureImage image{width, 1,
                                         std::vector<std::uint8_t>(std::size_t(4 * width), std::uint8_t(code)), "even"};
                EXPECT_EQ(makeMips(image, kind)[0], code);
            }
    for (int code = 0; code < 250; ++code) {
        const auto a = std::uint8_t(code), b = std::uint8_t(code + 5);
        const TextureImage image{2, 1, {a, a, a, a, b, b, b, b}, "two"};
        const auto light = [](int c) { return double(kernels::decodeSrgb(float(c) / 255)); };
        const double mean = 0.5 * (light(a) + light(b));
        const double got = 255.0 * kernels::encodeSrgb(float(mean));
        EXPECT_NEAR(makeMips(image, TexelKind::color)[0], got, 0.501) << code;
        EXPECT_NEAR(makeMips(image, TexelKind::data)[0], code + 2.5, 0.501) << code;
    }
}

TEST(MipMaps, LooksUpBetweenLevels) {
    const TextureImage image = checkerboard(8, 8);
    const std::vector<std::uint8_t> mips = makeMips(image, TexelKind::data);
    TextureRef ref;
    ref.image = 0;
    const TextureSampler sampler(ref, image, mips);
    EXPECT_EQ(sampler.levels(), 4);
    EXPECT_EQ(sampler.texelsPerUvArea(), 64);
    const glm::vec2 white(1.5f / 8, 0.5f / 8);
    EXPECT_NEAR(sampler.data(white).x, 1, 1e-6f);
    EXPECT_NEAR(sampler.data(white, 0.0f).x, 1, 1e-6f);
    const float grey = float(mips[0]) / 255;
    EXPECT_NEAR(sampler.data(white, 0.25f).x, 0.75f + 0.25f * grey, 1e-5f);
    EXPECT_NEAR(sampler.data(white, 1.0f).x, grey, 1e-5f);
    EXPECT_NEAR(sampler.data(white, 3.0f).x, grey, 0.01f);
}

TEST(MipMaps, AllThatMaterialsUse) {
    Scene scene;
    scene.images = {checkerboard(4, 4), checkerboard(8, 8), checkerboard(2, 2)};
    scene.materials.resize(2);
    scene.materials[0].baseColorTexture.image = 0;
    scene.materials[0].normalTexture.image = 1;
    scene.materials[1].emissiveTexture.image = 1;
    const MipMaps mips(Context::create({.threads = 2}).value(), scene);
    EXPECT_EQ(mips.of(0, TexelKind::color).size(), 4u * 5);
    EXPECT_TRUE(mips.of(0, TexelKind::data).empty());
    EXPECT_EQ(mips.of(1, TexelKind::color).size(), 4u * 21);
    EXPECT_NE(mips.of(1, TexelKind::color)[0], mips.of(1, TexelKind::data)[0]);
    EXPECT_TRUE(mips.of(2, TexelKind::color).empty());
    EXPECT_TRUE(MipMaps().of(0, TexelKind::color).empty());
}

// A texture of 512 x 512 texels on a square metre: at 2 m a ray of a milliradian covers 1.024 texels, and every
// doubling of spread or distance is one level more.
TEST(FootprintLevel, OneTexelIsLevelZeroAndDoublingIsOneMore) {
    const float texels =
        kernels::texelsPerUvArea({1, 0, 0}, {0, 1, 0}, 512, 512) * kernels::uvArea({0, 0}, {1, 0}, {0, 1});
    const auto level = [&](float spread, float distance, float cosine) {
        return kernels::footprintLevel(kernels::coneFootprint(spread, distance, cosine), texels, 1.0f, 10);
    };
    const float first = std::log2(1.024f);
    EXPECT_NEAR(level(1e-3f, 2, -1), first, 1e-4f);
    EXPECT_NEAR(level(2e-3f, 2, 1), first + 1, 1e-4f);
    EXPECT_NEAR(level(1e-3f, 8, 1), first + 2, 1e-4f);
    EXPECT_NEAR(level(1e-3f, 2, 0.0625f), first + 2, 1e-4f) << "sixteen times as long, no wider";
    EXPECT_EQ(level(1e-3f, 1, 1), 0) << "magnified";
    EXPECT_EQ(level(0, 1, 1), 0);
    EXPECT_EQ(level(1, 1e6f, 1), 9) << "the coarsest";
    // Four times the area for the same uvs: half the texels per metre.
    EXPECT_NEAR(kernels::footprintLevel(0.004f, texels, 4.0f, 10), 0.034216f, 1e-4f);
    EXPECT_EQ(kernels::footprintLevel(1.0f, 0.0f, 0.0f, 10), 0) << "a triangle without uvs";
}

}  // namespace
}  // namespace probegi::test

#include <gtest/gtest.h>

#include <glm/gtc/packing.hpp>

#include "kernels/probe/irradiance_decoding.h"
#include "kernels/probe/irradiance_encoding.h"
#include "kernels/probe/storage.h"

namespace probegi::kernels {
namespace {

TEST(IrradianceEncoding, isTheFifthRootOverTheWholeRange) {
    for (float x = 1e-25f; x < 1e25f; x *= 1.37f) {
        const double exact = std::pow(double(x), 0.2);
        EXPECT_NEAR(encodeIrradiance(x) / exact, 1.0, 3e-7) << x;
        EXPECT_NEAR(decodeIrradiance(encodeIrradiance(x)) / x, 1.0f, 2e-6f) << x;
    }
    EXPECT_EQ(encodeIrradiance(0.0f), 0.0f);
    EXPECT_EQ(decodeIrradiance(0.0f), 0.0f);
}

TEST(IrradianceEncoding, blendSpaceSquaredIsLinear) {
    for (float x : {0.0f, 1e-4f, 0.3f, 1.0f, 900.0f}) {
        const float b = decodeToBlendSpace(encodeIrradiance(x));
        EXPECT_NEAR(b * b, x, 3e-6f * x);
    }
}

TEST(Storage, halfUnpacksLikeTheStandardFormat) {
    for (uint h = 0x400; h < 0x7c00; ++h) EXPECT_EQ(unpackHalf(h), glm::unpackHalf1x16(glm::uint16(h)));
}

TEST(Storage, halfPackWithoutDitherTruncatesAndRoundTrips) {
    for (uint h = 0x400; h < 0x7c00; ++h) {
        EXPECT_EQ(packHalfDithered(unpackHalf(h), 0), h);
        EXPECT_EQ(packHalfDithered(unpackHalf(h), 8191), h);  // exact values stay exact
    }
    EXPECT_EQ(packHalfDithered(0.0f, 8191), 0u);
    EXPECT_EQ(packHalfDithered(1e9f, 8191), 0x7bffu);  // saturates, never infinite
}

// The purpose of the dither: the expectation of the stored value is the value itself.
TEST(Storage, ditheredRoundingIsUnbiased) {
    for (float x : {0.00123f, 0.3337f, 0.9999f, 3.7f, 12.345f}) {
        double half = 0;
        for (uint dither = 0; dither < 8192; ++dither) half += unpackHalf(packHalfDithered(x, dither));
        EXPECT_NEAR(half / 8192 / x, 1.0, 1e-6) << x;
    }
    double unorm = 0;
    const float v = 0.123456789f;
    for (int i = 0; i < 4096; ++i) unorm += unpackUnorm16(packUnorm16Dithered(v, (float(i) + 0.5f) / 4096));
    EXPECT_NEAR(unorm / 4096, v, 1e-7);
}

TEST(Storage, unormClampsAndKeepsItsEnds) {
    EXPECT_EQ(packUnorm16Dithered(1.0f, 0.999f), 65535u);
    EXPECT_EQ(packUnorm16Dithered(2.0f, 0.0f), 65535u);
    EXPECT_EQ(packUnorm16Dithered(-1.0f, 0.999f), 0u);
}

TEST(Random, numbersAreUniform) {
    uint state = 3;
    double mean = 0, square = 0;
    const int n = 100000;
    for (int i = 0; i < n; ++i) {
        const float u = nextRandom(state);
        ASSERT_TRUE(u >= 0.0f && u < 1.0f);
        mean += u / n;
        square += double(u) * u / n;
    }
    EXPECT_NEAR(mean, 0.5, 4e-3);
    EXPECT_NEAR(square, 1.0 / 3, 4e-3);
}

}  // namespace
}  // namespace probegi::kernels

#include "kernels/probe/packed_ray.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/packing.hpp>
#include <limits>
#include <random>

#include "kernels/blend/probe_blend.h"

namespace probegi::kernels {
namespace {

// GLM has the format too, with logarithms, which round otherwise at some powers of two.
TEST(PackedRay, radianceIsTheFormatsNearestValue) {
    std::mt19937 random(2);
    std::uniform_real_distribution<float> power(-12, 15), unit(0, 1);
    for (int i = 0; i < 2000; ++i) {
        const vec3 radiance = std::exp2(power(random)) * vec3(1, unit(random), unit(random));
        const vec3 got = unpackRadiance(packRadiance(radiance)),
                   glms = glm::unpackF3x9_E1x5(glm::packF3x9_E1x5(radiance));
        const float largest = std::max({radiance.x, radiance.y, radiance.z});
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(got[c], radiance[c], largest / 511) << i;
            EXPECT_LE(std::abs(got[c] - radiance[c]), std::abs(glms[c] - radiance[c]) + 1e-6f * largest) << i;
        }
    }
}

TEST(PackedRay, whatTheFormatHasComesBack) {
    for (const float x : {0.0f, 1.0f, 0.5f, 511.0f, 1.0f / 16777216.0f, 65408.0f, 65280.0f}) {
        EXPECT_EQ(unpackRadiance(packRadiance(vec3(x))), vec3(x));
        EXPECT_EQ(unpackRadiance(packRadiance(vec3(x, 0, 0))), vec3(x, 0, 0));
    }
    // Just below a power of two: the mantissa would round up to 512.
    EXPECT_EQ(unpackRadiance(packRadiance(vec3(1.9999f))), vec3(2.0f));
}

TEST(PackedRay, whatItHasNotIsClamped) {
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinite = std::numeric_limits<float>::infinity();
    EXPECT_EQ(unpackRadiance(packRadiance(vec3(nan, -3.0f, 1.0f))), vec3(0, 0, 1));
    EXPECT_EQ(unpackRadiance(packRadiance(vec3(infinite, 1e30f, 65408.0f))), vec3(kMostPackedRadiance));
    EXPECT_EQ(unpackRadiance(packRadiance(vec3(1e-9f))), vec3(0.0f));
    EXPECT_EQ(unpackRadiance(packRadiance(vec3(1e-40f))), vec3(0.0f));
}

// Fronts, backs of one-sided and of two-sided surfaces, and misses keep their meaning.
TEST(PackedRay, sidesAreKept) {
    for (const float distance : {0.0f, 0.3f, 17.0f, 1e30f, -0.0f, -0.3f, -17.0f})
        for (const vec3 radiance : {vec3(1, 0.5f, 0.25f), vec3(-1, -0.5f, -0.25f), vec3(-1e-30f), vec3(0.0f)}) {
            const bool front = !std::signbit(distance);
            if (front && radiance.x < 0) continue;
            const float packed = packRayDistance(distance, radiance.x);
            const vec3 unpacked = unpackRayRadiance(packRadiance(unsignedRadiance(distance, radiance)), packed);
            EXPECT_NEAR(packed, distance, 2e-7f * std::abs(distance) + 1.2e-38f);
            EXPECT_EQ(hitBack(packed), hitBack(distance));
            EXPECT_EQ(hitBackface(packed, unpacked.x), hitBackface(distance, radiance.x)) << distance << radiance.x;
            const vec3 light = arrivingRadiance(packed, unpacked), wanted = arrivingRadiance(distance, radiance);
            EXPECT_LT(length(light - wanted), 1e-29f + 2e-3f * length(wanted));
        }
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_TRUE(std::isnan(packRayDistance(nan, 1)));
}

}  // namespace
}  // namespace probegi::kernels

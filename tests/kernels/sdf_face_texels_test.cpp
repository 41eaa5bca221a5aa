#include "kernels/sdf/face_texels.h"

#include <gtest/gtest.h>

#include <cmath>

namespace probegi::kernels {
namespace {

const vec3 kHalf(1, 2, 3);

int faceOf(vec3 p) {
    return sdfFacePoint(kHalf, p).first / (kSdfFaceSide * kSdfFaceSide);
}

TEST(SdfFaceTexels, findsTheFace) {
    EXPECT_EQ(faceOf({-1, 0.3f, 0.2f}), 0);
    EXPECT_EQ(faceOf({1, 0.3f, 0.2f}), 1);
    EXPECT_EQ(faceOf({0.1f, -2, 0.2f}), 2);
    EXPECT_EQ(faceOf({0.1f, 2, 0.2f}), 3);
    EXPECT_EQ(faceOf({0.1f, 0.3f, -3}), 4);
    EXPECT_EQ(faceOf({0.1f, 0.3f, 3}), 5);
}

// The middle of texel (2, 4) of a face lies at (2.5, 4.5) sixths across it.
TEST(SdfFaceTexels, runsAlongTheNextAxes) {
    const float u = 2 * 2.5f / 6 - 1, v = 2 * 4.5f / 6 - 1;
    const auto expectTexel = [](vec3 p, int face) {
        const SdfFacePoint at = sdfFacePoint(kHalf, p * kHalf);
        EXPECT_NEAR(float(at.first % 6) + at.u, 2, 1e-4f);
        EXPECT_NEAR(float(at.first / 6 % 6) + at.v, 4, 1e-4f);
        EXPECT_EQ(at.first / 36, face);
    };
    expectTexel({-1, u, v}, 0);
    expectTexel({v, 1, u}, 3);
    expectTexel({u, v, 1}, 5);
}

TEST(SdfFaceTexels, endsWithTheOutermostTexels) {
    const SdfFacePoint low = sdfFacePoint(kHalf, {1, -2, -3}), high = sdfFacePoint(kHalf, {1.0001f, 2, 3});
    EXPECT_EQ(low.first % 36, 0);
    EXPECT_EQ(low.u, 0);
    EXPECT_EQ(low.v, 0);
    EXPECT_EQ(high.first % 36, 4 * 6 + 4);
    EXPECT_EQ(high.u, 1);
    EXPECT_EQ(high.v, 1);
}

TEST(SdfFaceTexels, keepsColoursToHalfA255thOfTheirRoot) {
    for (int i = 0; i <= 1000; ++i) {
        const float c = float(i) / 1000;
        const vec3 back = sdfUnpackColour(sdfPackColour(vec3(c, 0, 1)));
        EXPECT_NEAR(std::sqrt(back.x), std::sqrt(c), 0.5f / 255 + 1e-6f);
        EXPECT_EQ(back.y, 0);
        EXPECT_EQ(back.z, 1);
    }
    EXPECT_EQ(sdfPackColour(vec3(-1, 2, 0)), 0xff00u);
}

TEST(SdfFaceTexels, blendsBetweenFour) {
    SdfFacePoint at;
    at.first = 0;
    at.u = 0.25f;
    at.v = 0.5f;
    const uint one = sdfPackColour(vec3(1)), none = sdfPackColour(vec3(0));
    EXPECT_FLOAT_EQ(sdfFaceColour(at, one, none, none, none).x, 0.75f * 0.5f);
    EXPECT_FLOAT_EQ(sdfFaceColour(at, none, one, none, none).x, 0.25f * 0.5f);
    EXPECT_FLOAT_EQ(sdfFaceColour(at, none, none, one, none).x, 0.75f * 0.5f);
    EXPECT_FLOAT_EQ(sdfFaceColour(at, none, none, none, one).x, 0.25f * 0.5f);
    EXPECT_FLOAT_EQ(sdfFaceColour(at, one, one, one, one).x, 1.0f);
}

}  // namespace
}  // namespace probegi::kernels

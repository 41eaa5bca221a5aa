#include "report/linear_png.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/packing.hpp>
#include <limits>

namespace probegi::tool {
namespace {

/// Decodes a value as the page does: the codes of both planes as a half float.
float read(const HdrImage& planes, int x, int y, int channel) {
    const auto code = [&](int row) {
        return std::uint32_t(std::lround(255 * toDisplay(planes.at(x, row), {1, false, false})[channel]));
    };
    return glm::unpackHalf1x16(glm::uint16(code(y) << 8 | code(y + planes.height / 2)));
}

TEST(HalfFloatPlanes, ValuesComeBackWithinHalfAPercent) {
    HdrImage image(64, 3);
    for (int x = 0; x < image.width; ++x)
        for (int y = 0; y < image.height; ++y)
            image.at(x, y) = {std::exp2(0.4f * float(x) - 12), 0.001f * float(x * x), float(y) * 1.37f};
    const HdrImage planes = halfFloatPlanes(image);
    ASSERT_EQ(planes.width, 64);
    ASSERT_EQ(planes.height, 6);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < 3; ++c) {
                const float value = std::min(image.at(x, y)[c], 65024.0f);
                EXPECT_NEAR(read(planes, x, y, c), value, 0.005f * value + 1e-6f);
            }
}

TEST(HalfFloatPlanes, OddValues) {
    HdrImage image(1, 1);
    for (const float bad : {-1.0f, 0.0f, std::numeric_limits<float>::quiet_NaN()}) {
        image.at(0, 0) = glm::vec3(bad);
        EXPECT_EQ(read(halfFloatPlanes(image), 0, 0, 1), 0);
    }
    for (const float huge : {65504.0f, 1e30f, std::numeric_limits<float>::infinity()}) {
        image.at(0, 0) = glm::vec3(huge);
        const float back = read(halfFloatPlanes(image), 0, 0, 2);
        EXPECT_TRUE(std::isfinite(back));
        EXPECT_GT(back, 64000);
    }
}

}  // namespace
}  // namespace probegi::tool

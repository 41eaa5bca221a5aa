#include "kernels/screen/contact_blur.h"

#include <gtest/gtest.h>

#include <array>

namespace probegi::kernels {
namespace {

// Of the 4 x 4 pixels of a pattern each counts alike, wherever the centre is.
TEST(ContactBlur, allNoiseOfAPatternIsInTheMean) {
    for (int centre = 0; centre < 4; ++centre) {
        std::array<float, 16> weights{};
        for (int j = -kContactTaps; j <= kContactTaps; ++j)
            for (int i = -kContactTaps; i <= kContactTaps; ++i)
                weights[std::size_t((i + centre) & 3) + 4 * std::size_t((j + 2 * centre) & 3)] += contactTap(i, j);
        for (const float weight : weights) EXPECT_EQ(weight, weights[0]);
    }
}

TEST(ContactBlur, aMeanOfEqualValuesIsThatValue) {
    const vec4 light(0.1f, 2.3f, 4.7f, 0.3f);
    ContactMean mean = contactMean(light, 4.0f);
    for (int i = 0; i < 9; ++i) addContactTap(mean, light, 0.37f * float(i));
    EXPECT_EQ(contactMeanOf(mean), light);
    addContactTap(mean, vec4(0.0f), mean.weight);
    EXPECT_NEAR(contactMeanOf(mean).y, 0.5f * light.y, 1e-6f);
}

TEST(ContactBlur, staysWithinEdges) {
    const GlossyGuide floor = contactGuide({0, 0, 0}, {0, 1, 0}, 4.0f);
    EXPECT_GT(guideWeight(floor, contactGuide({0.01f, 0, 0}, {0, 1, 0}, 4.0f), 1.0f, 2e-3f), 0.99f);
    EXPECT_EQ(guideWeight(floor, contactGuide({0.01f, 0.1f, 0}, {0, 1, 0}, 4.0f), 1.0f, 2e-3f), 0.0f);
    EXPECT_EQ(guideWeight(floor, contactGuide({0.01f, 0, 0}, {1, 0, 0}, 4.0f), 1.0f, 2e-3f), 0.0f);
}

TEST(ContactBlur, lightIsNeverNegative) {
    EXPECT_EQ(withContact(vec3(1, 2, 3), vec4(-2, 1, 0, 0.5f)), vec3(0, 3, 3));
}

}  // namespace
}  // namespace probegi::kernels

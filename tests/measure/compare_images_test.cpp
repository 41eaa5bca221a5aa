#include "probegi/measure.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "measure/colour_spaces.h"

namespace probegi {
namespace {

using testing::HasSubstr;

HdrImage gradient(int width, int height) {
    HdrImage image(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            image.at(x, y) = {float(x) / float(width), float(y) / float(height), 0.5f * float(x + y) / float(width)};
    return image;
}

/// Uniform noise of the given half-width on a grey picture; the pattern is the same for each amplitude.
HdrImage noisyGrey(int size, float amplitude) {
    HdrImage image(size, size);
    std::minstd_rand random(7);
    for (glm::vec3& pixel : image.pixels)
        pixel = glm::vec3(0.4f + amplitude * (2 * float(random()) / float(std::minstd_rand::max()) - 1));
    return image;
}

TEST(Compare, pictureEqualsItself) {
    const HdrImage image = gradient(37, 23);
    const auto result = compareImages(image, image);
    ASSERT_TRUE(result) << result.error().message;
    EXPECT_EQ(result->difference.rmse, 0);
    EXPECT_EQ(result->difference.relmse, 0);
    EXPECT_EQ(result->difference.flip, 0);
    EXPECT_EQ(result->flipMap.width, 37);
    EXPECT_EQ(result->rmseMap.height, 23);
}

TEST(Compare, rmseAndRelmseByHand) {
    // Display values 0 and 1 need no transfer function: white against black in one of two pixels, red in the other.
    HdrImage test(2, 1);
    test.at(0, 0) = {1, 1, 1};
    test.at(1, 0) = {1, 0, 0};
    const HdrImage reference(2, 1);
    const auto result = compareImages(test, reference);
    ASSERT_TRUE(result);
    EXPECT_NEAR(result->difference.rmse, std::sqrt((1.0 + 1.0 / 3) / 2), 1e-6);
    EXPECT_NEAR(result->rmseMap.at(0, 0).x, 1, 1e-6);
    EXPECT_NEAR(result->rmseMap.at(1, 0).y, std::sqrt(1.0 / 3), 1e-6);
    EXPECT_NEAR(result->difference.relmse, 4 * (1 / 0.01) / 6, 1e-4);
}

TEST(Compare, relmseIsLinearAndUnclipped) {
    const HdrImage test(3, 2, glm::vec3(6));
    const HdrImage reference(3, 2, glm::vec3(4));
    const auto result = compareImages(test, reference);
    ASSERT_TRUE(result);
    EXPECT_EQ(result->difference.rmse, 0) << "both are white on a screen";
    EXPECT_NEAR(result->difference.relmse, 4 / 16.01, 1e-6);
}

// A picture with 65 % of the light in every pixel: the ratios show it however dark the picture is; relMSE shows it only
// in bright pictures with its fixed constant, and always with a constant that scales with the picture.
TEST(Compare, aFactorOnTheLightIsItsRatio) {
    for (const float brightness : {0.02f, 1.0f, 50.0f}) {
        HdrImage reference = gradient(96, 55);
        for (glm::vec3& pixel : reference.pixels) pixel = brightness * (pixel + 0.3f);
        HdrImage test = reference;
        for (glm::vec3& pixel : test.pixels) pixel *= 0.65f;
        const auto result = compareImages(test, reference);
        ASSERT_TRUE(result);
        const LightRatio& ratio = result->difference.ratio;
        for (const double r : {ratio.mean, ratio.low, ratio.median, ratio.high}) EXPECT_NEAR(r, 0.65, 1e-5);
        EXPECT_EQ(ratio.blocks, 40);
        EXPECT_NEAR(result->difference.scaledRelmse, 0.35 * 0.35, 0.01);
        EXPECT_EQ(result->difference.relmse < 0.01, brightness < 0.1f) << result->difference.relmse;
    }
}

TEST(Compare, scaledRelmseByHand) {
    HdrImage test(2, 1), reference(2, 1);
    reference.at(0, 0) = glm::vec3(2);  // the mean is 1
    test.at(0, 0) = glm::vec3(1);
    test.at(1, 0) = glm::vec3(0.5f);
    const auto result = compareImages(test, reference);
    ASSERT_TRUE(result);
    EXPECT_NEAR(result->difference.scaledRelmse, 0.5 * (1 / 4.01 + 0.25 / 0.01), 1e-6);
}

// Eight by five blocks: a dim room that fills three of the forty and is 35 % too dark changes the 5th percentile, but
// hardly the mean.
TEST(Compare, aDarkRoomShowsInThePercentiles) {
    HdrImage reference(80, 50, glm::vec3(1));
    for (int y = 0; y < 10; ++y)
        for (int x = 0; x < 30; ++x) reference.at(x, y) = glm::vec3(0.01f);
    HdrImage test = reference;
    for (int y = 0; y < 10; ++y)
        for (int x = 0; x < 30; ++x) test.at(x, y) *= 0.65f;
    const auto result = compareImages(test, reference);
    ASSERT_TRUE(result);
    const LightRatio& ratio = result->difference.ratio;
    EXPECT_NEAR(ratio.low, 0.65, 1e-5);
    EXPECT_NEAR(ratio.median, 1, 1e-6);
    EXPECT_NEAR(ratio.high, 1, 1e-6);
    EXPECT_NEAR(ratio.mean, 1, 1e-3);
    EXPECT_EQ(ratio.blocks, 40);
}

TEST(Compare, blackBlocksHaveNoRatio) {
    HdrImage reference(80, 50);
    for (int y = 0; y < 10; ++y)
        for (int x = 0; x < 20; ++x) reference.at(x, y) = glm::vec3(1, 0, 0);
    const auto result = compareImages(HdrImage(80, 50, glm::vec3(0.5f)), reference);
    ASSERT_TRUE(result);
    EXPECT_EQ(result->difference.ratio.blocks, 2);
    EXPECT_NEAR(result->difference.ratio.median, 0.5 / 0.2126, 1e-3) << "luminance";
    EXPECT_NEAR(result->difference.ratio.mean, 40 * 0.5 / (2 * 0.2126), 1e-3);

    const auto black = compareImages(HdrImage(3, 2, glm::vec3(1)), HdrImage(3, 2));
    ASSERT_TRUE(black);
    EXPECT_EQ(black->difference.ratio.blocks, 0);
    EXPECT_EQ(black->difference.ratio.mean, 0);
}

TEST(Compare, exposureReachesTheDisplayedMetrics) {
    const HdrImage test(3, 2, glm::vec3(6));
    const HdrImage reference(3, 2, glm::vec3(4));
    const auto result = compareImages(test, reference, {.exposure = 0.1f});
    ASSERT_TRUE(result);
    EXPECT_NEAR(result->difference.rmse, colour::encodeSrgb(glm::vec3(0.6f)).x - colour::encodeSrgb(glm::vec3(0.4f)).x,
                1e-5);
}

TEST(Compare, constantOffsetIsTheSameEverywhere) {
    const auto result = compareImages(HdrImage(40, 30, glm::vec3(0.3f)), HdrImage(40, 30, glm::vec3(0.2f)));
    ASSERT_TRUE(result);
    for (const glm::vec3& error : result->flipMap.pixels) EXPECT_NEAR(error.x, result->difference.flip, 1e-4);
    EXPECT_GT(result->difference.flip, 0.05);
    EXPECT_LT(result->difference.flip, 0.5);
}

TEST(Compare, moreNoiseIsMoreError) {
    const HdrImage reference(48, 48, glm::vec3(0.4f));
    ImageDifference last;
    for (const float amplitude : {0.02f, 0.05f, 0.1f, 0.2f, 0.4f}) {
        const auto result = compareImages(noisyGrey(48, amplitude), reference);
        ASSERT_TRUE(result);
        EXPECT_GT(result->difference.rmse, last.rmse);
        EXPECT_GT(result->difference.relmse, last.relmse);
        EXPECT_GT(result->difference.flip, last.flip);
        last = result->difference;
    }
    EXPECT_LE(last.flip, 1);
}

TEST(Compare, displayedMetricsAreSymmetric) {
    const HdrImage a = gradient(31, 17);
    const HdrImage b = noisyGrey(31, 0.2f);
    HdrImage cropped(31, 17);
    std::copy_n(b.pixels.begin(), cropped.pixels.size(), cropped.pixels.begin());
    const auto forward = compareImages(a, cropped);
    const auto backward = compareImages(cropped, a);
    ASSERT_TRUE(forward && backward);
    EXPECT_NEAR(forward->difference.rmse, backward->difference.rmse, 1e-9);
    EXPECT_NEAR(forward->difference.flip, backward->difference.flip, 1e-9);
}

TEST(Compare, onePixelIsEnough) {
    const auto result = compareImages(HdrImage(1, 1, glm::vec3(1)), HdrImage(1, 1));
    ASSERT_TRUE(result);
    EXPECT_NEAR(result->difference.rmse, 1, 1e-6);
    EXPECT_GT(result->difference.flip, 0.95);
}

TEST(Compare, refusesWhatCannotBeCompared) {
    const auto sizes = compareImages(HdrImage(2, 3), HdrImage(3, 2));
    ASSERT_FALSE(sizes);
    EXPECT_EQ(sizes.error().code, ErrorCode::invalidArgument);
    EXPECT_THAT(sizes.error().message, HasSubstr("2x3 and 3x2"));

    HdrImage broken(4, 4);
    broken.at(1, 2).y = std::numeric_limits<float>::quiet_NaN();
    const auto nan = compareImages(HdrImage(4, 4), broken);
    ASSERT_FALSE(nan);
    EXPECT_THAT(nan.error().message, HasSubstr("reference picture"));
    EXPECT_THAT(nan.error().message, HasSubstr("(1, 2)"));

    broken.at(1, 2).y = std::numeric_limits<float>::infinity();
    EXPECT_FALSE(compareImages(broken, HdrImage(4, 4)));
    EXPECT_FALSE(compareImages(HdrImage(), HdrImage()));
    EXPECT_FALSE(compareImages(HdrImage(1, 1), HdrImage(1, 1), {.exposure = 0}));
}

}  // namespace
}  // namespace probegi

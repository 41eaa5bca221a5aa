// What a volume's books say of the coming update.
#include "field/frame_books.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <vector>

#include "kernels/trace/ray_set.h"

namespace probegi {
namespace {

FieldDesc smallDesc(FieldRules rules = FieldRules::measured) {
    FieldDesc d;
    d.raysPerProbe = 20;
    d.fixedRays = 12;
    d.hysteresis = 0.9f;
    d.visibilityHysteresis = 0.8f;
    d.rules = rules;
    return d;
}

TEST(FrameBooks, thePapersRaysAreTheFibonacciSetTurned) {
    FrameBooks books(smallDesc(FieldRules::paper));
    ASSERT_EQ(books.rayDirections().size(), 20u);
    const std::vector<glm::vec3> first(books.rayDirections().begin(), books.rayDirections().end());
    books.advance();
    EXPECT_NE(books.rayDirections()[0], first[0]);
    for (std::uint32_t i = 1; i < 20; ++i) {
        const float angle = glm::dot(kernels::sphericalFibonacci(0, 20), kernels::sphericalFibonacci(i, 20));
        EXPECT_NEAR(glm::dot(first[0], first[i]), angle, 1e-5f);
        EXPECT_NEAR(glm::dot(books.rayDirections()[0], books.rayDirections()[i]), angle, 1e-5f);
    }
}

TEST(FrameBooks, anAverageHasThePapersRays) {
    FrameBooks books(smallDesc()), paper(smallDesc(FieldRules::paper));
    const glm::vec3 shifted = books.rayDirections()[3];
    books.setAveraging(true);
    EXPECT_EQ(books.rayDirections()[3], paper.rayDirections()[3]);
    books.advance(), paper.advance();
    EXPECT_EQ(books.rayDirections()[3], paper.rayDirections()[3]);
    books.advance(false);
    EXPECT_EQ(books.rayDirections()[3], paper.rayDirections()[3]) << "the same rays again";
    FrameBooks again(smallDesc());
    again.setAveraging(true);
    again.setAveraging(false);
    EXPECT_EQ(again.rayDirections()[3], shifted);
}

// Each ray stays in its own band about one axis, which keeps areas: after many updates every height was seen as often.
TEST(FrameBooks, raysAreShiftedEvenlyOverTheirBands) {
    FieldDesc desc = smallDesc();
    desc.raysPerProbe = 144;
    FrameBooks books(desc);
    const glm::mat3 back = glm::transpose(kernels::frameRotation(kernels::hashCombine(1u, 0u), 0u));
    constexpr int kFrames = 200;
    std::vector<float> heights;
    for (int frame = 0; frame < kFrames; ++frame, books.advance())
        for (int i = 0; i < 144; ++i) {
            const glm::vec3 d = back * books.rayDirections()[std::size_t(i)];
            EXPECT_NEAR(glm::length(d), 1.0f, 1e-5f);
            const float inBand = (1 - d.z) * 72 - float(i);
            EXPECT_TRUE(inBand > -1e-3f && inBand < 1.001f) << i << " of update " << frame;
            if (i == 7) heights.push_back(inBand);
        }
    std::sort(heights.begin(), heights.end());
    for (int k = 0; k < kFrames; ++k)
        EXPECT_NEAR(heights[std::size_t(k)], (float(k) + 0.5f) / kFrames, 0.03f) << "random ones deviate by 0.1";
}

TEST(FrameBooks, fixedRaysStandStillAndThePaperHasNone) {
    FrameBooks books(smallDesc());
    books.advance();
    ASSERT_EQ(books.fixedRayDirections().size(), 12u);
    for (std::uint32_t i = 0; i < 12; ++i) EXPECT_EQ(books.fixedRayDirections()[i], kernels::sphericalFibonacci(i, 12));
    EXPECT_TRUE(FrameBooks(smallDesc(FieldRules::paper)).fixedRayDirections().empty());
}

TEST(FrameBooks, theMeasuredRulesHaveWindows) {
    FrameBooks books(smallDesc());
    const UpdateFrame first = books.comingUpdate();
    EXPECT_TRUE(first.windows && first.linear);
    EXPECT_FALSE(first.bounces);
    EXPECT_EQ(first.directions.size(), 20u);
    EXPECT_EQ(first.fixedDirections.size(), 12u);
    EXPECT_EQ(first.longestWindow, 200.0f);
    books.advance();
    EXPECT_EQ(books.frame(), 1);
    EXPECT_TRUE(books.comingUpdate().bounces);
    EXPECT_EQ(first.longestVisibilityWindow, 100.0f);
    EXPECT_NE(books.comingUpdate().ditherSeed, first.ditherSeed);
    EXPECT_NE(books.comingUpdate().raySeed, first.raySeed);
    EXPECT_NE(first.raySeed, first.ditherSeed);
}

// Who brings no fixed rays cannot tell of a change: old light fades at the described rate, also after an event.
TEST(FrameBooks, withoutFixedRaysTheHysteresisIsTheLongestWindow) {
    FrameBooks books(smallDesc());
    books.advance();
    const UpdateFrame without = books.comingUpdateWithoutFixedRays();
    EXPECT_TRUE(without.windows);
    EXPECT_TRUE(without.fixedDirections.empty());
    EXPECT_NEAR(without.longestWindow, 10.0f, 1e-4f);
    EXPECT_NEAR(without.longestVisibilityWindow, 5.0f, 1e-4f) << "1 / (1 - 0.8)";
    FieldDesc none = smallDesc();
    none.fixedRays = 0;
    FrameBooks bare(none);
    bare.advance();
    EXPECT_NEAR(bare.comingUpdate().longestWindow, 10.0f, 1e-4f);
    EXPECT_NEAR(bare.comingUpdate().longestVisibilityWindow, 5.0f, 1e-4f);
    books.notify(FieldEvent::largeLightChange);
    EXPECT_NEAR(books.comingUpdate().longestWindow, 1 / (1 - 0.45f), 1e-4f);
    EXPECT_EQ(books.comingUpdate().longestVisibilityWindow, 100.0f) << "light changes no distance";
    books.notify(FieldEvent::largeObjectChange);
    EXPECT_NEAR(books.comingUpdate().longestVisibilityWindow, 1 / (1 - 0.4f), 1e-4f);
    EXPECT_EQ(books.comingUpdate().fixedDirections.size(), 12u);
}

TEST(FrameBooks, thePaperHasItsHysteresis) {
    FrameBooks books(smallDesc(FieldRules::paper));
    EXPECT_EQ(books.comingUpdate().hysteresis.irradiance, 0.0f);
    books.advance();
    const UpdateFrame frame = books.comingUpdate();
    EXPECT_FALSE(frame.windows || frame.linear);
    EXPECT_TRUE(frame.fixedDirections.empty());
    EXPECT_EQ(frame.hysteresis.irradiance, 0.9f);
    EXPECT_EQ(frame.hysteresis.visibility, 0.8f);
}

TEST(FrameBooks, averagesKeepWhatTheyAreTold) {
    FrameBooks books(smallDesc());
    const UpdateFrame frame = books.comingAverage({0.3f, 0.6f});
    EXPECT_TRUE(frame.linear);
    EXPECT_FALSE(frame.windows);
    EXPECT_TRUE(frame.fixedDirections.empty());
    EXPECT_EQ(frame.hysteresis.irradiance, 0.3f);
    EXPECT_EQ(frame.hysteresis.visibility, 0.6f);
}

// The same rays again bring the same light: only the dither differs.
TEST(FrameBooks, raysThatDoNotTurnAreTheSame) {
    FrameBooks books(smallDesc());
    const std::vector<glm::vec3> rays(books.rayDirections().begin(), books.rayDirections().end());
    const UpdateFrame before = books.comingUpdate();
    books.advance(false);
    EXPECT_TRUE(std::equal(rays.begin(), rays.end(), books.rayDirections().begin()));
    EXPECT_EQ(books.comingUpdate().raySeed, before.raySeed);
    EXPECT_NE(books.comingUpdate().ditherSeed, before.ditherSeed);
    EXPECT_EQ(books.frame(), 1);
}

TEST(FrameBooks, volumesDifferByTheirWholeSeed) {
    FieldDesc one = smallDesc(), two = smallDesc();
    one.seed = 5;
    two.seed = 5 + (std::uint64_t(1) << 40);
    EXPECT_NE(FrameBooks(one).rayDirections()[0], FrameBooks(two).rayDirections()[0]);
    EXPECT_NE(FrameBooks(one).comingUpdate().ditherSeed, FrameBooks(two).comingUpdate().ditherSeed);
    EXPECT_EQ(FrameBooks(one).rayDirections()[3], FrameBooks(one).rayDirections()[3]);
}

TEST(FrameBooks, eventsEnd) {
    FrameBooks books(smallDesc(FieldRules::paper));
    books.advance();
    books.notify(FieldEvent::smallLightChange);
    for (int i = 0; i < 4; ++i) {
        EXPECT_FLOAT_EQ(books.comingUpdate().hysteresis.irradiance, 0.9f * 0.85f);
        books.advance();
    }
    EXPECT_FLOAT_EQ(books.comingUpdate().hysteresis.irradiance, 0.9f);
    books.setGuard(LeakGuard::none);
    EXPECT_EQ(books.comingUpdate().desc.guard, LeakGuard::none);
    EXPECT_GE(books.bytes(), 32 * sizeof(glm::vec3));
}

}  // namespace
}  // namespace probegi

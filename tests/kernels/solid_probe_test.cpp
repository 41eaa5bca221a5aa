#include "kernels/probe/solid_probe.h"

#include <gtest/gtest.h>

namespace probegi::kernels {
namespace {

/// A probe just behind a curtain: as many backs as fronts.
constexpr ProbeSides kDoubtful{0.45f, 0.5f, kNoWayOut, kNoWayOut, 0u};

TEST(SolidProbe, frontsAndBacksTellRoomsFromWalls) {
    EXPECT_FALSE(mayBeSolid({0.2f, 0.7f, 0u, 0u, 0u}));
    EXPECT_TRUE(mayBeSolid({0.3f, 0.7f, 0u, 0u, 0u}));
    EXPECT_FALSE(mayBeSolid({0, 0, 0u, 0u, 0u})) << "hits nothing";
    EXPECT_TRUE(looksForWay(kDoubtful));
    EXPECT_FALSE(looksForWay({1.0f, 0.0f, 0u, 0u, 0u})) << "in a wall";
    EXPECT_FALSE(looksForWay({0.4f, 0.1f, 0u, 0u, 0u})) << "in the void around a level";
    EXPECT_FALSE(looksForWay({0.1f, 0.9f, 0u, 0u, 0u})) << "in a room";
}

TEST(SolidProbe, aNewProbeIsNeitherSolidNorOpen) {
    EXPECT_FALSE(mayBeSolid(noSides()));
    EXPECT_FALSE(mayBeOpen(noSides()));
}

TEST(SolidProbe, whatIsRememberedFollowsTheHysteresis) {
    const ProbeSides sides = rememberSides({0.5f, 0.25f, 3u, 7u, 5u}, {60, 20, 10}, 100, 0.75f);
    EXPECT_FLOAT_EQ(sides.backs, 0.75f * 0.5f + 0.25f * 0.2f);
    EXPECT_FLOAT_EQ(sides.fronts, 0.75f * 0.25f + 0.25f * 0.4f);
    EXPECT_EQ(sides.steps, 7u);
}

TEST(SolidProbe, backsOfTwoSidesCountWhereNoWayLeadsOut) {
    const SidesSeen seen{80, 40, 4};
    ProbeSides sides = kDoubtful;
    EXPECT_FLOAT_EQ(solidShare(sides, seen, 100), 0.5f);
    sides.steps = 2;
    EXPECT_FLOAT_EQ(solidShare(sides, seen, 100), 0.05f);
    EXPECT_FLOAT_EQ(solidShare(sides, {80, 78, 4}, 100), 78.0f / 80) << "a door moved over it";
    sides.steps = 0;
    EXPECT_FLOAT_EQ(solidShare(sides, seen, 100), 0.5f) << "0 steps is no way for a probe in doubt";
    EXPECT_FLOAT_EQ(solidShare({0.1f, 0.8f, 0u, 0u, 0u}, seen, 100), 0.05f);
    EXPECT_FLOAT_EQ(solidShare(sides, {0, 0, 0}, 100), 0.0f);
}

TEST(SolidProbe, aWallBetweenTwoProbesLeavesNoFreeWay) {
    // With a surface in between, the distances that the two see add up to the line between them.
    for (float share = 0; share <= 1; share += 0.1f) EXPECT_FALSE(freeWay(share, 1 - share, 1.0f));
    EXPECT_TRUE(freeWay(1.0f, 1.0f, 1.0f));
    EXPECT_FALSE(freeWay(1.0f, 0.75f, 1.0f));
    EXPECT_FALSE(freeWay(0.75f, 1.0f, 1.0f));
}

TEST(SolidProbe, waysOpenWithTrustAndCloseWithoutIt) {
    ProbeSides sides = kDoubtful;
    for (uint update = 1; update < kEnoughTrust; ++update) {
        sides = foundWay(sides, 3);
        EXPECT_EQ(sides.nextSteps, kNoWayOut);
        sides.steps = sides.nextSteps;
    }
    for (uint update = 0; update < 20; ++update) {
        sides = foundWay(sides, 3);
        EXPECT_EQ(sides.nextSteps, 3u);
        sides.steps = sides.nextSteps;
    }
    EXPECT_EQ(sides.trust, kMostTrust);
    for (uint update = 1; update < kMostTrust; ++update) {
        sides = foundWay(sides, kNoWayOut);
        EXPECT_EQ(sides.nextSteps, 3u) << "noise";
        sides.steps = sides.nextSteps;
    }
    EXPECT_EQ(foundWay(sides, kNoWayOut).nextSteps, kNoWayOut);
    EXPECT_EQ(foundWay({0.0f, 0.9f, kNoWayOut, kNoWayOut, 5u}, kNoWayOut).nextSteps, 0u) << "in the open";
    EXPECT_EQ(foundWay({1.0f, 0.0f, 3u, 3u, 16u}, kNoWayOut).nextSteps, kNoWayOut) << "in a wall";
}

TEST(SolidProbe, waysHaveAnEnd) {
    EXPECT_EQ(stepsBy(0u), 1u);
    EXPECT_EQ(stepsBy(kLongestWay - 1), kLongestWay);
    EXPECT_EQ(stepsBy(kLongestWay), kNoWayOut);
    EXPECT_EQ(stepsBy(kNoWayOut), kNoWayOut);
}

// The thresholds as documented, from both sides.
TEST(SolidProbe, linesAreWhereTheyAreSaidToBe) {
    EXPECT_FALSE(mayBeOpen({0, 0.149f, 0u, 0u, 0u}));
    EXPECT_TRUE(mayBeOpen({0, 0.151f, 0u, 0u, 0u}));
    EXPECT_FALSE(mayBeSolid({0.249f, 0.751f, 0u, 0u, 0u}));
    EXPECT_TRUE(mayBeSolid({0.251f, 0.749f, 0u, 0u, 0u}));
    EXPECT_FALSE(freeWay(1.59f, 9, 2));
    EXPECT_FALSE(freeWay(9, 1.59f, 2));
    EXPECT_TRUE(freeWay(1.61f, 1.61f, 2));
    EXPECT_EQ(stepsBy(15u), 16u);
    EXPECT_EQ(stepsBy(16u), kNoWayOut);
    // A path opens after 12 updates, and stays open for 16 more without being found again.
    ProbeSides sides = kDoubtful;
    for (int update = 1; update <= 40; ++update) {
        sides = foundWay(sides, 2);
        EXPECT_EQ(sides.nextSteps == 2u, update >= 12) << update;
        sides.steps = sides.nextSteps;
    }
    for (int update = 1; update <= 20; ++update) {
        sides = foundWay(sides, kNoWayOut);
        EXPECT_EQ(sides.nextSteps == 2u, update < 16) << update;
        sides.steps = sides.nextSteps;
    }
}

// If hardly any front is visible (3 % of the rays), no path counts.
TEST(SolidProbe, enclosedProbesAreSolidAtOnce) {
    const ProbeSides open{0.45f, 0.5f, 2u, 2u, 16u};
    EXPECT_FLOAT_EQ(solidShare(open, {83, 80, 0}, 100), 80.0f / 83);
    EXPECT_FLOAT_EQ(solidShare(open, {84, 80, 0}, 100), 0);
    EXPECT_FLOAT_EQ(solidShare(open, {84, 80, 21}, 100), 0.25f);
}

TEST(SolidProbe, packedSidesAddUp) {
    uint packed = 0;
    for (int ray = 0; ray < 256; ++ray) packed += packSides(true, ray % 2 == 0, ray % 4 == 0);
    const SidesSeen seen = addSides(addSides({0, 0, 0}, packed), packSides(true, true, false));
    EXPECT_EQ(seen.hits, 257);
    EXPECT_EQ(seen.backs, 129);
    EXPECT_EQ(seen.solidBacks, 64);
}

}  // namespace
}  // namespace probegi::kernels

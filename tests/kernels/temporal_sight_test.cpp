// Results of the fixed rays (kernels/blend/temporal_filter.h): lobes, their sums, and the lag between two of them.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "kernels/blend/temporal_filter.h"

namespace probegi::kernels {
namespace {

vec3 octant(int i) {
    return vec3(i & 1 ? -1 : 1, i & 2 ? -1 : 1, i & 4 ? -1 : 1) / std::sqrt(3.0f);
}

TEST(ProbeSight, lobesAreOctantsAndPairsOfThem) {
    std::set<int> lobes, pairs;
    for (int i = 0; i < 8; ++i) {
        lobes.insert(sightLobe(octant(i)));
        pairs.insert(distanceLobe(sightLobe(octant(i))));
        EXPECT_EQ(sightLobe(octant(i)), sightLobe(octant(i) * vec3(0.1f, 3, 1))) << "the octant alone decides";
    }
    EXPECT_EQ(lobes.size(), 8u);
    EXPECT_EQ(pairs.size(), 4u);
    EXPECT_TRUE(*lobes.begin() == 0 && *lobes.rbegin() == 7 && *pairs.begin() == 0 && *pairs.rbegin() == 3);
}

// Two rays in one lobe, one in each of the others: means by lobe, by pair, and of all.
TEST(ProbeSight, isTheMeanOfEachLobe) {
    SightSum sum = noSight();
    for (int i = 0; i < 8; ++i) addToSight(sum, octant(i), float(i), 10.0f * float(i), 0.5f * float(i), 4);
    addToSight(sum, octant(3), 9, 26, 3.5f, 4);
    const ProbeSight sight = sightOf(sum);
    for (int i = 0; i < 8; ++i) EXPECT_FLOAT_EQ(sight.direct[sightLobe(octant(i))], i == 3 ? 6 : float(i)) << i;
    EXPECT_FLOAT_EQ(sight.bounced, (280.0f + 26) / 9);
    const int pair = distanceLobe(sightLobe(octant(3)));
    float distance = 3.5f, rays = 1;
    for (int i = 0; i < 8; ++i)
        if (distanceLobe(sightLobe(octant(i))) == pair) distance += 0.5f * float(i), ++rays;
    EXPECT_FLOAT_EQ(sight.distance[pair], distance / rays / 4);
}

TEST(ProbeSight, invalidLightCountsAsNone) {
    SightSum sum = noSight();
    addToSight(sum, octant(0), std::nanf(""), -1, std::nanf(""), 4);
    const ProbeSight sight = sightOf(sum);
    EXPECT_EQ(sight.direct[0], 0.0f);
    EXPECT_EQ(sight.bounced, 0.0f);
    EXPECT_EQ(sight.distance[0], 1.0f) << "a miss";
    EXPECT_EQ(sightOf(noSight()).direct[5], 0.0f);
    EXPECT_EQ(sightOf(noSight()).distance[2], 0.0f);
}

// For rays that turn, only the mean of all is comparable from update to update.
TEST(ProbeSight, ownRaysCountAsOneMean) {
    SightSum sum = noSight();
    addOwnRayToSight(sum, vec3(2.0f), 1);
    addOwnRayToSight(sum, vec3(4.0f), 1);
    addOwnRayToSight(sum, vec3(99.0f), -1);  // a backface
    const ProbeSight sight = sightOf(sum);
    for (const float direct : sight.direct) EXPECT_NEAR(direct, 2, 1e-5);
    EXPECT_EQ(sight.bounced, 0.0f);
}

ProbeFilter known(float direct, float bounced, float distance) {
    ProbeFilter f{};
    for (float& d : f.direct) d = direct;
    for (float& d : f.distance) d = distance;
    f.bounced = bounced;
    f.window = f.visibilityWindow = 10;
    return f;
}

ProbeSight even(float direct, float bounced, float distance) {
    ProbeSight s{};
    for (float& d : s.direct) d = direct;
    for (float& d : s.distance) d = distance;
    s.bounced = bounced;
    return s;
}

TEST(ProbeLag, isTheRootMeanSquareOverLobes) {
    ProbeSight now = even(3, 2, 0.5f);
    now.direct[5] = 3 + 4;
    const ProbeLag lag = probeLag(now, known(3, 1.5f, 0.5f));
    EXPECT_FLOAT_EQ(lag.direct, std::sqrt(16.0f / 8));
    EXPECT_FLOAT_EQ(lag.bounced, 0.5f);
    EXPECT_FLOAT_EQ(lag.level, 3.5f + 2) << "what is now is more than the average";
    EXPECT_EQ(lag.distance, 0.0f);
    EXPECT_FLOAT_EQ(probeLag(even(1, 0.5f, 0.5f), known(3, 1.5f, 0.5f)).level, 4.5f);
    EXPECT_FLOAT_EQ(probeLag(even(1, 0.5f, 0.5f), known(3, 1.5f, 0.5f)).bounced, -1);
}

TEST(ProbeLag, ofDistancesIsTheLargestRatio) {
    ProbeSight now = even(1, 0, 0.5f);
    now.distance[2] = 0.25f;
    now.distance[1] = 0.6f;
    EXPECT_FLOAT_EQ(probeLag(now, known(1, 0, 0.5f)).distance, 0.5f);
    now.distance[2] = 1;
    EXPECT_FLOAT_EQ(probeLag(now, known(1, 0, 0.5f)).distance, 0.5f) << "the same either way";
    EXPECT_EQ(probeLag(now, known(1, -1, 0.5f)).distance, 0.0f) << "nothing to compare with";
}

TEST(ProbeLag, probesInWallsAreIgnored) {
    const ProbeLag lag{1, 2, 3, 4}, heard = lagHeard(lag, 0.29f), unheard = lagHeard(lag, 0.31f);
    EXPECT_TRUE(heard.direct == 1 && heard.bounced == 2 && heard.level == 3 && heard.distance == 4);
    EXPECT_TRUE(unheard.direct == 0 && unheard.bounced == 0 && unheard.level == 0 && unheard.distance == 0);
}

// A neighbour's lag counts by half, for light and for distances.
TEST(ProbeLag, neighboursCountHalf) {
    const ProbeLag lag{0.4f, 0.1f, 2, 0.6f};
    LagAround own = noLag(), neighbour = noLag();
    addLag(own, lag, 2, true);
    addLag(neighbour, lag, 2, false);
    EXPECT_FLOAT_EQ(own.direct, 0.2f);
    EXPECT_FLOAT_EQ(neighbour.direct, 0.1f);
    EXPECT_FLOAT_EQ(own.distance, 0.6f);
    EXPECT_FLOAT_EQ(neighbour.distance, 0.3f);
    addLag(own, {0, 0.3f, 4, 0}, 4, false);
    EXPECT_FLOAT_EQ(own.direct, 0.2f) << "the largest";
    EXPECT_FLOAT_EQ(own.bounced, 0.4f) << "the sum";
    EXPECT_FLOAT_EQ(own.level, 6);
}

// Light and distances have different windows, so their averages move at different rates.
TEST(ProbeFilterTest, averagesMoveAtTheirOwnRates) {
    ProbeFilter f = known(1, 1, 0.2f);
    f.window = 4;
    f.visibilityWindow = 10;
    advanceFilter(f, even(5, 9, 0.7f));
    EXPECT_FLOAT_EQ(f.direct[6], 2);
    EXPECT_FLOAT_EQ(f.bounced, 3);
    EXPECT_FLOAT_EQ(f.distance[3], 0.25f);
    f.window = 0.5f;  // below 1: nothing of the old is kept
    advanceFilter(f, even(7, 8, 0.7f));
    EXPECT_FLOAT_EQ(f.direct[0], 7);
    EXPECT_FLOAT_EQ(f.bounced, 8);
}

// Every number is unpacked from its own place, to a step of a half float.
TEST(ProbeFilterTest, packingKeepsEachNumberInItsPlace) {
    ProbeFilter f{};
    for (int i = 0; i < 8; ++i) f.direct[i] = 1 + float(i);
    for (int i = 0; i < 4; ++i) f.distance[i] = 0.1f + 0.2f * float(i);
    f.bounced = 0.5f;
    f.noise = 0.25f;
    f.window = 17;
    f.visibilityWindow = 33;
    const ProbeFilter back = unpackFilter(packFilter(f, 0x12345678u));
    for (int i = 0; i < 8; ++i) EXPECT_NEAR(back.direct[i] / f.direct[i], 1, 6e-3) << i;
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(back.distance[i] / f.distance[i], 1, 1.5e-3) << i;
    EXPECT_NEAR(back.bounced / f.bounced, 1, 6e-3);
    EXPECT_NEAR(back.noise / f.noise, 1, 1.5e-3);
    EXPECT_EQ(back.window, 17);
    EXPECT_EQ(back.visibilityWindow, 33);
    f.bounced = 0;
    EXPECT_FALSE(isUnknown(unpackFilter(packFilter(f, 0)))) << "darkness is known";
    f.bounced = -1;
    EXPECT_TRUE(isUnknown(unpackFilter(packFilter(f, 0))));
}

TEST(ProbeFilterTest, forgottenWindowsStayInRange) {
    for (const auto& [window, kept] : {std::pair{0.0f, 1.0f}, {5.0f, 5.0f}, {1e9f, kLongestWindow}}) {
        const ProbeFilter f = unpackFilter(forgottenFilter(window));
        EXPECT_EQ(f.window, kept);
        EXPECT_EQ(f.visibilityWindow, kept);
        EXPECT_EQ(f.direct[7], 0.0f);
        EXPECT_EQ(f.noise, 0.0f);
    }
}

TEST(TexelChangeTest, joinsPartsAndSumsChannels) {
    TexelChange whole = noChange(), left = noChange(), right = noChange();
    const vec3 old(1.0f, 0.5f, 0.25f);
    addTexelChange(whole, old, {2, 3, 4});
    addTexelChange(whole, vec3(1.0f), {1, 0, 1});
    addTexelChange(left, old, {2, 3, 4});
    addTexelChange(right, vec3(1.0f), {1, 0, 1});
    joinChanges(left, right);
    EXPECT_FLOAT_EQ(left.square, whole.square);
    EXPECT_FLOAT_EQ(left.before, whole.before);
    EXPECT_FLOAT_EQ(left.now, whole.now);
    const float before = 1 + 1.0f / 32 + 1.0f / 1024;
    EXPECT_FLOAT_EQ(whole.before, before + 3);
    EXPECT_FLOAT_EQ(whole.now, 9 + 2);
    EXPECT_FLOAT_EQ(whole.square, (9 - before) * (9 - before) + 1);
    // Relative to the mean square of the larger level.
    EXPECT_FLOAT_EQ(relativeChange(whole, 2), whole.square / 2 / (5.5f * 5.5f));
}

}  // namespace
}  // namespace probegi::kernels

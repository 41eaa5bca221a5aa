#include "kernels/lookup/used_probes.h"

#include <gtest/gtest.h>

#include <random>

#include "kernels/lookup/cage.h"

namespace probegi::kernels {
namespace {

Volume makeVolume(bool turned) {
    Volume v{};
    v.origin = vec3(-1, 2, -3);
    v.spacing = vec3(1.0f, 0.5f, 0.75f);
    v.inverseSpacing = 1.0f / v.spacing;
    v.minSpacing = 0.5f;
    v.counts = ivec3(5, 6, 4);
    v.turned = turned ? 1 : 0;
    v.orientation = turned ? vec4(0.1f, 0.7f, -0.1f, 0.7f) / std::sqrt(1.0f) : vec4(0, 0, 0, 1);
    return v;
}

bool holds(const UsedProbes& used, ivec3 cell) {
    for (int axis = 0; axis < 3; ++axis)
        if (cell[axis] < used.lowest[axis] || cell[axis] > used.highest[axis]) return false;
    return true;
}

TEST(UsedProbes, holdAllThatALookUpReads) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> unit(-1.0f, 1.0f);
    const auto vector = [&] {
        const float x = unit(random), y = unit(random), z = unit(random);
        return vec3(x, y, z);
    };
    for (int i = 0; i < 20000; ++i) {
        const Volume v = makeVolume(i % 2 == 1);
        const int rules = i % 4 < 2 ? kRulesMeasured : kRulesPaper;
        const vec3 inVolume = v.origin + (vector() * 0.5f + 0.5f) * v.spacing * vec3(v.counts - 1);
        const vec3 point = toWorldDirection(v, inVolume - v.origin) + v.origin;
        const vec3 normal = normalize(vector());
        vec3 viewer = normalize(vector());
        if (dot(viewer, normal) < 0) viewer = -viewer;
        const UsedProbes used = usedProbes(v, point, normal, 0.3f, rules);
        const Cage cage = cageAround(v, point, normal, viewer, 0.3f, rules);
        const ivec3 base(cage.base);
        ASSERT_TRUE(holds(used, base) && holds(used, base + 1)) << i;
        if (rules == kRulesPaper) continue;
        // The layer beyond the cage's front, where there is one.
        const int axis = dominantAxis(cage.normal);
        ivec3 beyond = base;
        beyond[axis] += cage.normal[axis] > 0 ? 2 : -1;
        ASSERT_TRUE(!isInVolume(v, beyond) || holds(used, beyond)) << i;
    }
}

TEST(UsedProbes, areFew) {
    const Volume v = makeVolume(false);
    const UsedProbes used = usedProbes(v, v.origin + vec3(1.5f, 1.25f, 1.1f), {0, 1, 0}, 0.3f, kRulesMeasured);
    EXPECT_EQ(used.lowest, ivec3(1, 2, 1));
    EXPECT_EQ(used.highest, ivec3(2, 4, 2));
    const UsedProbes paper = usedProbes(v, v.origin + vec3(1.5f, 1.25f, 1.1f), {0, 1, 0}, 0.3f, kRulesPaper);
    EXPECT_EQ(paper.lowest, ivec3(1, 2, 1));
    EXPECT_EQ(paper.highest, ivec3(2, 3, 2));
}

TEST(UsedProbes, outsideTheVolumeTheyAreItsNearestCell) {
    const Volume v = makeVolume(false);
    for (const float far : {0.4f, 0.6f, 50.0f}) {
        const UsedProbes used = usedProbes(v, v.origin - vec3(far, -1.25f, -1.1f), {1, 0, 0}, 0.3f, kRulesMeasured);
        EXPECT_EQ(used.lowest, ivec3(0, 2, 1)) << far;
        EXPECT_EQ(used.highest, ivec3(2, 3, 2)) << far;
    }
}

}  // namespace
}  // namespace probegi::kernels

// The look-up in one volume, in fields of closed form.
#include "kernels/lookup/irradiance.h"

#include <gtest/gtest.h>

#include <functional>
#include <random>
#include <vector>

#include "kernels/guards/guards.h"
#include "kernels/guards/list.h"
#include "kernels/guards/moments.h"
#include "kernels/guards/none.h"
#include "kernels/lookup/access.h"
#include "kernels/lookup/cage.h"
#include "kernels/lookup/cage_weights.h"
#include "kernels/lookup/gather.h"

namespace probegi::kernels {
namespace {

constexpr int kNone = 0, kMoments = 1;

// A field that is a function of slot and direction.
struct FormulaField {
    using MapPoint = vec3;
    int rules = kRulesMeasured;
    int guard = kNone;
    float selfShadowBias = 0.3f;
    int maskTexels = 2, maskPacked = 0;
    std::function<vec3(int, vec3)> radiance = [](int, vec3) { return vec3(1.0f); };
    std::function<vec2(int, vec3)> moments = [](int, vec3) { return vec2(1.0f, 1.0f); };
    std::function<float(int)> backs = [](int) { return 0.0f; };
    std::function<int(int)> placement = [](int) { return 0; };
    std::array<float, 8> given = {1, 1, 1, 1, 1, 1, 1, 1};
    std::vector<std::uint32_t> masks;
    int blockers = 0;
    mutable int fallbacks = 0;

    friend int maskWord(const FormulaField& f, int number) { return int(f.masks.at(std::size_t(number))); }
    friend SdfBlocker blockerAt(const FormulaField&, int) { return {}; }
    friend vec3 visibilityPoint(const FormulaField&, vec3 direction) { return normalize(direction); }
    friend vec3 irradiancePoint(const FormulaField&, vec3 normal) { return normal; }
    friend vec3 axisPoint(const FormulaField&, const Volume& v, int axis, bool up) {
        return axisDirection(v, axis, up);
    }
    friend void storedMoments(const FormulaField& f, int slot, vec3 at, float& mean, float& meanSquare) {
        const vec2 m = f.moments(slot, at);
        mean = m.x;
        meanSquare = m.y;
    }
    friend void momentsOnAxis(const FormulaField& f, const Volume&, int slot, vec3 at, float& mean, float& square) {
        storedMoments(f, slot, at, mean, square);
    }
    friend float storedBackfaceShare(const FormulaField& f, int slot) { return f.backs(slot); }
    friend int storedPlacement(const FormulaField& f, int slot) { return f.placement(slot); }
    friend vec3 storedIrradiance(const FormulaField& f, int slot, vec3 at) {
        return pow(f.radiance(slot, at), vec3(0.2f));
    }
    friend float givenVisibility(const FormulaField& f, int corner) { return f.given[std::size_t(corner)]; }
    friend void countFallback(const FormulaField& f) { ++f.fallbacks; }
};

// From (-1, 2, -3) to (3, 4.5, -0.75).
Volume makeVolume(ivec3 phase = ivec3(0), int firstSlot = 0) {
    Volume v{};
    v.origin = vec3(-1, 2, -3);
    v.spacing = vec3(1.0f, 0.5f, 0.75f);
    v.inverseSpacing = 1.0f / v.spacing;
    v.minSpacing = 0.5f;
    v.inverseMaxDistance = 0.4f;
    v.counts = ivec3(5, 6, 4);
    v.phase = phase;
    v.firstSlot = firstSlot;
    v.orientation = vec4(0, 0, 0, 1);
    return v;
}

struct Question {
    vec3 point, normal, viewer;
};

// In and around the volume; a third of the normals are along an axis, a fifth have no viewer.
std::vector<Question> questions(int count) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> unit(-1.0f, 1.0f);
    const auto vector = [&] {
        const float x = unit(random), y = unit(random), z = unit(random);
        return vec3(x, y, z);
    };
    std::vector<Question> result;
    for (int i = 0; i < count; ++i) {
        vec3 normal = normalize(vector());
        if (i % 3 == 0) {
            normal = vec3(0.0f);
            normal[i / 3 % 3] = i % 2 == 0 ? 1.0f : -1.0f;
        }
        result.push_back({vec3(1, 3.25f, -1.9f) + vector() * vec3(2.5f, 1.8f, 1.6f), normal,
                          i % 5 == 0 ? vec3(0.0f) : normalize(vector())});
    }
    return result;
}

vec3 answer(const FormulaField& field, const Volume& v, const Question& q) {
    return irradianceIn(field, v, q.point, q.normal, q.viewer);
}

void expectNear(vec3 got, vec3 want, float relative) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(got[c], want[c], relative * std::abs(want[c])) << c;
}

// Light, walls and distances that vary from cell to cell and with the direction, in the volume's frame.
FormulaField variedField(const Volume& v, int guard, int rules) {
    FormulaField field;
    field.guard = guard;
    field.rules = rules;
    const auto sum = [v](int slot) {
        const ivec3 cell = probeCell(v, slot);
        return float((cell.x * 7 + cell.y * 5 + cell.z * 3) % 11);
    };
    field.radiance = [=](int slot, vec3 at) {
        const vec3 d = toVolumeDirection(v, at);
        return vec3(0.2f + 0.1f * sum(slot), 1.0f + 0.5f * d.x, 1.0f + 0.3f * d.y * d.z);
    };
    field.moments = [=](int slot, vec3 at) {
        const float mean = 0.2f + 0.03f * sum(slot) + 0.1f * toVolumeDirection(v, at).y;
        return vec2(mean, mean * mean * 1.05f);
    };
    field.backs = [=](int slot) { return sum(slot) > 6.0f ? 0.28f : 0.0f; };
    return field;
}

template <class Check>
void forEachKind(Check check) {
    for (const int guard : {kNone, kMoments})
        for (const int rules : {kRulesMeasured, kRulesPaper}) check(guard, rules);
}

// Inside, on faces and outside, with any guard, walls, orientation and phase.
TEST(Lookup, aConstantFieldIsConstantEverywhere) {
    Volume turned = makeVolume({3, 1, 2}, 40);
    turned.turned = 1;
    turned.orientation = normalize(vec4(0.3f, -0.5f, 0.2f, 0.8f));
    forEachKind([&](int guard, int rules) {
        for (const Volume& v : {makeVolume(), turned}) {
            FormulaField field = variedField(v, guard, rules);
            field.radiance = [](int, vec3) { return vec3(1, 32, 0.5f); };
            for (const Question& q : questions(300)) expectNear(answer(field, v, q), kPi * vec3(1, 32, 0.5f), 1e-5f);
        }
    });
}

// A probe's place in its ring, and a volume's in the pool, change no bit.
TEST(Lookup, phaseAndFirstSlotChangeNothing) {
    forEachKind([](int guard, int rules) {
        const Volume plain = makeVolume();
        const FormulaField field = variedField(plain, guard, rules);
        for (const ivec3 phase : {ivec3(1, 0, 0), ivec3(4, 5, 3), ivec3(2, 3, 1)}) {
            const Volume scrolled = makeVolume(phase, 1000);
            const FormulaField same = variedField(scrolled, guard, rules);
            for (const Question& q : questions(300)) EXPECT_EQ(answer(same, scrolled, q), answer(field, plain, q));
            EXPECT_EQ(same.fallbacks % 300, field.fallbacks % 300);
        }
    });
}

// If a volume is turned together with its probes' contents and the query, the result stays the same. With a visibility
// test, rounding may choose another side of a step.
TEST(Lookup, aTurnedVolumeAnswersTurnedQuestions) {
    forEachKind([](int guard, int rules) {
        const Volume plain = makeVolume();
        Volume turned = makeVolume();
        turned.turned = 1;
        turned.orientation = normalize(vec4(0.3f, -0.5f, 0.2f, 0.8f));
        const FormulaField field = variedField(plain, guard, rules), same = variedField(turned, guard, rules);
        for (const Question& q : questions(600)) {
            const Question there{toWorldDirection(turned, q.point - turned.origin) + turned.origin,
                                 toWorldDirection(turned, q.normal), toWorldDirection(turned, q.viewer)};
            expectNear(answer(same, turned, there), answer(field, plain, q), 2e-3f);
        }
    });
}

// In the middle of a cell, by the paper's rules: only the facing differs between the probes.
TEST(CageWeights, areTheProductOfTheirParts) {
    const Volume v = makeVolume();
    FormulaField field;
    field.rules = kRulesPaper;
    const vec3 middle = v.origin + vec3(1.5f) * v.spacing, normal(0, 1, 0);
    const Cage cage = cageAround(v, middle, normal, normal, 0.3f, kRulesPaper);
    const CageWeights w = weighCage(field, v, cage);
    const float cosine = 0.25f / (0.5f * length(v.spacing) + kProbeRadius * 0.5f);
    float sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const bool above = (corner & 2) != 0;
        const float wrap = 0.5f + (above ? 0.5f : -0.5f) * cosine;
        EXPECT_NEAR(w.weight[corner], 0.125f * (wrap * wrap + 0.2f), 1e-5f);
        EXPECT_EQ(w.slot[corner], probeSlot(v, ivec3(1 + (corner & 1), 1 + (corner >> 1 & 1), 1 + (corner >> 2))));
        sum += w.weight[corner];
    }
    EXPECT_NEAR(w.weightSum, sum, 1e-6f);
    EXPECT_EQ(w.trust, 0.0f);  // the paper has no pairs
    EXPECT_EQ(w.step, 0);
}

TEST(CageWeights, pairsLieAlongTheNormal) {
    const Volume v = makeVolume({4, 0, 3});
    FormulaField field;
    for (int axis = 0; axis < 3; ++axis)
        for (const float side : {-1.0f, 1.0f}) {
            vec3 normal(0.0f);
            normal[axis] = side;
            const vec3 at = v.origin + vec3(1.5f) * v.spacing;
            const Cage cage = cageAround(v, at, normal, normal, 0.3f, kRulesMeasured);
            const CageWeights w = weighCage(field, v, cage);
            ASSERT_EQ(w.axis, axis);
            EXPECT_EQ(w.trust, 1.0f);
            EXPECT_EQ(w.up, side > 0 ? 1 : 0);
            ivec3 step(0);
            step[axis] = side > 0 ? 1 : -1;
            float sum = 0;
            for (int k = 0; k < 4; ++k) {
                const int corner = frontCorner(w.axis, w.up, k);
                EXPECT_EQ(corner >> axis & 1, w.up);
                const ivec3 cell = ivec3(cage.base) + ivec3(corner & 1, corner >> 1 & 1, corner >> 2);
                EXPECT_EQ(w.slot[corner], probeSlot(v, cell));
                EXPECT_EQ(w.slot[corner] + w.step, probeSlot(v, cell + step)) << axis << side << k;
                const float alpha = side > 0 ? cage.alpha[axis] : 1 - cage.alpha[axis];
                EXPECT_NEAR(w.pair[k], w.weight[corner] / alpha, 1e-6f);
                EXPECT_EQ(pairOfCorner(w, corner), w.pair[k]);
                EXPECT_EQ(pairOfCorner(w, corner ^ (1 << axis)), 0.0f);
                sum += w.pair[k];
            }
            EXPECT_NEAR(w.pairSum, sum, 1e-6f);
            EXPECT_NEAR(w.cells, w.ahead * v.inverseSpacing[axis], 1e-6f);
        }
}

// At the volume's faces there is no further layer of probes.
TEST(CageWeights, pairsNeedALayerBeyond) {
    const Volume v = makeVolume();
    const FormulaField field;
    for (const float side : {-1.0f, 1.0f}) {
        const vec3 normal(0, side, 0), at = v.origin + vec3(2, side > 0 ? 4.5f : 0.5f, 2) * v.spacing;
        const CageWeights w = weighCage(field, v, cageAround(v, at, normal, normal, 0.3f, kRulesMeasured));
        EXPECT_EQ(w.trust, 0.0f);
        EXPECT_EQ(w.step, 0);
    }
}

// Another pass may provide which corners see the point: only they count.
TEST(CageWeights, givenVisibilityDecides) {
    const Volume v = makeVolume();
    FormulaField field;
    field.rules = kRulesPaper;
    field.radiance = [](int slot, vec3) { return vec3(float(1 + slot)); };
    const vec3 at = v.origin + vec3(1.5f) * v.spacing;
    for (int corner = 0; corner < 8; ++corner) {
        field.given = {};
        field.given[std::size_t(corner)] = 0.5f;
        const int slot = probeSlot(v, ivec3(1 + (corner & 1), 1 + (corner >> 1 & 1), 1 + (corner >> 2)));
        expectNear(irradianceIn(field, v, at, {0, 1, 0}, vec3(0.0f)), kPi * vec3(float(1 + slot)), 1e-4f);
    }
}

TEST(Gather, sumsByTheWeights) {
    CageWeights w;
    for (int corner = 0; corner < 8; ++corner) {
        w.slot[corner] = corner;
        w.weight[corner] = float(corner);
    }
    for (int k = 0; k < 4; ++k) w.pair[k] = 1.0f;
    w.axis = 1;
    w.up = 1;
    w.step = 10;
    FormulaField field;
    // The square root of the light is the slot.
    field.radiance = [](int slot, vec3) { return vec3(float(slot * slot), 1, 0); };
    const CageLight light = gatherLight(field, w, vec3(0, 1, 0));
    EXPECT_NEAR(light.root.x, 140.0f, 1e-3f);  // 0 + 1 + 4 + ... + 49
    EXPECT_NEAR(light.root.y, 28.0f, 1e-4f);
    EXPECT_EQ(light.root.z, 0.0f);
    EXPECT_NEAR(light.rise.x, 40.0f, 1e-3f);
    EXPECT_NEAR(light.rise.y, 0.0f, 1e-5f);
    EXPECT_NEAR(storedRoot(field, 3, vec3(0, 1, 0)).x, 3.0f, 1e-5f);
}

// All probes of the cage are in walls: the neighbours are used, and the fallback is counted.
TEST(Lookup, neighboursAnswerForACageInWalls) {
    const Volume v = makeVolume();
    FormulaField field;
    const ivec3 base(2, 2, 1);
    field.backs = [=](int slot) {
        const ivec3 from = probeCell(v, slot) - base;
        const bool inCage = from.x >= 0 && from.y >= 0 && from.z >= 0 && from.x < 2 && from.y < 2 && from.z < 2;
        return inCage ? 1.0f : 0.0f;
    };
    field.radiance = [=](int slot, vec3) { return field.backs(slot) > 0.5f ? vec3(100.0f) : vec3(2.0f); };
    const vec3 at = v.origin + (vec3(base) + 0.5f) * v.spacing;
    expectNear(irradianceIn(field, v, at, {1, 0, 0}, vec3(0.0f)), vec3(2 * kPi), 1e-4f);
    EXPECT_EQ(field.fallbacks, 1);
    field.backs = [](int) { return 1.0f; };
    EXPECT_EQ(irradianceIn(field, v, at, {1, 0, 0}, vec3(0.0f)), vec3(0.0f));
    EXPECT_TRUE(enoughWeight(1e-9f, kRulesPaper));
    EXPECT_FALSE(enoughWeight(0.0f, kRulesPaper)) << "all of the cage is new";
    EXPECT_TRUE(enoughWeight(kDoubtful, kRulesMeasured));
    EXPECT_FALSE(enoughWeight(0.9f * kDoubtful, kRulesMeasured));
}

TEST(Cage, isTheVolumesAroundThePoint) {
    const Volume v = makeVolume();
    const vec3 normal(0, 0, 1), viewer(1, 0, 0);
    const Cage cage = cageAround(v, {0.5f, 2.75f, -2}, normal, viewer, 0.4f, kRulesPaper);
    expectNear(cage.position, {0.5f, 2.75f, -2}, 1e-6f);
    EXPECT_EQ(cage.bias, selfShadowBias(normal, viewer, 0.5f, 0.4f));
    EXPECT_EQ(cage.base, vec3(1, 1, 1));
    expectNear(cage.alpha, vec3(0.5f, 0.5f, 1.0f / 3), 1e-5f);
    // Outside the volume its nearest point is used; without a viewer, the normal.
    const Cage outside = cageAround(v, {99, 99, -99}, normal, vec3(0.0f), 0.4f, kRulesMeasured);
    EXPECT_EQ(outside.position, vec3(3, 4.5f, -3));
    EXPECT_EQ(outside.base, vec3(3, 4, 0));
    EXPECT_EQ(outside.bias, visibilityBias(normal, normal, 0.5f, 0.4f, kRulesMeasured));
}

TEST(Guards, momentsTestTheBiasedPoint) {
    const Volume v = makeVolume();
    FormulaField field;
    field.guard = kMoments;
    // Exact in binary, as is their variance, so that constant folding and fused operations change nothing.
    field.moments = [](int slot, vec3 at) { return slot == 7 && at.x > 0.9f ? vec2(0.25f, 0.125f) : vec2(0.0f); };
    // 1.25 m are 0.5 of the farthest distance.
    EXPECT_EQ(guardSeen(field, v, 7, 0, vec3(1.25f, 0, 0), noGuardPoint()),
              chebyshevWeight(0.25f, 0.125f, 0.5f, kRulesMeasured));
    EXPECT_EQ(momentsBetween(field, v, 7, 1, vec3(1, 0, 0), 1.25f, vec3(0.0f)),
              guardSeen(field, v, 7, 0, vec3(1.25f, 0, 0), noGuardPoint()));
    const vec3 begin = guardBegin(field, v, Cage());
    EXPECT_EQ(guardFar(field, v, 7, vec3(1.25f, 0, 0), begin),
              guardSeen(field, v, 7, 0, vec3(1.25f, 0, 0), noGuardPoint()));
    EXPECT_EQ(guardFar(field, v, 7, vec3(9, 0, 0), begin), chebyshevFloor(kRulesMeasured));
    EXPECT_EQ(momentsSeen(field, v, 8, 0, vec3(1.25f, 0, 0), noGuardPoint()), chebyshevFloor(kRulesMeasured));
    EXPECT_EQ(momentsFar(field, v, 8, vec3(1.25f, 0, 0), begin), chebyshevFloor(kRulesMeasured));
    // Maps are stored by world directions: the volume's x is the world's -z here.
    Volume turned = v;
    turned.turned = 1;
    turned.orientation = vec4(0, std::sqrt(0.5f), 0, std::sqrt(0.5f));
    EXPECT_EQ(guardSeen(field, turned, 7, 0, vec3(1.25f, 0, 0), noGuardPoint()), chebyshevFloor(kRulesMeasured));
    EXPECT_NEAR(guardSeen(field, turned, 7, 0, vec3(0, 0, 1.25f), noGuardPoint()),
                guardSeen(field, v, 7, 0, vec3(1.25f, 0, 0), noGuardPoint()), 1e-5f);
    EXPECT_NEAR(axisDirection(turned, 2, true).x, 1.0f, 1e-6f);
}

TEST(Guards, noneGuardsNothing) {
    const Volume v = makeVolume();
    FormulaField field;
    field.moments = [](int, vec3) { return vec2(0.0f); };
    EXPECT_EQ(guardSeen(field, v, 7, 0, vec3(1, 0, 0), noGuardPoint()), 1.0f);
    EXPECT_EQ(guardBetween(field, v, 7, 1, vec3(1, 0, 0), 1.0f, vec3(0.0f)), 1.0f);
    const vec3 begin = noneBegin(field, v, Cage());
    EXPECT_EQ(guardFar(field, v, 7, vec3(1, 0, 0), begin), 1.0f);
    EXPECT_EQ(noneSeen(field, v, 7, 0, vec3(1, 0, 0), noGuardPoint()), 1.0f);
    EXPECT_EQ(noneFar(field, v, 7, vec3(1, 0, 0), begin), 1.0f);
    EXPECT_EQ(noneBetween(field, v, 7, 1, vec3(1, 0, 0), 1.0f, vec3(0.0f)), 1.0f);
}

TEST(Access, componentsByAxis) {
    const vec3 a(3, 5, 7);
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_EQ(component(axis, a), a[axis]);
        EXPECT_EQ(componentOf(axis, 2, 4, 8), 2 << axis);
    }
    EXPECT_EQ(axisDirection(makeVolume(), 1, false), vec3(0, -1, 0));
}

}  // namespace
}  // namespace probegi::kernels

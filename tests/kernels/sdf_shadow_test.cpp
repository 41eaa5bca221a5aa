// The guard that tests shadows of solids, in rooms of closed form.
#include "kernels/guards/sdf_shadow.h"

#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "kernels/sdf_solids.h"

namespace probegi::kernels {
namespace {

// Solids, and moments that know nothing.
struct SolidField {
    using MapPoint = vec3;
    int rules = kRulesMeasured;
    std::vector<SdfBlocker> solids{};
    int blockers = 0;
    std::vector<int> placements = std::vector<int>(8);
    mutable int asked = 0;

    explicit SolidField(std::vector<SdfBlocker> all) : solids(std::move(all)), blockers(int(solids.size())) {}
    friend SdfBlocker blockerAt(const SolidField& f, int number) { return f.solids.at(std::size_t(number)); }
    friend int storedPlacement(const SolidField& f, int slot) { return f.placements.at(std::size_t(slot)); }
    friend vec3 visibilityPoint(const SolidField&, vec3 direction) { return direction; }
    friend void storedMoments(const SolidField& f, int, vec3, float& mean, float& meanSquare) {
        ++f.asked;
        mean = meanSquare = 0.0f;
    }
};

// Probes at 0 and 1 along each axis.
Volume oneCell() {
    Volume v{};
    v.spacing = v.inverseSpacing = vec3(1.0f);
    v.minSpacing = 1.0f;
    v.inverseMaxDistance = 0.5f;
    v.counts = ivec3(2);
    v.orientation = vec4(0, 0, 0, 1);
    return v;
}

SdfBlocker box(vec3 centre, vec3 halfSize) {
    SdfBlocker blocker{plainSolid(kSdfBox, halfSize), halfSize};
    blocker.solid.centre = centre;
    return blocker;
}

GuardPoint noteOf(const SolidField& field, const Volume& v, vec3 point, vec3 normal) {
    const Cage cage = cageAround(v, point, normal, normal, 0.3f, kRulesMeasured);
    return sdfShadowPoint(field, v, cage, cageSlots(v, cage.base));
}

vec3 beginOf(const SolidField& field, const Volume& v, vec3 point, vec3 normal) {
    return sdfShadowBegin(field, v, cageAround(v, point, normal, normal, 0.3f, kRulesMeasured));
}

TEST(SdfShadow, nothingIsHiddenInTheOpen) {
    const SolidField field({});
    const GuardPoint note = noteOf(field, oneCell(), vec3(0.3f), {0, 1, 0});
    for (int corner = 0; corner < 8; ++corner)
        EXPECT_EQ(sdfShadowSeen(field, oneCell(), corner, corner, vec3(1.0f), note), 1.0f);
    EXPECT_EQ(field.asked, 0);
}

// However thin the wall is, and whatever the point's place: what is beyond it is hidden to the last bit.
TEST(SdfShadow, aWallHidesAllThatIsBeyondIt) {
    for (const float thickness : {0.2f, 0.02f, 0.001f}) {
        const SolidField field({box({0.5f, 0.5f, 0.5f}, {thickness / 2, 3, 3})});
        for (const vec3 point : {vec3(0.3f, 0.4f, 0.6f), vec3(0.5f - thickness / 2, 0.1f, 0.9f), vec3(0, 1, 0)}) {
            const GuardPoint note = noteOf(field, oneCell(), point, {-1, 0, 0});
            for (int corner = 0; corner < 8; ++corner)
                EXPECT_EQ(note.seen[corner], corner & 1 ? 0.0f : 1.0f) << thickness << ' ' << corner;
        }
    }
}

// Points of a mesh that lie within the wall see what is on the side to which they face.
TEST(SdfShadow, pointsInsideTheWallLeaveItOnTheirSide) {
    const SolidField field({box({0.5f, 0.5f, 0.5f}, {0.1f, 3, 3})});
    for (const float x : {0.41f, 0.5f, 0.59f}) {
        const GuardPoint left = noteOf(field, oneCell(), {x, 0.5f, 0.5f}, {-1, 0, 0});
        const GuardPoint right = noteOf(field, oneCell(), {x, 0.5f, 0.5f}, {1, 0, 0});
        for (int corner = 0; corner < 8; ++corner) {
            EXPECT_EQ(left.seen[corner], corner & 1 ? 0.0f : 1.0f) << x;
            EXPECT_EQ(right.seen[corner], corner & 1 ? 1.0f : 0.0f) << x;
        }
    }
}

// A probe disappears behind an edge by degrees.
TEST(SdfShadow, edgesAreSoft) {
    const SolidField field({box({0.5f, -1.7f, 0.5f}, {0.01f, 2, 3})});  // its top at 0.3
    float last = 0;
    int between = 0;
    for (int i = 0; i <= 1000; ++i) {
        const float height = 0.4f + 0.0006f * float(i);
        // Towards the probe at (1, 0, 0) the way passes the wall's top where it is half as high.
        const GuardPoint note = noteOf(field, oneCell(), {0, height, 0}, {0, 1, 0});
        EXPECT_GE(note.seen[1], last - 1e-5f);
        EXPECT_LT(note.seen[1] - last, 0.02f);
        last = note.seen[1];
        between += last > 0.01f && last < 0.99f ? 1 : 0;
    }
    EXPECT_EQ(last, 1.0f);
    EXPECT_GT(between, 100);
}

TEST(SdfShadow, movedProbesAreLookedForWhereTheyStand) {
    SolidField field({box({0.5f, 0.5f, 0.5f}, {0.01f, 3, 3})});
    Volume v = oneCell();
    v.relocated = 1;
    EXPECT_EQ(noteOf(field, v, {0.3f, 0.5f, 0.5f}, {-1, 0, 0}).seen[0], 1.0f);
    // By 0.5 to the wall's other side? No further than 127 steps reach: to its face.
    field.solids[0].solid.centre.x = 0.4f;
    field.placements[0] = 0x7f00;
    EXPECT_EQ(noteOf(field, v, {0.3f, 0.5f, 0.5f}, {-1, 0, 0}).seen[0], 0.0f);
    EXPECT_EQ(noteOf(field, v, {0.3f, 0.5f, 0.5f}, {-1, 0, 0}).seen[2], 1.0f);
}

// A volume's frame is turned; the solids are in the world.
TEST(SdfShadow, turnedVolumes) {
    const SolidField field({box({0, 0.5f, -0.5f}, {3, 3, 0.01f})});
    Volume v = oneCell();
    v.turned = 1;
    v.orientation = vec4(0, std::sqrt(0.5f), 0, std::sqrt(0.5f));  // its x axis is the world's -z
    const GuardPoint note = noteOf(field, v, {0.5f, 0.5f, -0.3f}, {0, 0, 1});
    for (int corner = 0; corner < 8; ++corner) EXPECT_EQ(note.seen[corner], corner & 1 ? 0.0f : 1.0f) << corner;
}

// Shut in on all sides: its own cage says nothing, and of all neighbours the moments decide.
TEST(SdfShadow, whoSeesNoProbeAsksTheMoments) {
    const SolidField field({box({0.5f, 0.6f, 0.5f}, {0.2f, 0.02f, 0.2f}), box({0.5f, 0.4f, 0.5f}, {0.2f, 0.02f, 0.2f}),
                            box({0.6f, 0.5f, 0.5f}, {0.02f, 0.2f, 0.2f}), box({0.4f, 0.5f, 0.5f}, {0.02f, 0.2f, 0.2f}),
                            box({0.5f, 0.5f, 0.6f}, {0.2f, 0.2f, 0.02f}),
                            box({0.5f, 0.5f, 0.4f}, {0.2f, 0.2f, 0.02f})});
    const Volume v = oneCell();
    const GuardPoint note = noteOf(field, v, vec3(0.5f), {0, 1, 0});
    for (int corner = 0; corner < 8; ++corner) EXPECT_EQ(sdfShadowSeen(field, v, corner, corner, vec3(1), note), 0.0f);
    const vec3 fromLowest(0.5f), begin = beginOf(field, v, vec3(0.5f), {0, 1, 0});
    EXPECT_EQ(sdfShadowFar(field, v, 0, fromLowest, begin), kShutIn * momentsFar(field, v, 0, fromLowest, begin));
    EXPECT_EQ(sdfShadowFar(field, v, 0, fromLowest, vec3(0.2f)), 1.0f) << "not behind the boxes";
}

// A corridor narrower than the bias by which moments are asked: its wall looks past the other one.
TEST(SdfShadow, neighboursBeyondANarrowCorridorAreHidden) {
    const SolidField field({box({0.3f, 0.5f, 0.5f}, {0.02f, 3, 3}), box({0.5f, 0.5f, 0.5f}, {0.02f, 3, 3})});
    const Volume v = oneCell();
    const vec3 point(0.32f, 0.5f, 0.5f), normal(1, 0, 0);
    const Cage cage = cageAround(v, point, normal, normal, 0.3f, kRulesMeasured);
    ASSERT_GT(point.x + cage.bias.x, 0.52f);
    const vec3 begin = sdfShadowBegin(field, v, cage);
    EXPECT_LT(length(begin - vec3(0.34f, 0.5f, 0.5f)), 1e-6f);
    for (int slot = 0; slot < 8; ++slot) {
        const vec3 fromProbe = point + cage.bias - vec3(slot & 1, (slot >> 1) & 1, slot >> 2);
        EXPECT_EQ(sdfShadowFar(field, v, slot, fromProbe, begin),
                  kShutIn * momentsFar(field, v, slot, fromProbe, begin));
    }
    const SolidField open({field.solids[0]});
    for (int slot = 0; slot < 8; ++slot) {
        const vec3 fromProbe = point + cage.bias - vec3(slot & 1, (slot >> 1) & 1, slot >> 2);
        const float seen = sdfShadowFar(open, v, slot, fromProbe, sdfShadowBegin(open, v, cage));
        EXPECT_EQ(seen == 1.0f, (slot & 1) == 1) << slot;
        EXPECT_EQ(seen < kShutIn * 1.001f, (slot & 1) == 0) << slot;
    }
}

// In a turned volume ways to its neighbours begin and end where they do in the world.
TEST(SdfShadow, neighboursOfTurnedVolumes) {
    const SolidField field({box({0, 0.5f, -0.5f}, {3, 3, 0.01f})});
    Volume v = oneCell();
    v.turned = 1;
    v.orientation = vec4(0, std::sqrt(0.5f), 0, std::sqrt(0.5f));  // its x axis is the world's -z
    const vec3 begin = beginOf(field, v, {0.5f, 0.5f, -0.3f}, {0, 0, 1});
    EXPECT_LT(length(begin - vec3(0.5f, 0.5f, -0.28f)), 1e-6f);
    for (int slot = 0; slot < 8; ++slot) {
        const float seen = sdfShadowFar(field, v, slot, vec3(0.5f), begin);
        EXPECT_EQ(seen == 1.0f, (slot & 1) == 0) << slot;
        EXPECT_EQ(seen < kShutIn * 1.001f, (slot & 1) == 1) << slot;
    }
}

// The top of a cupboard below a roof, in spacings of 1.5 m: neither is a curtain.
TEST(SdfShadow, roofsCloseAboveACupboardHideTheSky) {
    for (const vec2 metres : {vec2(0.2f, 0.2f), vec2(0.15f, 0.15f), vec2(0.05f, 0.15f)}) {
        const float roof = metres.x / 1.5f, gap = metres.y / 1.5f;
        const SolidField field(
            {box({0.5f, 0.1f, 0.5f}, {0.3f, 0.4f, 0.3f}), box({0.5f, 0.5f + gap + roof / 2, 0.5f}, {3, roof / 2, 3})});
        const GuardPoint note = noteOf(field, oneCell(), vec3(0.5f), {0, 1, 0});
        for (const int corner : {2, 3, 6, 7}) EXPECT_EQ(note.seen[corner], 0.0f) << metres.x << ' ' << metres.y;
    }
    // A fold behind the box of its curtain, 1 cm thick and 5 cm in front of it.
    const SolidField curtain({box({0.5f, 0.5f + 0.055f / 1.5f, 0.5f}, {3, 0.005f / 1.5f, 3})});
    const GuardPoint note = noteOf(curtain, oneCell(), vec3(0.5f), {0, 1, 0});
    for (int corner = 0; corner < 8; ++corner) EXPECT_EQ(note.seen[corner], (corner & 2) != 0 ? 1.0f : 0.0f) << corner;
}

// The probe in slot 2 and the one beside it along x have a wall between them, others have none.
TEST(SdfShadow, betweenProbes) {
    const SolidField field({box({0.5f, 1, 0}, {0.005f, 0.4f, 0.4f})});
    const Volume v = oneCell();
    const auto between = [&](int slot, int side, vec3 front) {
        return sdfShadowBetween(field, v, slot, side, vec3(1, 0, 0), 1.0f, front);
    };
    EXPECT_EQ(between(2, 1, {0, 1, 0}), 0.0f);
    EXPECT_EQ(between(3, 0, {1, 1, 0}), 0.0f);
    EXPECT_EQ(between(0, 1, {0, 0, 0}), 1.0f);
    EXPECT_EQ(between(2, 5, {0, 1, 0}), 1.0f);
    EXPECT_EQ(field.asked, 0);
}

TEST(SdfShadow, aBallIsSharedOut) {
    EXPECT_EQ(shareSeen(0.1f, 0.2f), 0.5f);
    EXPECT_EQ(shareSeen(0.3f, 0.2f), 1.0f);
    EXPECT_EQ(shareSeen(-1.0f, 0.2f), 0.0f);
    EXPECT_EQ(shareSeen(0.0f, -1.0f), 0.0f) << "the probe is inside";
}

}  // namespace
}  // namespace probegi::kernels

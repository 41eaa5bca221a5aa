// Places that leak: found where they are, for the right cause, with a remedy that works.
#include <gmock/gmock.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "measure/audit/leak_cause.h"
#include "probegi/measure.h"
#include "probegi/sdf.h"
#include "probegi/shapes.h"
#include "support/field_setup.h"

namespace probegi::test {
namespace {

using testing::HasSubstr;

/// Two rooms of 4 x 3 x 4 m side by side: a lamp in the left one, the right one sealed, and the wall between them.
struct Rooms {
    explicit Rooms(float wall, int threads = 1) : context(*Context::create({.threads = threads})) {
        scene.materials.resize(2);
        scene.materials[0].baseColor = glm::vec4(0.6f);
        scene.materials[1].emission = glm::vec3(20);
        Primitive left, right, lamp;
        left.material = right.material = 0;
        lamp.material = 1;
        addRoom(left, {-0.5f * wall - 4, 0, 0}, {-0.5f * wall, 3, 4});
        addRoom(right, {0.5f * wall, 0, 0}, {0.5f * wall + 4, 3, 4});
        addQuad(lamp, {-2.5f, 2.99f, 1.5f}, {1, 0, 0}, {0, 0, 1});
        for (Primitive* part : {&left, &right, &lamp}) addObject(scene, std::move(*part));
        pose = poseAt(scene);
        tracer = makeEmbreeTracer(context, scene, pose).value();
    }

    /// `wallAt`: where the wall lies between two layers of probes, 0..1.
    Field field(float spacing, FieldSetup setup = {}, float wallAt = 0.5f) const {
        if (setup.volumes == FieldDesc{}.volumes) {
            // A cell of margin.
            const int half = int(std::ceil(5.5f / spacing));
            setup.volumes = {{{(1 - wallAt - float(half)) * spacing, -0.8f * spacing, -0.8f * spacing},
                              glm::vec3(spacing),
                              {2 * half, int(std::ceil(3 / spacing)) + 3, int(std::ceil(4 / spacing)) + 3}}};
        }
        setup.raysPerProbe = 96;
        Field made = setup.make(context).value();
        EXPECT_TRUE(made.converge(*tracer, {}, 0.02f, 12));
        return made;
    }
    LeakAudit audit(const Field& field, AuditDesc desc = {}) const {
        if (desc.points == AuditDesc{}.points) desc.points = 3000;
        return auditLeaks(context, scene, pose, *tracer, field, desc).value();
    }

    Context context;
    Scene scene;
    ScenePose pose;
    std::unique_ptr<Tracer> tracer;
};

FieldSetup withGuard(LeakGuard guard) {
    FieldSetup setup;
    setup.guard = guard;
    return setup;
}

bool isDark(const LeakPlace& place) {
    return place.position.x > 0;
}

TEST(LeakAudit, findsTheWallOfAFieldWithoutAGuard) {
    const Rooms rooms(0.1f);
    const LeakAudit audit = rooms.audit(rooms.field(1, withGuard(LeakGuard::none)));
    ASSERT_FALSE(audit.places.empty());
    const LeakPlace& place = audit.places.front();
    EXPECT_EQ(place.cause, LeakCause::guardOff);
    EXPECT_TRUE(isDark(place));
    EXPECT_GT(place.leak, 0.05);
    EXPECT_GE(place.worst, place.leak);
    EXPECT_NEAR(place.wall, 0.1, 0.01);
    EXPECT_NEAR(place.spacing.x, 1, 0);
    EXPECT_GT(place.area, 1);
    EXPECT_LT(place.lower.x, 0.5f) << "near the wall";
    EXPECT_LT(place.probe.x, 0);
    EXPECT_DOUBLE_EQ(audit.worst,
                     std::abs(std::max_element(audit.places.begin(), audit.places.end(), [](auto& a, auto& b) {
                                  return std::abs(a.leak) < std::abs(b.leak);
                              })->leak));
}

TEST(LeakAudit, passesThickWallsAndAFineGrid) {
    const Rooms rooms(0.5f);
    const LeakAudit audit = rooms.audit(rooms.field(0.5f));
    for (const LeakPlace& place : audit.places)
        EXPECT_FALSE(isDark(place)) << place.position.x << ' ' << place.position.y << ' ' << place.position.z;
    EXPECT_GT(audit.points, 2000);
    EXPECT_GT(audit.pairs, audit.hiddenPairs);
    // Both rooms' sides, and the lamp.
    EXPECT_NEAR(audit.area, 2 * 2 * (4 * 3 + 4 * 4 + 3 * 4) + 1, 3);
}

TEST(LeakAudit, ordersPlacesByHarm) {
    const Rooms rooms(0.02f);
    const LeakAudit audit = rooms.audit(rooms.field(1, withGuard(LeakGuard::none)));
    double area = 0;
    for (std::size_t i = 0; i < audit.places.size(); ++i) {
        area += audit.places[i].area;
        EXPECT_GE(audit.places[i].points, 3);
        if (i > 0) {
            EXPECT_LE(audit.places[i].harm, audit.places[i - 1].harm);
        }
    }
    EXPECT_NEAR(area, audit.leakingArea, 1e-9 * area);
}

// Both remedies are tried: the wall as thick, or the probes as near, as the audit says.
TEST(LeakAudit, ofAThinWallSaysWhatHelps) {
    constexpr float kSpacing = 2, kWallAt = 0.2f;
    const auto thinWalls = [](const LeakAudit& audit) {
        std::vector<LeakPlace> places;
        for (const LeakPlace& place : audit.places)
            if (isDark(place) && place.cause == LeakCause::thinWall) places.push_back(place);
        return places;
    };
    const Rooms thin(0.02f);
    const auto places = thinWalls(thin.audit(thin.field(kSpacing, {}, kWallAt)));
    ASSERT_FALSE(places.empty());
    double thicken = 0, refine = kSpacing;
    for (const LeakPlace& place : places) {
        EXPECT_GT(place.leak, 0.01);
        EXPECT_NEAR(place.wall, 0.02, 0.005);
        EXPECT_GT(place.thicken, 0.02);
        EXPECT_LT(place.thicken, 0.5 * kSpacing);
        EXPECT_GT(place.refine, 0.1);
        EXPECT_LT(place.refine, kSpacing);
        thicken = std::max(thicken, place.thicken), refine = std::min(refine, place.refine);
    }
    const Rooms thick{float(thicken)};
    EXPECT_TRUE(thinWalls(thick.audit(thick.field(kSpacing, {}, kWallAt))).empty()) << "thickness " << thicken;
    EXPECT_TRUE(thinWalls(thin.audit(thin.field(float(refine), {}, kWallAt))).empty()) << "spacing " << refine;
}

TEST(LeakAudit, pathTracerClearsWhatIsRight) {
    const Rooms rooms(0.1f);
    const Field field = rooms.field(1, withGuard(LeakGuard::none));
    const auto truth = PathTracer::create(rooms.context, rooms.scene, rooms.pose, *rooms.tracer, {}).value();
    AuditDesc desc;
    const LeakAudit byWeights = rooms.audit(field, desc);
    desc.truth = &truth;
    const LeakAudit confirmed = rooms.audit(field, desc);
    EXPECT_EQ(confirmed.places.size() + std::size_t(confirmed.harmless), byWeights.places.size());
    ASSERT_FALSE(confirmed.places.empty());
    EXPECT_TRUE(isDark(confirmed.places.front()));
    EXPECT_EQ(confirmed.places.front().truth, 0) << "the room is sealed";
    EXPECT_EQ(byWeights.places.front().truth, -1);
}

TEST(LeakAudit, knowsPlacesOutsideTheVolume) {
    const Rooms rooms(0.1f);
    FieldSetup setup;
    setup.volumes = {{{-4.5f, -0.5f, -0.5f}, glm::vec3(1), {5, 5, 6}}};  // the lit room alone
    const LeakAudit audit = rooms.audit(rooms.field(1, setup));
    const auto found = std::find_if(audit.places.begin(), audit.places.end(),
                                    [](const LeakPlace& p) { return p.cause == LeakCause::beyondVolume; });
    ASSERT_NE(found, audit.places.end());
    EXPECT_TRUE(isDark(*found));
    EXPECT_NEAR(found->extend, double(found->upper.x) + 0.5, 1e-4) << "the last probes stand at x = -0.5";
}

TEST(LeakAudit, isTheSameOnAnyNumberOfThreads) {
    // One after the other: contexts that live together share the smallest number of threads.
    const auto auditOn = [](int threads, std::uint64_t seed) {
        const Rooms rooms(0.05f, threads);
        AuditDesc desc;
        desc.seed = seed;
        return rooms.audit(rooms.field(1, withGuard(LeakGuard::none)), desc);
    };
    const LeakAudit a = auditOn(1, 1), b = auditOn(4, 1);
    ASSERT_EQ(a.places.size(), b.places.size());
    EXPECT_EQ(a.pairs, b.pairs);
    EXPECT_EQ(a.hidden, b.hidden);
    for (std::size_t i = 0; i < a.places.size(); ++i) {
        EXPECT_EQ(a.places[i].position, b.places[i].position);
        EXPECT_EQ(a.places[i].leak, b.places[i].leak);
        EXPECT_EQ(a.places[i].harm, b.places[i].harm);
    }
    EXPECT_NE(auditOn(1, 2).hidden, a.hidden);
}

TEST(LeakAudit, ofNothingFindsNothing) {
    const Context context = *Context::create({.threads = 1});
    const Scene empty;
    const auto tracer = makeEmbreeTracer(context, empty, poseAt(empty)).value();
    const Field field = FieldSetup{}.make(context).value();
    const LeakAudit audit = auditLeaks(context, empty, poseAt(empty), *tracer, field).value();
    EXPECT_EQ(audit.points, 0);
    EXPECT_TRUE(audit.places.empty());
    EXPECT_EQ(audit.worst, 0);
    const Rooms rooms(0.1f);
    EXPECT_TRUE(rooms.audit(field).places.empty()) << "a field that is empty is black";
}

TEST(LeakAudit, refusesWhatIsOutOfRange) {
    const Rooms rooms(0.1f);
    const Field field = FieldSetup{}.make(rooms.context).value();
    const auto refused = [&](const char* member, const AuditDesc& desc) {
        const auto audit = auditLeaks(rooms.context, rooms.scene, rooms.pose, *rooms.tracer, field, desc);
        ASSERT_FALSE(audit) << member;
        EXPECT_EQ(audit.error().code, ErrorCode::invalidArgument);
        EXPECT_THAT(audit.error().message, HasSubstr(member));
    };
    AuditDesc desc;
    desc.points = 0;
    refused("points", desc);
    desc = {}, desc.least = 0;
    refused("least", desc);
    desc = {}, desc.least = std::nan("");
    refused("least", desc);
    desc = {}, desc.leastStops = -1;
    refused("leastStops", desc);
    desc = {}, desc.truthSamples = 0;
    refused("truthSamples", desc);
}

TEST(LeakAudit, refusesPrimitivesWhoseShadowsHaveNoCause) {
    const Rooms rooms(0.2f);
    FieldDesc desc;
    FieldSettings settings;
    settings.guard = LeakGuard::sdfShadow;
    settings.blockers = placeSdf({}, rooms.scene, rooms.pose).value();
    const Field field = Field::create(rooms.context, desc, settings).value();
    const auto audit = auditLeaks(rooms.context, rooms.scene, rooms.pose, *rooms.tracer, field);
    ASSERT_FALSE(audit);
    EXPECT_EQ(audit.error().code, ErrorCode::invalidArgument);
    EXPECT_THAT(audit.error().message, HasSubstr("leaksAt()"));
    const std::vector<FieldQuery> points{{.position = {1, 0, 1}, .normal = {0, 1, 0}}};
    EXPECT_TRUE(leaksAt(rooms.context, *rooms.tracer, field, points)) << "which asks for no cause";
}

TEST(LeakAudit, canBeCancelled) {
    const Rooms rooms(0.1f);
    const Field field = FieldSetup{}.make(rooms.context).value();
    ContextDesc desc;
    desc.threads = 1;
    desc.progress = [](const ProgressReport&) { return false; };
    const Context impatient = *Context::create(desc);
    AuditDesc longEnough;  // progress is told ten times a second
    longEnough.points = 1 << 18;
    const auto audit = auditLeaks(impatient, rooms.scene, rooms.pose, *rooms.tracer, field, longEnough);
    ASSERT_FALSE(audit);
    EXPECT_EQ(audit.error().code, ErrorCode::cancelled);
}

// ---- Causes, by rays

/// A solid wall 0.2 m thick, a sheet, and a big block, along x.
struct Things {
    Things() {
        scene.materials.emplace_back();
        Primitive wall, sheet, block;
        wall.material = sheet.material = block.material = 0;
        addBox(wall, {1, -9, -9}, {1.2f, 9, 9});
        addQuad(sheet, {-1, -9, -9}, {0, 0, 18}, {0, 18, 0});  // faces -x
        addBox(block, {3, -9, -9}, {6, 9, 9});
        for (Primitive* part : {&wall, &sheet, &block}) addObject(scene, std::move(*part));
        tracer = makeEmbreeTracer(context, scene, poseAt(scene)).value();
    }
    Obstacle between(glm::vec3 from, glm::vec3 to) const {
        return obstacleBetween(*tracer, {from, {0, 1, 0}, {}}, to).value();
    }
    Context context = *Context::create({.threads = 1});
    Scene scene;
    std::unique_ptr<Tracer> tracer;
};

TEST(LeakCause, measuresWhatIsInTheWay) {
    const Things things;
    EXPECT_FALSE(things.between({0, 0, 0}, {0.9f, 0, 0}).any);
    const Obstacle wall = things.between({0, 0, 0}, {2, 0, 0});
    EXPECT_TRUE(wall.any);
    EXPECT_NEAR(wall.thickness, 0.2, 1e-4);
    EXPECT_NEAR(wall.cosine, 1, 1e-4);
    EXPECT_FALSE(wall.aroundProbe);
    const Obstacle aslant = things.between({0, 0, 0}, {2, 2, 0});
    EXPECT_NEAR(aslant.thickness, 0.2, 1e-4) << "across the wall, not along the ray";
    EXPECT_NEAR(aslant.cosine, std::sqrt(0.5), 1e-3);
    for (const float side : {-2.0f, 0.0f}) {
        const Obstacle sheet = things.between({side, 0, 0}, {-2 - side, 0, 0});
        EXPECT_TRUE(sheet.any);
        EXPECT_EQ(sheet.thickness, 0) << "from either side";
    }
    const Obstacle block = things.between({2, 0, 0}, {4, 0, 0});
    EXPECT_TRUE(block.aroundProbe);
    EXPECT_NEAR(block.thickness, 3, 1e-3);
}

TEST(LeakCause, findsTheWayOutOfMatter) {
    const Things things;
    EXPECT_NEAR(distanceToOpen(*things.tracer, {4, 0, 0}).value(), 1, 0.1);
    EXPECT_EQ(distanceToOpen(*things.tracer, {2, 0, 0}).value(), 0) << "in the open";
    EXPECT_TRUE(isInsideMatter(*things.tracer, {{4, 0, 0}, {0, 1, 0}, {}}).value());
    EXPECT_FALSE(isInsideMatter(*things.tracer, {{2, 0, 0}, {0, 1, 0}, {}}).value());
    EXPECT_FALSE(isInsideMatter(*things.tracer, {{0, 0, 0}, {0, 1, 0}, {}}).value());
}

TEST(LeakCause, saysHowNearProbesMustBeToBeSeen) {
    const Things things;
    FieldSetup setup;
    setup.volumes = {{{-3, -3, -3}, glm::vec3(3), {4, 3, 3}}};
    const Field field = setup.make(things.context).value();
    const FieldRecord record = recordOf(field).value();
    // Between the wall's far side and the block there are 1.8 m along x, and more than a spacing along y and z.
    EXPECT_NEAR(spacingThatSees(record, *things.tracer, {{2, 0, 0}, {0, 1, 0}, {}}).value(), 1.8, 0.01);
}

}  // namespace
}  // namespace probegi::test

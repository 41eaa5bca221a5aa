// Which probes stand in solid matter: told by geometry, the same for materials with one side and with two.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "backend/every_backend.h"
#include "kernels/random.h"
#include "support/field_setup.h"
#include "support/probes.h"

namespace probegi::test {
namespace {

constexpr glm::vec3 kLower(-3, 0, -3), kUpper(3, 3, 3);  // of the room

/// Sheets and boxes, all of one matt material.
struct Sheets {
    Sheets() {
        scene.materials.push_back({.baseColor = {0.6f, 0.6f, 0.6f, 1.0f}});
        scene.meshes.emplace_back();
        scene.addNode({.mesh = 0});
    }
    /// A parallelogram; its front is the side of cross(edge1, edge2).
    static void addQuad(Scene& scene, int mesh, glm::vec3 corner, glm::vec3 edge1, glm::vec3 edge2, int material = 0) {
        Primitive p;
        p.positions = {corner, corner + edge1, corner + edge1 + edge2, corner + edge2};
        p.indices = {0, 1, 2, 0, 2, 3};
        p.material = material;
        scene.meshes[std::size_t(mesh)].primitives.push_back(p);
    }
    /// The six faces of a box as quads that do not know of each other: `over` metres too large on all sides.
    static void addFaces(Scene& scene, int mesh, glm::vec3 lower, glm::vec3 upper, bool inward, float over) {
        for (int axis = 0; axis < 3; ++axis)
            for (const bool high : {false, true}) {
                const int u = (axis + 1) % 3, v = (axis + 2) % 3;
                glm::vec3 corner = lower - over, a(0), b(0);
                corner[axis] = (high ? upper : lower)[axis];
                a[u] = upper[u] - lower[u] + 2 * over;
                b[v] = upper[v] - lower[v] + 2 * over;
                addQuad(scene, mesh, corner, high == inward ? b : a, high == inward ? a : b);
            }
    }
    void addLight(glm::vec3 position) {
        scene.lights.push_back({.type = LightType::point, .intensity = glm::vec3(4.0f)});
        scene.addNode({.translation = position, .light = int(scene.lights.size()) - 1});
    }

    Scene scene;
};

/// A room whose walls are single sheets that cross each other, with the void around it.
Sheets room() {
    Sheets s;
    Sheets::addFaces(s.scene, 0, kLower, kUpper, true, 0.2f);
    return s;
}

/// A room with two thick pillars, of which one is a mirrored instance.
Scene pillars(bool doubleSided) {
    Sheets s = room();
    const glm::vec3 half(0.8f, 1.499f, 0.8f);
    s.scene.meshes.emplace_back();
    Sheets::addFaces(s.scene, 1, -half, half, false, 0);
    s.scene.addNode({.translation = {1.5f, 1.5f, 1.5f}, .mesh = 1});
    s.scene.addNode({.translation = {-1.5f, 1.5f, -1.5f}, .scale = {-1, 1, 1}, .mesh = 1});
    s.addLight({-1.9f, 2.6f, 1.9f});
    s.scene.materials[0].doubleSided = doubleSided;
    return s.scene;
}

/// A room that a curtain of one sheet divides but for gaps at its edges, the same light on both sides. The curtain's
/// front faces -x.
Scene curtain(bool doubleSided) {
    Sheets s = room();
    s.scene.materials.push_back({.baseColor = {0.6f, 0.6f, 0.6f, 1.0f}, .doubleSided = doubleSided});
    Sheets::addQuad(s.scene, 0, {0, 0.1f, -2}, {0, 0, 4}, {0, 2.8f, 0}, 1);
    s.addLight({-1.6f, 2.4f, 0.3f});
    s.addLight({1.6f, 2.4f, 0.3f});
    return s.scene;
}

/// Probes a metre apart, the outermost half a metre outside the room.
struct SolidWorld {
    SolidWorld(const Context& context, const BackendMaker& backend, Scene own, int updates)
        : scene(std::move(own)), pose(poseAt(scene)), lighting{pose.lights, scene.sky} {
        FieldSetup desc;
        desc.raysPerProbe = 96;
        desc.volumes = {{kLower - 0.5f, glm::vec3(1.0f), {8, 5, 8}}};
        tracer = std::move(backend.makeTracer(context, scene, pose).value());
        field.emplace(std::move(backend.makeField(context, desc).value()));
        for (int i = 0; i < updates; ++i) EXPECT_TRUE(field->update(*tracer, lighting));
    }
    float share(int probe) const { return probeBackfaceShare(*field, probe); }
    float shareAt(glm::vec3 position) const {
        const glm::ivec3 at(glm::round(position - field->desc().volumes[0].origin));
        return share(at.x + 8 * (at.y + 5 * at.z));
    }

    Scene scene;
    ScenePose pose;
    Lighting lighting;
    std::unique_ptr<Tracer> tracer;
    std::optional<Field> field;
};

bool outsideTheRoom(glm::vec3 p) {
    return glm::any(glm::lessThan(p, kLower)) || glm::any(glm::greaterThan(p, kUpper));
}

bool inAPillar(glm::vec3 p) {
    const auto within = [&](float x) { return std::abs(p.x - x) < 0.8f && std::abs(p.z - x) < 0.8f; };
    return within(1.5f) || within(-1.5f);
}

/// Points on the floor and the ceiling, but for those under the pillars.
std::vector<FieldQuery> floorAndCeiling() {
    std::vector<FieldQuery> queries;
    std::uint32_t state = 3;
    while (queries.size() < 600) {
        const float x = 6 * kernels::nextRandom(state) - 3, z = 6 * kernels::nextRandom(state) - 3;
        if (inAPillar({x, 1, z})) continue;
        const bool up = queries.size() % 2 == 0;
        const glm::vec3 n(0, up ? 1.0f : -1.0f, 0);
        queries.push_back({{x, up ? 0.0f : 3.0f, z}, n, n});
    }
    return queries;
}

class BackendSolid : public EveryBackend {
protected:
    SolidWorld world(Scene scene, int updates) const { return {context, GetParam(), std::move(scene), updates}; }
};
PROBEGI_ON_EVERY_BACKEND(BackendSolid);

// In thick walls, mirrored ones too, and beyond a hull of sheets: by winding, whatever the material.
TEST_P(BackendSolid, probesInMatterAreFoundWhateverTheMaterial) {
    for (const bool doubleSided : {false, true}) {
        const SolidWorld s = world(pillars(doubleSided), 20);
        int solid = 0;
        for (int probe = 0; probe < 8 * 5 * 8; ++probe) {
            const glm::vec3 p = probePosition(s.field->desc().volumes[0], probe);
            const bool expected = outsideTheRoom(p) || inAPillar(p);
            solid += expected ? 1 : 0;
            if (expected)
                EXPECT_GT(s.share(probe), 0.3f) << p.x << " " << p.y << " " << p.z << " two sides " << doubleSided;
            else
                EXPECT_LT(s.share(probe), 0.01f) << p.x << " " << p.y << " " << p.z << " two sides " << doubleSided;
        }
        EXPECT_EQ(solid, 320 - 6 * 3 * 6 + 2 * 3);
    }
}

TEST_P(BackendSolid, theFlagOfSolidsDoesNotChangeTheField) {
    const SolidWorld one = world(pillars(false), 20), two = world(pillars(true), 20);
    const auto queries = floorAndCeiling();
    const auto light = made(lightAt(*two.field, queries)), expected = made(lightAt(*one.field, queries));
    EXPECT_GT(expected[0], 0.01);
    EXPECT_LT(made(compareLight(light, expected)).rms, 1e-3);
}

// A sheet with two sides is no wall: what is behind it, by its winding, is lit and answers. By symmetry both sides of
// this one are equally bright.
TEST_P(BackendSolid, aCurtainIsLitFromBothSides) {
    const SolidWorld wall = world(curtain(false), 60), cloth = world(curtain(true), 60);
    for (const float z : {-1.5f, -0.5f, 0.5f, 1.5f})
        for (const float y : {0.5f, 1.5f, 2.5f}) {
            if (std::abs(z) < 1 && y == 1.5f) {
                EXPECT_GT(wall.shareAt({0.5f, y, z}), 0.3f) << "half of what it hits is the curtain's back";
            }
            EXPECT_LT(cloth.shareAt({0.5f, y, z}), 0.25f);
            EXPECT_LT(cloth.shareAt({-0.5f, y, z}), 0.01f);
        }
    std::vector<FieldQuery> queries;
    for (const float side : {-1.0f, 1.0f})
        for (float z = -1.6f; z < 1.7f; z += 0.2f)
            for (float y = 0.4f; y < 2.6f; y += 0.2f) queries.push_back({{0, y, z}, {side, 0, 0}, {side, 0, 0}});
    const auto e = made(lightAt(*cloth.field, queries));
    const std::span front = std::span(e).first(e.size() / 2), back = std::span(e).last(e.size() / 2);
    const LightDifference d = made(compareLight(back, front));
    RecordProperty("backOverFront", std::to_string(d.mean));
    RecordProperty("rms", std::to_string(d.rms));
    EXPECT_GT(std::accumulate(front.begin(), front.end(), 0.0) / double(front.size()), 0.05);
    EXPECT_NEAR(d.mean, 1.0, 0.02);
    EXPECT_LT(d.rms, 0.05);
}

TEST_P(BackendSolid, agreesWithTheCpuOnWhoIsSolid) {
    const SolidWorld own = world(curtain(true), 30), reference(context, kCpu, curtain(true), 30);
    for (int probe = 0; probe < 8 * 5 * 8; ++probe) EXPECT_NEAR(own.share(probe), reference.share(probe), 0.04f);
}

// Ray data of the caller's own. Both of a datum's signs are negative on the back of a surface with two sides.
TEST_P(BackendSolid, aDoorThatMovesOverAProbeIsFollowed) {
    const FieldSetup desc = smallDesc();
    Field field = makeField(desc);
    const int probe = 2 + 6 * (1 + 4 * 2);
    const auto update = [&](bool inside) {
        auto data = constantData(desc, glm::vec3(1.0f), 5.0f);
        for (int ray = 0; inside && ray < desc.raysPerProbe; ++ray)
            data[std::size_t(probe * desc.raysPerProbe + ray)] = {glm::vec3(-0.2f), -0.05f};
        ASSERT_TRUE(field.update(data));
    };
    const auto updatesUntil = [&](bool inside, auto reached) {
        int updates = 0;
        while (updates < 200 && !reached(probeBackfaceShare(field, probe))) {
            update(inside);
            ++updates;
        }
        return updates;
    };
    for (int i = 0; i < 60; ++i) update(false);
    EXPECT_EQ(probeBackfaceShare(field, probe), 0.0f);
    // 1 - 0.97^n: as fast as for a single-sided door.
    EXPECT_EQ(updatesUntil(true, [](float share) { return share > 0.3f; }), 12);
    for (int i = 0; i < 100; ++i) update(true);
    EXPECT_GT(probeBackfaceShare(field, probe), 0.95f);
    EXPECT_LE(updatesUntil(false, [](float share) { return share < 0.25f; }), 46);
}

TEST_P(BackendSolid, lightFromTheBackOfTwoSidesCounts) {
    for (const BackfaceRule rule : {BackfaceRule::zeroSample, BackfaceRule::excluded}) {
        FieldSetup desc = smallDesc();
        desc.backfaceRule = rule;
        Field lit = makeField(desc), black = makeField(desc);
        ASSERT_TRUE(lit.update(constantData(desc, glm::vec3(-2.0f), -0.5f)));
        ASSERT_TRUE(black.update(constantData(desc, glm::vec3(-1e-30f), -0.5f)));
        const float e = 2 * 3.14159265f;
        EXPECT_NEAR(probeIrradiance(lit, 7, {0, 1, 0}).y, e, 0.01f * e);
        EXPECT_LT(probeIrradiance(black, 7, {0, 1, 0}).y, 1e-6f);
        // The true distance, not the fifth that a backface counts with.
        EXPECT_NEAR(probeDistanceMoments(lit, 7, {0, 0, 1}).x, 0.5f, 1e-3f);
        EXPECT_NEAR(probeDistanceMoments(black, 7, {0, 0, 1}).x, 0.5f, 1e-3f);
        EXPECT_EQ(probeBackfaceShare(lit, 7), 1.0f) << "nothing but backs";
    }
}

}  // namespace
}  // namespace probegi::test

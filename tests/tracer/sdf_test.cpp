#include <cmath>
#include <limits>

#include "kernels/sdf/union_hit.h"
#include "probegi/shapes.h"
#include "sdf/solid.h"
#include "sdf_scene.h"
#include "support/analytic_tracer.h"
#include "support/sdf_tracers.h"
#include "tracer_scene.h"

namespace probegi::test {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

using Sdf = EverySdfTracer;

TEST_P(Sdf, tellsTheSurface) {
    SdfPrimitive lamp = sdfSphere({0, 0, -5}, 1);
    lamp.albedo = {0.25f, 0.5f, 0.75f};
    lamp.emission = {3, 2, 1};
    const auto tracer = make({{sdfBox({4, -1, -1}, {6, 1, 1}), lamp}});
    const Shot front = shoot(*tracer, rayAlong({0, 0, 0}, {0, 0, -1}));
    ASSERT_TRUE(front.hit.valid());
    EXPECT_EQ(front.hit.primitive, 1);
    EXPECT_NEAR(front.hit.distance, 4, 1e-5);
    EXPECT_LT(glm::length(front.surface.position - glm::vec3(0, 0, -4)), 1e-5);
    EXPECT_LT(glm::length(front.surface.geometricNormal - glm::vec3(0, 0, 1)), 1e-5);
    EXPECT_LT(glm::length(front.surface.shadingNormal - glm::vec3(0, 0, 1)), 1e-5);
    EXPECT_EQ(front.surface.albedo, lamp.albedo);
    EXPECT_EQ(front.surface.emission, lamp.emission);
    EXPECT_EQ(front.surface.roughness, 1);
    EXPECT_EQ(front.surface.metallic, 0);
    EXPECT_EQ(front.surface.material, -1);
    EXPECT_FALSE(front.surface.back || front.surface.backface);
    EXPECT_TRUE(front.blocked);

    // From within: a wall that gives no light, whose normal faces the origin.
    const Shot within = shoot(*tracer, rayAlong({0, 0, -5}, {1, 0, 0}));
    ASSERT_TRUE(within.hit.valid());
    EXPECT_NEAR(within.hit.distance, 1, 1e-5);
    EXPECT_LT(glm::length(within.surface.geometricNormal - glm::vec3(-1, 0, 0)), 1e-5);
    EXPECT_EQ(within.surface.emission, glm::vec3(0));
    EXPECT_TRUE(within.surface.back && within.surface.backface);
    EXPECT_FALSE(shoot(*tracer, rayAlong({0, 0, 0}, {-1, 0, 0})).hit.valid());
}

// Black faces but for +Z, which is red to the left of its middle and green to the right: texels of a third of a metre.
TEST_P(Sdf, showsTheColoursOfFaces) {
    SdfPrimitive box = sdfBox({-1, -1, -7}, {1, 1, -5});
    box.faces.assign(216, glm::vec3(0.0f));
    for (std::size_t i = 0; i < 36; ++i) box.faces[5 * 36 + i] = i % 6 < 3 ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
    const auto tracer = make({{box}});
    const auto albedoAt = [&](float x) { return shoot(*tracer, rayAlong({x, 0.2f, 0}, {0, 0, -1})).surface.albedo; };
    EXPECT_LT(glm::length(albedoAt(-0.6f) - glm::vec3(1, 0, 0)), 1e-4f);
    EXPECT_LT(glm::length(albedoAt(0.6f) - glm::vec3(0, 1, 0)), 1e-4f);
    EXPECT_LT(glm::length(albedoAt(0.0f) - glm::vec3(0.5f, 0.5f, 0)), 1e-4f);
    const Shot back = shoot(*tracer, rayAlong({0.6f, 0.2f, -12}, {0, 0, 1}));
    EXPECT_LT(glm::length(back.surface.albedo), 1e-4f);
}

// Where solids overlap or touch there is no surface between them.
TEST_P(Sdf, leavesTheUnionAsOneSolid) {
    const auto tracer =
        make({{sdfBox({0, 0, 0}, {1, 1, 1}), sdfBox({2.5f, 0, 0}, {4, 1, 1}), sdfBox({1, 0, 0}, {2, 1, 1}),
               sdfBox({1.5f, 0, 0}, {3, 1, 1}), sdfBox({5, 0, 0}, {6, 1, 1})}});
    const Shot along = shoot(*tracer, rayAlong({0.25f, 0.5f, 0.5f}, {1, 0, 0}));
    ASSERT_TRUE(along.hit.valid());
    EXPECT_EQ(along.hit.primitive, 1);
    EXPECT_NEAR(along.hit.distance, 3.75, 1e-5);
    EXPECT_TRUE(along.surface.backface);
    const Shot back = shoot(*tracer, rayAlong({3.5f, 0.5f, 0.5f}, {-1, 0, 0}));
    EXPECT_EQ(back.hit.primitive, 0);
    EXPECT_NEAR(back.hit.distance, 3.5, 1e-5);
    const Shot between = shoot(*tracer, rayAlong({4.5f, 0.5f, 0.5f}, {1, 0, 0}));
    EXPECT_EQ(between.hit.primitive, 4);
    EXPECT_NEAR(between.hit.distance, 0.5, 1e-5);
    EXPECT_FALSE(between.surface.backface);
    // Not past its end.
    Ray shorter = rayAlong({0.25f, 0.5f, 0.5f}, {1, 0, 0});
    shorter.far = 3.7f;
    EXPECT_FALSE(shoot(*tracer, shorter).hit.valid());
    shorter.far = 3.8f;
    EXPECT_TRUE(shoot(*tracer, shorter).hit.valid());
    EXPECT_TRUE(shoot(*tracer, shorter).blocked);
}

TEST_P(Sdf, nearAndFarBoundTheHits) {
    const auto tracer = make({{sdfBox({1, -1, -1}, {2, 1, 1}), sdfBox({4, -1, -1}, {5, 1, 1})}});
    Ray ray = rayAlong({0, 0, 0}, {1, 0, 0});
    const auto distance = [&](float near, float far) {
        ray.near = near;
        ray.far = far;
        const Shot shot = shoot(*tracer, ray);
        EXPECT_EQ(shot.hit.valid(), shot.blocked) << near << ' ' << far;
        return shot.hit.valid() ? shot.hit.distance : -1;
    };
    EXPECT_EQ(distance(0, 1e30f), 1);
    EXPECT_EQ(distance(0, kInfinity), 1);
    EXPECT_EQ(distance(1, 1e30f), 1);
    EXPECT_EQ(distance(0, 1), 1);
    EXPECT_EQ(distance(0, 0.99f), -1);
    EXPECT_EQ(distance(1.5f, 1e30f), 2) << "begins inside";
    EXPECT_EQ(distance(1.5f, 1.9f), -1);
    EXPECT_EQ(distance(2, 1e30f), 4) << "begins as it leaves";
    EXPECT_EQ(distance(2.5f, 1e30f), 4);
    EXPECT_EQ(distance(6, 1e30f), -1);
    EXPECT_EQ(distance(-3, 1e30f), 1);
}

// Where a ray begins on a face, as most shadow rays nearly do.
TEST_P(Sdf, originsOnFaces) {
    const auto tracer = make({{sdfBox({0, -1, 0}, {1, 0, 1})}});
    EXPECT_FALSE(shoot(*tracer, rayAlong({0.5f, 0, 0.5f}, {0, 1, 0})).hit.valid());
    EXPECT_FALSE(shoot(*tracer, rayAlong({0.5f, 0, 0.5f}, {1, 1, 0.5f})).hit.valid());
    EXPECT_FALSE(shoot(*tracer, rayAlong({0.5f, 4e-6f, 0.5f}, {1, 0, 0})).hit.valid());
    EXPECT_FALSE(shoot(*tracer, rayAlong({0.5f, 4e-6f, 0.5f}, {1, 1e-4f, 0})).hit.valid());
    const Shot into = shoot(*tracer, rayAlong({0.5f, 0, 0.5f}, {0, -1, 0}));
    ASSERT_TRUE(into.hit.valid());
    EXPECT_EQ(into.hit.distance, 0);
    EXPECT_FALSE(into.surface.backface);
}

TEST_P(Sdf, uselessRaysHitNothing) {
    const auto tracer = make({{sdfBox({-1, -1, -1}, {1, 1, 1}), sdfSphere({3, 0, 0}, 1)}});
    for (const glm::vec3 bad : {glm::vec3(kNan, 0, 0), glm::vec3(0, kInfinity, 0), glm::vec3(0, 0, -kNan)}) {
        const Shot origin = shoot(*tracer, {bad, 0, {1, 0, 0}, 1e30f});
        EXPECT_FALSE(origin.hit.valid() || origin.blocked);
        const Shot direction = shoot(*tracer, {{-5, 0, 0}, 0, bad, 1e30f});
        EXPECT_FALSE(direction.hit.valid() || direction.blocked);
    }
    EXPECT_FALSE(shoot(*tracer, {{-5, 0, 0}, 0, {0, 0, 0}, 1e30f}).hit.valid());
    EXPECT_FALSE(shoot(*tracer, {{-5, 0, 0}, 9, {1, 0, 0}, 3}).blocked);
    EXPECT_FALSE(shoot(*tracer, {{-5, 0, 0}, 0, {1, 0, 0}, kNan}).blocked);
}

TEST_P(Sdf, uselessRaysDoNotHarmOthers) {
    const auto tracer = make({{sdfBox({1, -1, -1}, {2, 1, 1})}});
    for (const float bad : {kNan, kInfinity, -kInfinity}) {
        std::vector<Ray> rays(64, rayAlong({0, 0, 0}, {1, 0, 0}));
        rays[5].origin.x = rays[20].origin.y = rays[40].far = rays[50].direction.z = bad;
        std::vector<Hit> hits(rays.size());
        std::vector<std::uint8_t> blocked(rays.size());
        tracer->closestHits(rays, hits).value();
        tracer->occluded(rays, blocked).value();
        for (std::size_t i = 0; i < rays.size(); ++i) {
            if (i == 5 || i == 20 || i == 40 || i == 50) continue;
            EXPECT_EQ(hits[i].distance, 1) << i;
            EXPECT_EQ(blocked[i], 1) << i;
        }
    }
}

TEST_P(Sdf, noPrimitivesAreNeverHit) {
    const auto tracer = make({});
    const Shot shot = shoot(*tracer, rayAlong({0, 0, 0}, {1, 0, 0}));
    EXPECT_FALSE(shot.hit.valid() || shot.blocked);
    EXPECT_EQ(tracer->bounds().size(), glm::vec3(0));
    EXPECT_EQ(tracer->emitters(), nullptr);
}

TEST_P(Sdf, boundsAreTightAndWithoutPlanes) {
    SdfPrimitive plane, capsule, turned = sdfBox({-1, -1, -1}, {1, 1, 1});
    plane.shape = SdfShape::plane;
    capsule.shape = SdfShape::capsule;
    capsule.centre = {10, 0, 0};
    capsule.halfSize = {0.5f, 2, 9};
    turned.rotation = glm::angleAxis(0.78539816f, glm::vec3(0, 0, 1));
    const Bounds bounds = make({{plane, capsule, turned}})->bounds();
    EXPECT_LT(glm::length(bounds.lower - glm::vec3(-std::sqrt(2.0f), -2.5f, -1)), 1e-5);
    EXPECT_LT(glm::length(bounds.upper - glm::vec3(10.5f, 2.5f, 1)), 1e-5);
}

// Rays for which all is said by the kernels' plain loops.
Hit plainHit(const std::vector<kernels::SdfSolid>& solids, const Ray& ray) {
    kernels::SdfFound enter = kernels::sdfFoundNone(ray.far), leave = kernels::sdfFoundNone(ray.near);
    float seam = 0;
    for (bool on = true; on; seam = kernels::kSdfSeam) {
        on = false;
        for (std::size_t i = 0; i < solids.size(); ++i) {
            const kernels::SdfSpan span = kernels::sdfRaySpan(solids[i], ray.origin, ray.direction);
            if (seam == 0) kernels::sdfEnter(enter, span, ray.near, int(i));
            on = kernels::sdfLeave(leave, span, seam, int(i)) || on;
        }
        if (leave.solid < 0) break;
    }
    const bool within = leave.solid >= 0;
    const kernels::SdfFound found = within ? leave : enter;
    if (found.solid < 0 || found.distance > ray.far || found.distance >= kernels::kSdfFar) return {};
    return {found.distance, found.solid, within ? kernels::kSdfFromWithin : kernels::kSdfFront, -1, {0, 0}};
}

// Rays as probes have them: of one direction, of one origin, and of nothing in common; many begin inside.
std::vector<Ray> raysOfAllKinds(SdfDice& dice) {
    std::vector<Ray> rays;
    for (int group = 0; group < 60; ++group) {
        const glm::vec3 origin = dice.vector(-4, 4), direction = dice.direction();
        for (int i = 0; i < 32; ++i) {
            Ray ray = rayAlong(origin, direction);
            if (group % 3 == 0) ray.origin += dice.vector(-0.5f, 0.5f);
            if (group % 3 == 1) ray.direction = dice.direction();
            if (group % 3 == 2) ray = rayAlong(dice.vector(-4, 4), dice.direction());
            if (i % 4 == 3) ray.far = dice.between(0, 8);
            rays.push_back(ray);
        }
    }
    return rays;
}

TEST_P(Sdf, hitsAreThoseOfPlainLoops) {
    SdfDice dice;
    int hits = 0, within = 0, other = 0, rays = 0;
    for (const int count : {1, 3, 17, 64, 200}) {
        const SdfScene sdf = randomPrimitives(dice, count);
        std::vector<kernels::SdfSolid> solids;
        for (const SdfPrimitive& p : sdf.primitives) solids.push_back(makeSolid(p));
        const auto tracer = make(sdf);
        const std::vector<Ray> all = raysOfAllKinds(dice);
        std::vector<Hit> found(all.size());
        std::vector<std::uint8_t> blocked(all.size());
        tracer->closestHits(all, found).value();
        tracer->occluded(all, blocked).value();
        for (std::size_t i = 0; i < all.size(); ++i, ++rays) {
            const Hit plain = plainHit(solids, all[i]);
            const bool same = plain.valid() == found[i].valid() && plain.geometry == found[i].geometry &&
                              std::abs(plain.distance - found[i].distance) <=
                                  1e-4f * std::max(1.0f, plain.valid() ? plain.distance : 1e30f);
            if (!same) {
                ++other;  // grazing rays, which rounding decides
                continue;
            }
            hits += plain.valid();
            within += plain.valid() && plain.geometry == kernels::kSdfFromWithin;
            // One that begins inside may be blocked though its way out is beyond its end.
            EXPECT_TRUE(blocked[i] == (found[i].valid() ? 1 : 0) ||
                        (blocked[i] == 1 && signedDistance(sdf, all[i].origin) < 0))
                << i;
        }
    }
    EXPECT_GT(hits, rays / 3);
    EXPECT_GT(within, rays / 25);
    EXPECT_LE(other, rays / 1000);
}

// What a ray hits does not depend on the others of its batch.
TEST_P(Sdf, batchesDoNotMatter) {
    SdfDice dice;
    const auto tracer = make(randomPrimitives(dice, 40));
    const std::vector<Ray> all = raysOfAllKinds(dice);
    std::vector<Hit> found(all.size()), parts(all.size());
    std::vector<std::uint8_t> blocked(all.size()), blockedParts(all.size());
    tracer->closestHits(all, found).value();
    tracer->occluded(all, blocked).value();
    for (std::size_t begin = 0, size = 1; begin < all.size(); begin += size, size = size % 37 + 1) {
        size = std::min(size, all.size() - begin);
        tracer->closestHits(std::span(all).subspan(begin, size), std::span(parts).subspan(begin, size)).value();
        tracer->occluded(std::span(all).subspan(begin, size), std::span(blockedParts).subspan(begin, size)).value();
    }
    for (std::size_t i = 0; i < all.size(); ++i) {
        EXPECT_EQ(found[i].distance, parts[i].distance) << i;
        EXPECT_EQ(found[i].primitive, parts[i].primitive) << i;
        EXPECT_EQ(found[i].geometry, parts[i].geometry) << i;
        EXPECT_EQ(blocked[i], blockedParts[i]) << i;
    }
}

// All results of many rays.
struct Shots {
    std::vector<Hit> hits;
    std::vector<Surface> surfaces;
    std::vector<std::uint8_t> blocked;
};

Shots shootAll(const Tracer& tracer, const std::vector<Ray>& rays) {
    Shots shots{std::vector<Hit>(rays.size()), std::vector<Surface>(rays.size()),
                std::vector<std::uint8_t>(rays.size())};
    tracer.closestHits(rays, shots.hits).value();
    tracer.surfaces(rays, shots.hits, shots.surfaces).value();
    tracer.occluded(rays, shots.blocked).value();
    return shots;
}

// Where rays from outside hit and what they see there. Returns how many of them differ: grazing ones, which rounding
// decides.
int differing(const Tracer& ours, const Tracer& theirs, const SdfScene& sdf, SdfDice& dice) {
    std::vector<Ray> rays;
    while (rays.size() < 12000) {
        const Ray ray = rayAlong(dice.vector(-4, 4), dice.direction());
        if (signedDistance(sdf, ray.origin) > 1e-3f) rays.push_back(ray);
    }
    const Shots a = shootAll(ours, rays), b = shootAll(theirs, rays);
    int hits = 0, other = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        EXPECT_EQ(a.blocked[i], a.hits[i].valid() ? 1 : 0);
        if (!a.hits[i].valid() && !b.hits[i].valid()) continue;
        ++hits;
        other += a.hits[i].valid() != b.hits[i].valid() || std::abs(a.hits[i].distance - b.hits[i].distance) > 1e-4f ||
                 glm::length(a.surfaces[i].geometricNormal - b.surfaces[i].geometricNormal) > 1e-3f;
    }
    EXPECT_GT(hits, 1000);
    return other;
}

// A scene of boxes as triangles, and spheres by their equations, give the same hits.
TEST_P(Sdf, boxesAreTheirMeshes) {
    SdfDice dice;
    SdfScene sdf;
    TestScene meshes;
    Primitive cube;
    addBox(cube, glm::vec3(-1), glm::vec3(1));
    const int mesh = meshes.addMesh(cube);
    for (int i = 0; i < 30; ++i) {
        SdfPrimitive box = sdfBox(glm::vec3(-1), glm::vec3(1));
        box.centre = dice.vector(-4, 4);
        box.halfSize = dice.vector(0.05f, 0.6f);
        if (i % 2 == 0) box.rotation = glm::angleAxis(dice.between(0, 3), dice.direction());
        sdf.primitives.push_back(box);
        meshes.place(mesh, glm::translate(glm::mat4(1), box.centre) * glm::mat4_cast(box.rotation) *
                               glm::scale(glm::mat4(1), box.halfSize));
    }
    const auto tracer = make(sdf);
    const auto embree = makeEmbreeTracer(makeContext(), meshes.scene, meshes.pose).value();
    EXPECT_LE(differing(*tracer, *embree, sdf, dice), 4);
}

TEST_P(Sdf, spheresAreTheirEquations) {
    SdfDice dice;
    SdfScene sdf;
    AnalyticTracer analytic;
    analytic.materials.emplace_back();
    for (int i = 0; i < 30; ++i) {
        sdf.primitives.push_back(sdfSphere(dice.vector(-4, 4), dice.between(0.1f, 1)));
        analytic.addSphere(sdf.primitives.back().centre, sdf.primitives.back().halfSize.x, false, 0);
    }
    EXPECT_LE(differing(*make(sdf), analytic, sdf, dice), 4);
}

INSTANTIATE_TEST_SUITE_P(All, Sdf, testing::ValuesIn(sdfTracerMakers()), nameOf<SdfTracerMaker>);

}  // namespace
}  // namespace probegi::test

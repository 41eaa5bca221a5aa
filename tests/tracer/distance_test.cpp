// Hits on shapes at distances known in closed form.
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <limits>

#include "tracer/tracer_scene.h"

namespace probegi::test {

namespace {

Primitive sphere(int segments) {
    Primitive p;
    const int rings = segments / 2;
    for (int j = 0; j <= rings; ++j) {
        for (int i = 0; i <= segments; ++i) {
            const float theta = glm::pi<float>() * float(j) / float(rings);
            const float phi = glm::two_pi<float>() * float(i % segments) / float(segments);
            p.positions.emplace_back(std::sin(theta) * std::cos(phi), std::cos(theta),
                                     -std::sin(theta) * std::sin(phi));
        }
    }
    for (int j = 0; j < rings; ++j) {
        for (int i = 0; i < segments; ++i) {
            const auto a = std::uint32_t(j * (segments + 1) + i), c = a + std::uint32_t(segments) + 1;
            p.indices.insert(p.indices.end(), {a, c, a + 1, a + 1, c, c + 1});
        }
    }
    return p;
}

}  // namespace

class TracerDistance : public EveryTracer {};
PROBEGI_ON_EVERY_TRACER(TracerDistance);

TEST_P(TracerDistance, PlaneDistanceIsHeightOverCosine) {
    TestScene s;
    s.add(quad(), glm::scale(glm::mat4(1.0f), glm::vec3(100.0f)));
    const auto tracer = trace(GetParam(), s);
    std::mt19937 random(1);
    for (int i = 0; i < 200; ++i) {
        const glm::vec3 origin = randomPoint(random, 5.0f) + glm::vec3(0, 8, 0);
        glm::vec3 direction = randomDirection(random);
        direction.y = -std::abs(direction.y) - 0.2f;
        const Ray ray = rayAlong(origin, direction);
        const Shot shot = shoot(*tracer, ray);
        ASSERT_TRUE(shot.hit.valid());
        EXPECT_TRUE(shot.blocked);
        EXPECT_NEAR(shot.hit.distance, origin.y / -ray.direction.y, 1e-4f);
        expectNear(shot.surface.position, origin + ray.direction * shot.hit.distance, 1e-4f);
        EXPECT_EQ(shot.surface.position.y, 0.0f) << "interpolated from the corners, so exactly in the plane";
        expectNear(shot.surface.geometricNormal, {0, 1, 0}, 1e-6f);
    }
}

TEST_P(TracerDistance, RayThatLeavesThePlaneMisses) {
    TestScene s;
    s.add(quad());
    const Shot shot = shoot(*trace(GetParam(), s), rayAlong({0, 1, 0}, {0.1f, 1, 0}));
    EXPECT_FALSE(shot.hit.valid());
    EXPECT_FALSE(shot.blocked);
    EXPECT_EQ(shot.hit.distance, Hit().distance);
}

TEST_P(TracerDistance, BoxFromInside) {
    TestScene s;
    std::mt19937 random(2);
    s.add(innerBox(1, random));
    const auto tracer = trace(GetParam(), s);
    for (int i = 0; i < 500; ++i) {
        const Ray ray = rayAlong(randomPoint(random, 0.9f), randomDirection(random));
        float expected = 1e30f;
        for (int axis = 0; axis < 3; ++axis) {
            const float d = ray.direction[axis];
            if (d != 0.0f) expected = std::min(expected, ((d > 0 ? 1.0f : -1.0f) - ray.origin[axis]) / d);
        }
        const Shot shot = shoot(*tracer, ray);
        ASSERT_TRUE(shot.hit.valid());
        EXPECT_NEAR(shot.hit.distance, expected, 1e-5f);
        EXPECT_FALSE(shot.surface.backface);
        EXPECT_LT(glm::dot(shot.surface.geometricNormal, ray.direction), 0.0f);
    }
}

TEST_P(TracerDistance, TessellatedSphereLiesBetweenItsRadii) {
    TestScene s;
    constexpr int kSegments = 64;
    s.add(sphere(kSegments));
    const auto tracer = trace(GetParam(), s);
    // A facet's circumscribed circle spans less than one step of the tessellation.
    const float inner = std::cos(glm::two_pi<float>() / kSegments);
    std::mt19937 random(3);
    for (int i = 0; i < 500; ++i) {
        const glm::vec3 direction = randomDirection(random);
        const Shot outwards = shoot(*tracer, rayAlong(glm::vec3(0.0f), direction));
        ASSERT_TRUE(outwards.hit.valid());
        EXPECT_LE(outwards.hit.distance, 1.0f + 1e-5f);
        EXPECT_GE(outwards.hit.distance, inner);
        EXPECT_TRUE(outwards.surface.backface) << "its fronts are outside";
        const Shot inwards = shoot(*tracer, rayAlong(-3.0f * direction, direction));
        ASSERT_TRUE(inwards.hit.valid());
        EXPECT_NEAR(inwards.hit.distance, 2.0f + 0.5f * (1.0f - inner), 0.5f * (1.0f - inner) + 1e-5f);
        EXPECT_FALSE(inwards.surface.backface);
    }
}

TEST_P(TracerDistance, NearAndFarLimitTheRay) {
    TestScene s;
    s.add(quad());
    s.add(quad(), glm::translate(glm::mat4(1.0f), glm::vec3(0, -1, 0)));
    const auto tracer = trace(GetParam(), s);
    const auto at = [&](float near, float far) { return shoot(*tracer, {{0.1f, 1, 0.2f}, near, {0, -1, 0}, far}); };
    // Not the same to the bit: Embree divides by approximate reciprocals, which processors compute differently.
    EXPECT_FLOAT_EQ(at(0.0f, 1e30f).hit.distance, 1.0f);
    EXPECT_FLOAT_EQ(at(1.5f, 1e30f).hit.distance, 2.0f);
    EXPECT_FALSE(at(2.5f, 1e30f).hit.valid());
    EXPECT_FALSE(at(2.5f, 1e30f).blocked);
    EXPECT_FALSE(at(0.0f, 0.5f).hit.valid());
    EXPECT_FALSE(at(0.0f, 0.5f).blocked);
    EXPECT_FALSE(at(1.25f, 1.75f).blocked);
    EXPECT_TRUE(at(1.25f, 2.25f).blocked);
}

TEST_P(TracerDistance, EmptySceneHasZeroBoundsAndNoHits) {
    for (const bool withMesh : {false, true}) {
        TestScene s;
        if (withMesh) s.scene.meshes.emplace_back();
        if (withMesh) s.place(0);
        const auto tracer = trace(GetParam(), s);
        EXPECT_EQ(tracer->bounds().size(), glm::vec3(0.0f));
        const Shot shot = shoot(*tracer, rayAlong({0, 1, 0}, {0, -1, 0}));
        EXPECT_FALSE(shot.hit.valid());
        EXPECT_FALSE(shot.blocked);
        tracer->closestHits({}, {}).value();
        tracer->occluded({}, {}).value();
    }
}

TEST_P(TracerDistance, BoundsCoverAllPlacements) {
    TestScene s;
    const int mesh = s.addMesh(quad());
    s.place(mesh, glm::translate(glm::mat4(1.0f), glm::vec3(10, 3, 0)));
    s.place(mesh, glm::translate(glm::mat4(1.0f), glm::vec3(-10, -2, 0)));
    s.add(quad(), glm::translate(glm::mat4(1.0f), glm::vec3(0, 0, 7)));
    const Bounds bounds = trace(GetParam(), s)->bounds();
    expectNear(bounds.lower, {-11, -2, -1}, 1e-4f);
    expectNear(bounds.upper, {11, 3, 8}, 1e-4f);
}

TEST_P(TracerDistance, ZeroAreaTrianglesAreHarmless) {
    TestScene s;
    Primitive p = quad();
    p.indices.insert(p.indices.end(), {0, 0, 0, 1, 1, 2, 0, 2, 0});
    s.add(p);
    s.add(quad(), glm::scale(glm::mat4(1.0f), glm::vec3(0.0f)));
    const int flat = s.addMesh(quad());
    s.place(flat, glm::translate(glm::mat4(1.0f), glm::vec3(0, -1, 0)));
    s.place(flat, glm::scale(glm::mat4(1.0f), glm::vec3(1, 0, 0)));
    const auto tracer = trace(GetParam(), s);
    std::mt19937 random(4);
    for (int i = 0; i < 200; ++i) {
        const glm::vec3 target = glm::vec3(0.9f, 0, 0.9f) * randomPoint(random, 1.0f);
        const Shot shot = shoot(*tracer, rayAlong({0.3f, 1, 0.1f}, target - glm::vec3(0.3f, 1, 0.1f)));
        ASSERT_TRUE(shot.hit.valid());
        expectNear(shot.surface.geometricNormal, {0, 1, 0}, 1e-6f);
    }
}

TEST_P(TracerDistance, NonFiniteRaysHitNothing) {
    TestScene s;
    s.add(quad());
    const auto tracer = trace(GetParam(), s);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    std::vector<Ray> rays(40, rayAlong({0, 1, 0}, {0, -1, 0}));
    rays[3].direction.x = nan;
    rays[7].origin.y = nan;
    rays[9].far = nan;
    std::vector<Hit> hits(rays.size());
    tracer->closestHits(rays, hits).value();
    std::vector<std::uint8_t> blocked(rays.size());
    tracer->occluded(rays, blocked).value();
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const bool finite = i != 3 && i != 7 && i != 9;
        EXPECT_EQ(hits[i].valid(), finite) << i;
        EXPECT_EQ(blocked[i] != 0, finite) << i;
    }
}

}  // namespace probegi::test

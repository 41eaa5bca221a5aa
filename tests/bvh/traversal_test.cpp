// Rays through the trees: closed forms, brute force, instances, masks, edges and invalid rays.
#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <limits>

#include "bvh/soups.h"

namespace probegi::test {

namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

Ray down(float x, float z, float near = 0.0f, float far = 1e30f) {
    return {{x, 1, z}, near, {0, -1, 0}, far};
}

SceneTriangles floorAt(float y) {
    SceneTriangles soup;
    addTriangle(soup, {-4, y, -4}, {-4, y, 4}, {4, y, -4});
    addTriangle(soup, {4, y, 4}, {4, y, -4}, {-4, y, 4});
    return soup;
}

/// A sphere of triangles with exactly shared corners.
SceneTriangles sphere(int rings) {
    SceneTriangles soup;
    const int segments = 2 * rings;
    for (int j = 0; j <= rings; ++j) {
        for (int i = 0; i < segments; ++i) {
            const float theta = 3.14159265f * float(j) / float(rings), phi = 6.2831853f * float(i) / float(segments);
            const float s = j == 0 || j == rings ? 0.0f : std::sin(theta);
            soup.positions.emplace_back(s * std::cos(phi), std::cos(theta), s * std::sin(phi));
        }
    }
    for (int j = 0; j < rings; ++j) {
        for (int i = 0; i < segments; ++i) {
            const auto a = std::uint32_t(j * segments + i), b = std::uint32_t(j * segments + (i + 1) % segments);
            const std::uint32_t c = a + std::uint32_t(segments), d = b + std::uint32_t(segments);
            soup.indices.insert(soup.indices.end(), {a, c, b, b, c, d});
        }
    }
    return soup;
}

/// Expects the result of brute force, unless that depends on rounding.
void expectBruteForce(const TracedWorld& world, const SceneTriangles& soup, const Ray& ray) {
    double margin = 1.0;
    const double expected = nearestDistance(soup, ray, margin);
    if (margin < 1e-5) return;
    const Hit hit = closestHit(world, ray);
    EXPECT_EQ(hit.valid(), expected < 1e30);
    EXPECT_EQ(occluded(world, ray), expected < 1e30);
    if (!hit.valid()) return;
    EXPECT_NEAR(hit.distance, expected, 1e-5 * std::max(1.0, expected));
}

}  // namespace

TEST(BvhTraversal, PlaneDistanceAndBarycentrics) {
    const TracedWorld world = worldOf(buildOpaque(floorAt(-1.0f)));
    std::mt19937 random(1);
    for (int i = 0; i < 300; ++i) {
        const glm::vec3 target = glm::vec3(3.9f, 0, 3.9f) * randomIn(random, 1.0f) + glm::vec3(0, -1, 0);
        const glm::vec3 origin = randomIn(random, 3.0f) + glm::vec3(0, 4, 0);
        const Ray ray{origin, 0, glm::normalize(target - origin), 1e30f};
        const Hit hit = closestHit(world, ray);
        ASSERT_TRUE(hit.valid());
        EXPECT_NEAR(hit.distance, glm::distance(origin, target), 1e-5f);
        EXPECT_EQ(hit.geometry, 0);
        EXPECT_EQ(hit.instance, -1);
        const float sign = hit.primitive == 0 ? 1.0f : -1.0f;
        EXPECT_NEAR(sign * (8.0f * hit.barycentric.y - 4.0f), target.x, 1e-5f);
        EXPECT_NEAR(sign * (8.0f * hit.barycentric.x - 4.0f), target.z, 1e-5f);
    }
}

TEST(BvhTraversal, NearAndFarLimitTheRay) {
    SceneTriangles soup = floorAt(0.0f);
    for (const glm::vec3& p : floorAt(-1.0f).positions) {
        soup.indices.push_back(std::uint32_t(soup.positions.size()));
        soup.positions.push_back(p);
    }
    const TracedWorld world = worldOf(buildOpaque(soup));
    const auto at = [&](float near, float far) { return closestHit(world, down(0.1f, 0.2f, near, far)).distance; };
    EXPECT_EQ(at(0.0f, 1e30f), 1.0f);
    EXPECT_EQ(at(0.0f, kInf), 1.0f);
    EXPECT_EQ(at(1.0f, 1.0f), 1.0f) << "both ends count";
    EXPECT_EQ(at(1.5f, 1e30f), 2.0f);
    EXPECT_EQ(at(2.5f, 1e30f), Hit().distance);
    EXPECT_EQ(at(0.0f, 0.5f), Hit().distance);
    EXPECT_FALSE(occluded(world, down(0.1f, 0.2f, 1.25f, 1.75f)));
    EXPECT_TRUE(occluded(world, down(0.1f, 0.2f, 1.25f, 2.25f)));
}

TEST(BvhTraversal, RandomSoupsAsByDefinition) {
    std::mt19937 random(2);
    for (const int count : {1, 3, 30, 400}) {
        const SceneTriangles soup = randomSoup(random, count);
        const TracedWorld world = worldOf(buildOpaque(soup));
        for (int i = 0; i < 3000; ++i)
            expectBruteForce(world, soup, {randomIn(random, 2.0f), 0.0f, randomUnit(random), i % 2 ? 1.0f : 1e30f});
    }
}

TEST(BvhTraversal, RaysAlongTheAxes) {
    std::mt19937 random(3);
    const SceneTriangles soup = randomSoup(random, 300);
    const TracedWorld world = worldOf(buildOpaque(soup));
    for (int i = 0; i < 3000; ++i) {
        glm::vec3 direction(0.0f);
        direction[i % 3] = i % 2 == 0 ? 1.0f : -1.0f;
        if (i % 5 == 0) direction[(i + 1) % 3] = -0.0f;
        if (i % 7 == 0) direction[(i + 2) % 3] = 1e-30f;
        expectBruteForce(world, soup, {randomIn(random, 1.2f), 0.0f, direction, 1e30f});
    }
}

TEST(BvhTraversal, RefittedAsByDefinition) {
    std::mt19937 random(4);
    SceneTriangles soup = randomSoup(random, 300);
    TriangleBvh bvh = buildOpaque(soup);
    for (glm::vec3& p : soup.positions) p = glm::vec3(p.y, 2.0f * p.x, -p.z) + randomIn(random, 0.05f);
    refit(bvh, soup.soup(), {});
    const TracedWorld world = worldOf(bvh);
    for (int i = 0; i < 3000; ++i)
        expectBruteForce(world, soup, {randomIn(random, 2.0f), 0.0f, randomUnit(random), 1e30f});
}

TEST(BvhTraversal, NoRayEscapesAtEdgesAndCorners) {
    const SceneTriangles soup = sphere(40);
    const glm::vec3 centres[] = {{0, 0, 0}, {300, -70, 20}};
    std::mt19937 random(5);
    std::uniform_int_distribution<std::size_t> pick(0, soup.indices.size() / 3 - 1);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    for (const glm::vec3& centre : centres) {
        SceneTriangles moved = soup;
        for (glm::vec3& p : moved.positions) p += centre;
        const TracedWorld world = worldOf(buildOpaque(moved));
        std::size_t lost = 0;
        for (int i = 0; i < 300000; ++i) {
            const std::size_t k = 3 * pick(random);
            const glm::vec3 a = moved.positions[moved.indices[k]], b = moved.positions[moved.indices[k + 1]];
            const glm::vec3 target = i % 4 == 0 ? a : a + (b - a) * unit(random);
            const glm::vec3 origin = centre + randomIn(random, 0.5f);
            lost += closestHit(world, {origin, 0, glm::normalize(target - origin), 1e30f}).valid() ? 0 : 1;
        }
        EXPECT_EQ(lost, 0u);
    }
}

TEST(BvhTraversal, InstancesAsIfTheirTrianglesStoodThere) {
    std::mt19937 random(6);
    const SceneTriangles group = randomSoup(random, 60), own = randomSoup(random, 40);
    const TriangleBvh groupBvh = buildOpaque(group);
    SceneTriangles all = own;
    TracedWorld world = worldOf(buildOpaque(own));
    const std::uint32_t root = world.arrays.append(groupBvh);
    std::vector<glm::mat4> transforms;
    std::vector<Bounds> boxes;
    for (int i = 0; i < 25; ++i) {
        glm::mat4 m = glm::translate(glm::mat4(1.0f), randomIn(random, 4.0f));
        m = glm::rotate(m, float(i), randomUnit(random));
        m = glm::scale(m, glm::vec3(i % 3 == 0 ? -1.0f : 0.5f, 0.7f + 0.1f * float(i), 0.01f * float(1 << (i % 8))));
        transforms.push_back(m);
        boxes.push_back(placedBounds(groupBvh.bounds, m));
        for (std::size_t k = 0; k < group.positions.size(); k += 3) {
            const auto at = [&](std::size_t c) { return glm::vec3(m * glm::vec4(group.positions[k + c], 1.0f)); };
            addTriangle(all, at(0), at(1), at(2));
        }
    }
    const InstanceBvh top = buildInstanceBvh(makeContext(), boxes).value();
    for (const std::uint32_t i : top.order) world.instances.push_back(makeBvhInstance(transforms[i], root, int(i)));
    world.instancesRoot = world.arrays.append(top);
    std::size_t inInstances = 0;
    for (int i = 0; i < 10000; ++i) {
        const Ray ray{randomIn(random, 5.0f), 0.0f, randomUnit(random), 1e30f};
        double margin = 1.0;
        const double expected = nearestDistance(all, ray, margin);
        if (margin < 1e-3) continue;
        const Hit hit = closestHit(world, ray);
        ASSERT_EQ(hit.valid(), expected < 1e30);
        EXPECT_EQ(occluded(world, ray), hit.valid());
        if (!hit.valid()) continue;
        EXPECT_NEAR(hit.distance, expected, 1e-3 * std::max(0.1, expected));
        inInstances += hit.instance >= 0 ? 1 : 0;
        EXPECT_LT(hit.instance, 25);
        EXPECT_LT(hit.primitive, hit.instance < 0 ? 40 : 60);
    }
    EXPECT_GT(inInstances, 500u);
    // Without the world's own triangles.
    world.worldRoot = kernels::kBvhNone;
    for (int i = 0; i < 1000; ++i) {
        const Ray ray{randomIn(random, 5.0f), 0.0f, randomUnit(random), 1e30f};
        EXPECT_EQ(closestHit(world, ray).valid(), occluded(world, ray));
        EXPECT_EQ(closestHit(world, ray).valid(), closestHit(world, ray).instance >= 0);
    }
}

TEST(BvhTraversal, MaskedTrianglesAskAndOpaqueOnesDoNot) {
    const SceneTriangles masked = floorAt(0.0f), opaque = floorAt(-1.0f);
    TracedWorld world = worldOf(buildTriangleBvh(makeContext(), opaque.soup(), masked.soup()).value());
    // Solid where the second corner has more than half the weight.
    world.alphaPasses = [](int instance, int primitive, glm::vec2 barycentric) {
        EXPECT_EQ(instance, -1);
        EXPECT_LT(primitive, 2);
        return barycentric.x > 0.5f;
    };
    const Hit solid = closestHit(world, down(-3.5f, 3.0f)), hole = closestHit(world, down(-3.5f, -3.0f));
    EXPECT_EQ(solid.distance, 1.0f);
    EXPECT_EQ(solid.geometry, 1);
    EXPECT_EQ(hole.distance, 2.0f);
    EXPECT_EQ(hole.geometry, 0);
    EXPECT_TRUE(occluded(world, down(-3.5f, 3.0f, 0.0f, 1.5f)));
    EXPECT_FALSE(occluded(world, down(-3.5f, -3.0f, 0.0f, 1.5f)));
}

TEST(BvhTraversal, InvalidRaysHitNothing) {
    std::mt19937 random(7);
    const TracedWorld world = worldOf(buildOpaque(randomSoup(random, 1000)));
    const glm::vec3 o(0, 0, 3), d(0, 0, -1);
    for (const Ray& ray : {Ray{{kNan, 0, 3}, 0, d, 1e30f}, Ray{{0, kInf, 3}, 0, d, 1e30f}, Ray{o, kNan, d, 1e30f},
                           Ray{o, 0, {0, kNan, -1}, 1e30f}, Ray{o, 0, {0, 0, -kInf}, 1e30f}, Ray{o, 0, d, kNan},
                           Ray{o, 0, {0, 0, 0}, 1e30f}, Ray{o, 2, d, 1}, Ray{o, kInf, d, kInf}}) {
        EXPECT_FALSE(closestHit(world, ray).valid());
        EXPECT_FALSE(occluded(world, ray));
        EXPECT_EQ(closestHit(world, ray).distance, Hit().distance);
    }
    EXPECT_EQ(world.nodeVisits, 0u);
}

TEST(BvhTraversal, EmptySceneHasNoHits) {
    const TracedWorld world = worldOf(buildOpaque({}));
    EXPECT_EQ(world.worldRoot, kernels::kBvhNone);
    EXPECT_FALSE(closestHit(world, down(0, 0)).valid());
    EXPECT_FALSE(occluded(world, down(0, 0)));
}

TEST(BvhTraversal, HugeAndTinyScenes) {
    std::mt19937 random(8);
    for (const float scale : {1e-6f, 1e5f, 1e9f}) {
        SceneTriangles soup = randomSoup(random, 100, 0.8f);
        for (glm::vec3& p : soup.positions) p *= scale;
        const TracedWorld scaled = worldOf(buildOpaque(soup));
        std::size_t hits = 0;
        for (int i = 0; i < 1000; ++i) {
            const Ray ray{randomIn(random, 2.0f), 0.0f, randomUnit(random), 1e30f};
            double margin = 1.0;
            const Ray large{ray.origin * scale, 0.0f, ray.direction, 1e30f};
            const double expected = nearestDistance(soup, large, margin);
            if (margin < 1e-4) continue;
            const Hit hit = closestHit(scaled, large);
            ASSERT_EQ(hit.valid(), expected < 1e30);
            if (!hit.valid()) continue;
            ++hits;
            EXPECT_NEAR(hit.distance, expected, 1e-5 * std::max(double(scale), expected));
        }
        EXPECT_GT(hits, 100u);
    }
}

}  // namespace probegi::test

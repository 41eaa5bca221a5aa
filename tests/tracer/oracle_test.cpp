// Random triangle soups, placed by all kinds of transforms, against a brute-force intersector in double precision.
#include <cstring>
#include <glm/ext/quaternion_float.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>

#include "tracer/tracer_scene.h"

namespace probegi::test {

namespace {

struct Nearest {
    double distance = 1e30;
    double margin = 1.0;  ///< least barycentric weight of all triangles hit or nearly hit
    glm::dvec3 normal{0.0};
};

/// Moeller and Trumbore 1997, "Fast, Minimum Storage Ray/Triangle Intersection", equation 6.
void intersect(const Ray& ray, const glm::dvec3 (&corner)[3], Nearest& nearest) {
    const glm::dvec3 direction(ray.direction);
    const glm::dvec3 e1 = corner[1] - corner[0], e2 = corner[2] - corner[0];
    const glm::dvec3 p = glm::cross(direction, e2);
    const double determinant = glm::dot(e1, p);
    if (determinant == 0.0) return;
    const glm::dvec3 s = glm::dvec3(ray.origin) - corner[0];
    const glm::dvec3 q = glm::cross(s, e1);
    const double u = glm::dot(s, p) / determinant, v = glm::dot(direction, q) / determinant;
    const double t = glm::dot(e2, q) / determinant;
    const double inside = std::min({u, v, 1.0 - u - v});
    if (t < double(ray.near) || t > double(ray.far)) return;
    nearest.margin = std::min(nearest.margin, std::abs(inside));
    if (inside < 0.0 || t >= nearest.distance) return;
    nearest.distance = t;
    nearest.normal = glm::cross(e1, e2);
}

Nearest bruteForce(const TestScene& s, const Ray& ray) {
    Nearest nearest;
    for (const Instance& instance : s.pose.instances) {
        const glm::dmat4 toWorld(instance.toWorld);
        const bool mirrored = glm::determinant(toWorld) < 0.0;
        for (const Primitive& p : s.scene.meshes[std::size_t(instance.mesh)].primitives) {
            for (std::size_t i = 0; i < p.indices.size(); i += 3) {
                glm::dvec3 corner[3];
                for (std::size_t k = 0; k < 3; ++k)
                    corner[k] = glm::dvec3(toWorld * glm::dvec4(glm::dvec3(p.positions[p.indices[i + k]]), 1.0));
                if (mirrored) std::swap(corner[1], corner[2]);
                intersect(ray, corner, nearest);
            }
        }
    }
    return nearest;
}

Primitive soup(int triangles, std::mt19937& random) {
    Primitive p;
    for (int i = 0; i < triangles; ++i) {
        const glm::vec3 centre = randomPoint(random, 1.0f);
        for (int k = 0; k < 3; ++k) {
            p.indices.push_back(std::uint32_t(p.positions.size()));
            p.positions.push_back(centre + randomPoint(random, 0.25f));
        }
    }
    return p;
}

glm::mat4 randomTransform(std::mt19937& random, bool mirrored) {
    std::uniform_real_distribution<float> scale(0.5f, 1.5f), angle(0.0f, 6.28f);
    glm::mat4 m = glm::translate(glm::mat4(1.0f), randomPoint(random, 2.0f));
    m = glm::rotate(m, angle(random), randomDirection(random));
    const float x = scale(random), y = scale(random), z = scale(random);
    return glm::scale(m, glm::vec3(mirrored ? -x : x, y, z));
}

/// Two soups placed once (one of them mirrored), and one placed four times, two of them mirrored.
TestScene makeSoups() {
    TestScene s;
    std::mt19937 random(11);
    s.add(soup(60, random), randomTransform(random, false));
    s.add(soup(60, random), randomTransform(random, true));
    const int shared = s.addMesh(soup(40, random));
    for (int i = 0; i < 4; ++i) s.place(shared, randomTransform(random, i % 2 == 1));
    return s;
}

std::vector<Ray> randomRays(std::size_t count) {
    std::mt19937 random(12);
    std::uniform_real_distribution<float> length(0.5f, 8.0f);
    std::vector<Ray> rays(count);
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 origin = randomPoint(random, 3.0f);
        rays[i] = rayAlong(origin, randomPoint(random, 2.0f) - origin);
        if (i % 3 == 0) rays[i].near = 0.3f;
        if (i % 4 == 0) rays[i].far = length(random);
    }
    return rays;
}

}  // namespace

class TracerOracle : public EveryTracer {};
PROBEGI_ON_EVERY_TRACER(TracerOracle);

TEST_P(TracerOracle, AgreesWithBruteForce) {
    const TestScene s = makeSoups();
    const auto tracer = trace(GetParam(), s);
    const std::vector<Ray> rays = randomRays(3000);
    std::vector<Hit> hits(rays.size());
    std::vector<Surface> surfaces(rays.size());
    std::vector<std::uint8_t> blocked(rays.size());
    tracer->closestHits(rays, hits).value();
    tracer->surfaces(rays, hits, surfaces).value();
    tracer->occluded(rays, blocked).value();
    int compared = 0, hit = 0, backfaces = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const Nearest expected = bruteForce(s, rays[i]);
        if (expected.margin < 1e-4) continue;  // near an edge, both results are right
        ++compared;
        ASSERT_EQ(hits[i].valid(), expected.distance < 1e30) << i;
        EXPECT_EQ(blocked[i] == 1, hits[i].valid()) << i;
        if (!hits[i].valid()) continue;
        ++hit;
        EXPECT_NEAR(hits[i].distance, expected.distance, 1e-4) << i;
        expectNear(surfaces[i].position, rays[i].origin + rays[i].direction * float(expected.distance), 1e-4f);
        const bool away = glm::dot(expected.normal, glm::dvec3(rays[i].direction)) > 0.0;
        const glm::dvec3 normal = glm::normalize(expected.normal) * (away ? -1.0 : 1.0);
        EXPECT_GT(glm::dot(normal, glm::dvec3(surfaces[i].geometricNormal)), 0.999) << i;
        EXPECT_EQ(surfaces[i].backface, away) << i;
        backfaces += away ? 1 : 0;
    }
    EXPECT_GT(compared, 2500);
    EXPECT_GT(hit, 500);
    EXPECT_GT(backfaces, 200);
}

TEST(EmbreeTracerOracle, SharedMeshesAreInstances) {
    const TestScene s = makeSoups();
    const auto tracer = trace(tracerMakers()[0], s);
    const std::vector<Ray> rays = randomRays(1000);
    std::vector<Hit> hits(rays.size());
    tracer->closestHits(rays, hits).value();
    int instanced = 0, merged = 0;
    for (const Hit& hit : hits) {
        if (!hit.valid()) continue;
        ++(hit.instance >= 0 ? instanced : merged);
        EXPECT_LT(hit.primitive, hit.instance >= 0 ? 40 : 120);
        EXPECT_GE(hit.geometry, 0);
    }
    EXPECT_GT(instanced, 50);
    EXPECT_GT(merged, 50);
}

TEST_P(TracerOracle, ARayDoesNotDependOnItsBatch) {
    const TestScene s = makeSoups();
    const auto tracer = trace(GetParam(), s);
    std::vector<Ray> rays = randomRays(1003);
    for (std::size_t i = 400; i < 700; ++i)  // coherent, like rows of pixels
        rays[i] = rayAlong({0, 0, 5}, {-0.3f + 0.002f * float(i - 400), 0.1f, -1});
    std::vector<Hit> together(rays.size());
    std::vector<std::uint8_t> blocked(rays.size());
    tracer->closestHits(rays, together).value();
    tracer->occluded(rays, blocked).value();
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const Shot alone = shoot(*tracer, rays[i]);
        EXPECT_EQ(alone.hit.primitive, together[i].primitive) << i;
        EXPECT_EQ(alone.hit.instance, together[i].instance) << i;
        EXPECT_EQ(alone.hit.geometry, together[i].geometry) << i;
        EXPECT_FLOAT_EQ(alone.hit.distance, together[i].distance) << i;
        EXPECT_EQ(alone.blocked, blocked[i] == 1) << i;
    }
}

TEST_P(TracerOracle, TheBuildDoesNotDependOnThreads) {
    const TestScene s = makeSoups();
    const auto one = trace(GetParam(), s, 1);
    const auto four = trace(GetParam(), s, 4);
    const std::vector<Ray> rays = randomRays(2000);
    std::vector<Hit> a(rays.size()), b(rays.size());
    one->closestHits(rays, a).value();
    four->closestHits(rays, b).value();
    EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(Hit)), 0);
}

}  // namespace probegi::test

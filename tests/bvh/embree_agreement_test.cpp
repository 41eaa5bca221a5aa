// The kernels' traversal, compiled as C++, against Embree on the same scenes.
#include <cmath>
#include <random>

#include "bvh/scene_bvh.h"
#include "probegi/builtin_scenes.h"
#include "probegi/io.h"
#include "support/scenes.h"

namespace probegi::test {

namespace {

constexpr std::size_t kBatch = 4096;

struct Compared {
    std::size_t rays = 0, hits = 0;
    std::size_t different = 0;    ///< hit against miss, or another distance
    std::size_t unexplained = 0;  ///< of these, not at an edge or a tie
    std::size_t occlusion = 0;    ///< of different occlusion
};

Ray randomRay(std::mt19937& random, const Bounds& bounds) {
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    std::normal_distribution<float> normal;
    const glm::vec3 place(unit(random), unit(random), unit(random));
    glm::vec3 direction(0.0f);
    while (glm::length(direction) < 1e-3f) direction = glm::vec3(normal(random), normal(random), normal(random));
    return {bounds.lower + place * bounds.size(), 0.0f, glm::normalize(direction), 1e30f};
}

/// Equal to a relative 1e-4, or to eight units in the last place of the largest coordinate, which limit short
/// distances: two mappings of the origin into an instance's space differ by as much (against doubles, Embree's is
/// farther off).
bool sameDistance(float a, float b, float magnitude) {
    return std::abs(a - b) <= std::max(1e-4f * std::min(a, b), 8.0f * 1.1920929e-7f * magnitude);
}

/// Whether rounding explains a difference: at the edge of a triangle, or of the solid part of a mask, the same ray
/// turned by a few units in the last place gets the other result.
bool atAnEdge(const Tracer& embree, const TracedWorld& world, const Ray& ray, const Hit& ours, const Hit& theirs) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> turn(-1e-5f, 1e-5f);
    for (int i = 0; i < 64; ++i) {
        Ray turned = ray;
        turned.direction = glm::normalize(ray.direction + glm::vec3(turn(random), turn(random), turn(random)));
        Hit other;
        embree.closestHits({&turned, 1}, {&other, 1}).value();
        const float tolerance = 1e-3f * std::max(1.0f, other.distance);
        if (other.valid() == ours.valid() && (!ours.valid() || std::abs(other.distance - ours.distance) < tolerance))
            return true;
        other = closestHit(world, turned);
        if (other.valid() == theirs.valid() &&
            (!theirs.valid() || std::abs(other.distance - theirs.distance) < tolerance))
            return true;
    }
    return false;
}

Compared compare(const Scene& scene, std::size_t count, unsigned seed) {
    const ScenePose pose = poseAt(scene);
    const Context context = makeContext(2);
    const auto embree = makeEmbreeTracer(context, scene, pose).value();
    const SceneBvh bvh(context, scene, pose);
    const glm::vec3 corner = glm::max(glm::abs(embree->bounds().lower), glm::abs(embree->bounds().upper));
    const float magnitude = std::max({corner.x, corner.y, corner.z});
    std::mt19937 random(seed);
    std::vector<Ray> rays(kBatch);
    std::vector<Hit> hits(kBatch);
    std::vector<std::uint8_t> blocked(kBatch);
    Compared result;
    while (result.rays < count) {
        for (Ray& ray : rays) ray = randomRay(random, embree->bounds());
        embree->closestHits(rays, hits).value();
        for (std::size_t i = 0; i < kBatch; ++i) {
            const Hit ours = closestHit(bvh.world(), rays[i]);
            result.hits += hits[i].valid() ? 1 : 0;
            if (ours.valid() == hits[i].valid() &&
                (!ours.valid() || sameDistance(ours.distance, hits[i].distance, magnitude)))
                continue;
            ++result.different;
            result.unexplained += atAnEdge(*embree, bvh.world(), rays[i], ours, hits[i]) ? 0 : 1;
        }
        for (Ray& ray : rays) ray.far = 2.0f;
        embree->occluded(rays, blocked).value();
        for (std::size_t i = 0; i < kBatch; ++i)
            result.occlusion += occluded(bvh.world(), rays[i]) != (blocked[i] == 1) ? 1 : 0;
        result.rays += kBatch;
    }
    return result;
}

void expectAgreement(const Scene& scene, std::size_t count) {
    const Compared result = compare(scene, count, 7);
    const double allowed = 1e-5 * double(result.rays);
    EXPECT_GT(double(result.hits), 0.05 * double(result.rays));
    EXPECT_LT(double(result.different), allowed);
    EXPECT_LT(double(result.occlusion), allowed);
    EXPECT_EQ(result.unexplained, 0u);
    testing::Test::RecordProperty("different", int(result.different));
    testing::Test::RecordProperty("occlusion", int(result.occlusion));
}

}  // namespace

TEST(EmbreeAgreement, BuiltinScenes) {
    for (const BuiltinScene& builtin : builtinScenes()) {
        SCOPED_TRACE(builtin.name);
        expectAgreement(makeBuiltinScene(builtin.name).value(), 200'000);
    }
}

TEST(EmbreeAgreement, CornellBoxAMillionRays) {
    expectAgreement(makeBuiltinScene("cornell").value(), 1'000'000);
}

TEST(EmbreeAgreement, SponzaAMillionRays) {
    const Result<LoadedScene> loaded = loadScene(scenesFolder() / "sponza/sponza.glb");
    ASSERT_TRUE(loaded) << loaded.error().message;
    expectAgreement(loaded->scene, 1'000'000);
}

}  // namespace probegi::test

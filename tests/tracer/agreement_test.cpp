// Every tracer against Embree: a million random rays in each built-in scene and in Sponza.
#include <cmath>

#include "probegi/builtin_scenes.h"
#include "probegi/io.h"
#include "support/scenes.h"
#include "tracer/tracer_scene.h"

namespace probegi::test {

namespace {

constexpr std::size_t kRays = 1'000'000;
constexpr double kRelative = 1e-4;      // how closely distances agree
constexpr float kBeside = 1e-4f;        // radians within which an edge explains a different result
constexpr double kMostOutliers = 1e-5;  // share of the rays

struct World {
    Scene scene;
    ScenePose pose;
    std::unique_ptr<Tracer> tracer, reference;

    World(const TracerMaker& maker, Scene own) : scene(std::move(own)), pose(poseAt(scene)) {
        const Context context = makeContext(2);
        auto made = maker.make(context, scene, pose);
        if (!made) throw std::runtime_error(made.error().message);  // fails the test
        tracer = std::move(*made);
        reference = makeEmbreeTracer(context, scene, pose).value();
    }
};

/// Rays from anywhere in the bounds in all directions.
std::vector<Ray> randomRays(const Bounds& bounds, std::size_t count) {
    std::mt19937 random(51);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    std::vector<Ray> rays(count);
    for (Ray& ray : rays) {
        const float x = unit(random), y = unit(random), z = unit(random);
        ray = rayAlong(bounds.lower + glm::vec3(x, y, z) * bounds.size(), randomDirection(random));
    }
    return rays;
}

bool sameDistance(const Hit& a, const Hit& b, double relative) {
    if (a.valid() != b.valid()) return false;
    return !a.valid() || std::abs(double(a.distance) - b.distance) <= relative * std::max(1.0f, b.distance);
}

/// The ray and others a little beside it.
std::vector<Ray> bundle(const Ray& ray) {
    const glm::vec3 axis = std::abs(ray.direction.x) < 0.7f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
    const glm::vec3 u = glm::normalize(glm::cross(ray.direction, axis)), v = glm::cross(ray.direction, u);
    std::vector<Ray> rays{ray};
    for (int i = 0; i < 32; ++i) {
        const float angle = 0.7853981f * float(i), radius = kBeside * (i < 16 ? 1.0f : 0.2f);
        const glm::vec3 aside = std::cos(angle) * u + std::sin(angle) * v;
        Ray beside = ray;
        // Turned or shifted: only a shift gets past an edge near the origin.
        if (i % 16 < 8)
            beside.direction = glm::normalize(ray.direction + radius * aside);
        else
            beside.origin += radius * aside;
        rays.push_back(beside);
    }
    return rays;
}

/// Whether the reference gives the other result for a nearby ray: then both are right.
bool explained(const Tracer& reference, const Ray& ray, const Hit& answer) {
    const std::vector<Ray> beside = bundle(ray);
    std::vector<Hit> hits(beside.size());
    reference.closestHits(beside, hits).value();
    for (const Hit& hit : hits)
        if (sameDistance(answer, hit, 10 * kRelative)) return true;
    return false;
}

bool occlusionExplained(const Tracer& reference, const Ray& ray, bool answer) {
    for (const float length : {1.0f - 1e-4f, 1.0f, 1.0f + 1e-4f}) {
        std::vector<Ray> beside = bundle(ray);
        for (Ray& r : beside) r.far *= length;
        std::vector<std::uint8_t> blocked(beside.size());
        reference.occluded(beside, blocked).value();
        for (const std::uint8_t b : blocked)
            if ((b == 1) == answer) return true;
    }
    return false;
}

void expectSameHits(const World& world, const std::vector<Ray>& rays) {
    std::vector<Hit> own(rays.size()), reference(rays.size());
    world.tracer->closestHits(rays, own).value();
    world.reference->closestHits(rays, reference).value();
    std::size_t outliers = 0, hits = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        hits += reference[i].valid() ? 1 : 0;
        if (sameDistance(own[i], reference[i], kRelative)) continue;
        ++outliers;
        EXPECT_TRUE(explained(*world.reference, rays[i], own[i]))
            << "ray " << i << ": " << own[i].distance << " instead of " << reference[i].distance;
    }
    EXPECT_GT(hits, rays.size() / 10);
    EXPECT_LT(double(outliers), kMostOutliers * double(rays.size()));
    testing::Test::RecordProperty("outliers", std::to_string(outliers));
}

void expectSameOcclusion(const World& world, std::vector<Ray> rays) {
    std::mt19937 random(52);
    std::uniform_real_distribution<float> share(0.02f, 0.5f);
    const float size = glm::length(world.pose.bounds.size());
    for (Ray& ray : rays) ray.far = share(random) * size;
    std::vector<std::uint8_t> own(rays.size()), reference(rays.size());
    world.tracer->occluded(rays, own).value();
    world.reference->occluded(rays, reference).value();
    std::size_t outliers = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (own[i] == reference[i]) continue;
        ++outliers;
        EXPECT_TRUE(occlusionExplained(*world.reference, rays[i], own[i] == 1)) << "ray " << i;
    }
    EXPECT_LT(double(outliers), kMostOutliers * double(rays.size()));
    testing::Test::RecordProperty("occlusionOutliers", std::to_string(outliers));
}

void expectAgreement(const World& world) {
    const Bounds bounds = world.tracer->bounds(), reference = world.reference->bounds();
    expectNear(bounds.lower, reference.lower, 1e-4f * glm::length(reference.size()));
    expectNear(bounds.upper, reference.upper, 1e-4f * glm::length(reference.size()));
    const std::vector<Ray> rays = randomRays(reference, kRays);
    expectSameHits(world, rays);
    expectSameOcclusion(world, rays);
}

/// explained() on a closed form: the square of quad(), whose edges are known.
TEST(Explanation, isAnEdgeNearbyAndNothingElse) {
    TestScene s;
    s.add(quad());
    const auto reference = makeEmbreeTracer(makeContext(), s.scene, s.pose).value();
    const auto answerOf = [](float distance) {
        Hit hit;
        hit.distance = distance;
        hit.primitive = 0;
        return hit;
    };
    const auto down = [](float x) { return rayAlong({x, 1, 0.3f}, {0, -1, 0}); };
    EXPECT_TRUE(explained(*reference, down(0.2f), answerOf(1.0f)));
    EXPECT_FALSE(explained(*reference, down(0.2f), answerOf(1.01f)));
    EXPECT_FALSE(explained(*reference, down(0.2f), Hit()));
    EXPECT_TRUE(explained(*reference, down(0.99995f), Hit()));
    EXPECT_TRUE(explained(*reference, down(1.00005f), answerOf(1.0f)));
    EXPECT_FALSE(explained(*reference, down(0.999f), Hit()));
    EXPECT_FALSE(explained(*reference, down(1.001f), answerOf(1.0f)));
    Ray touching = down(0.2f);
    touching.far = 1.0f;
    EXPECT_TRUE(occlusionExplained(*reference, touching, true));
    EXPECT_TRUE(occlusionExplained(*reference, touching, false));
    touching.far = 1.1f;
    EXPECT_FALSE(occlusionExplained(*reference, touching, false));
}

}  // namespace

class TracerAgreement : public EveryTracer {};
PROBEGI_ON_EVERY_TRACER(TracerAgreement);

TEST_P(TracerAgreement, inEveryBuiltinScene) {
    for (const BuiltinScene& builtin : builtinScenes()) {
        SCOPED_TRACE(std::string(builtin.name));
        expectAgreement(World(GetParam(), makeBuiltinScene(builtin.name).value()));
    }
}

TEST_P(TracerAgreement, inEverySceneFile) {
    for (const char* name : {"sponza/sponza.glb", "openarena/oa_dm1.glb", "rtxgi/cornell.glb", "rtxgi/furnace.glb",
                             "rtxgi/two-rooms.glb"}) {
        SCOPED_TRACE(name);
        auto loaded = loadScene(scenesFolder() / name);
        ASSERT_TRUE(loaded) << loaded.error().message;
        expectAgreement(World(GetParam(), std::move(loaded->scene)));
    }
}

// Surfaces agree too where both hit the same place.
TEST_P(TracerAgreement, surfacesLookTheSame) {
    auto loaded = loadScene(scenesFolder() / "sponza" / "sponza.glb");
    ASSERT_TRUE(loaded) << loaded.error().message;
    const World world(GetParam(), std::move(loaded->scene));
    const std::vector<Ray> rays = randomRays(world.pose.bounds, 50000);
    std::vector<Hit> own(rays.size()), reference(rays.size());
    std::vector<Surface> ownSurfaces(rays.size()), surfaces(rays.size());
    world.tracer->closestHits(rays, own).value();
    world.tracer->surfaces(rays, own, ownSurfaces).value();
    world.reference->closestHits(rays, reference).value();
    world.reference->surfaces(rays, reference, surfaces).value();
    std::size_t compared = 0, differing = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (!reference[i].valid() || !sameDistance(own[i], reference[i], kRelative)) continue;
        // Sponza has coincident surfaces, where either hit is right; inEverySceneFile covers those.
        if (own[i].primitive != reference[i].primitive || own[i].geometry != reference[i].geometry) continue;
        ++compared;
        const Surface &a = ownSurfaces[i], &b = surfaces[i];
        const bool same =
            a.backface == b.backface && a.material == b.material && glm::distance(a.position, b.position) < 2e-3f &&
            glm::dot(a.geometricNormal, b.geometricNormal) > 0.9999f &&
            glm::dot(a.shadingNormal, b.shadingNormal) > 0.999f && glm::distance(a.albedo, b.albedo) < 0.01f &&
            std::abs(a.roughness - b.roughness) < 0.01f && std::abs(a.metallic - b.metallic) < 0.01f;
        differing += same ? 0 : 1;
    }
    EXPECT_GT(compared, rays.size() / 2);
    // Rounding may select another texel.
    EXPECT_LT(double(differing), 2e-4 * double(compared));
    RecordProperty("differing", std::to_string(differing));
}

}  // namespace probegi::test

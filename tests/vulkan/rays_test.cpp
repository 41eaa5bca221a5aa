// Invalid rays and ray data, and moving scenes.
#include <limits>
#include <random>

#include "kernels/abi/gpu_passes.h"
#include "support/field_setup.h"
#include "support/probes.h"
#include "support/vulkan_device.h"
#include "vulkan/device/exchange.h"
#include "vulkan/scene/gpu_scene_impl.h"
#include "vulkan/small_world.h"

namespace probegi::test {

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kHuge = std::numeric_limits<float>::max();
constexpr float kOdd[] = {kNan, -kNan, kInfinity, -kInfinity, kHuge, -kHuge, 1e38f, -1e30f, 1e-42f, -0.0f};

class VulkanRays : public testing::Test {
protected:
    static void expectFinite(const Field& field) {
        const int probes = probeCount(field.desc());
        for (int probe = 0; probe < probes; ++probe) {
            EXPECT_TRUE(probeBackfaceShare(field, probe) >= 0.0f && probeBackfaceShare(field, probe) <= 1.0f) << probe;
            for (const glm::vec3 direction : {glm::vec3(0, 1, 0), glm::vec3(-0.6f, 0, 0.8f), glm::vec3(0, -1, 0)}) {
                EXPECT_TRUE(finite(probeIrradiance(field, probe, direction))) << probe;
                const glm::vec2 moments = probeDistanceMoments(field, probe, direction);
                EXPECT_TRUE(std::isfinite(moments.x) && std::isfinite(moments.y) && moments.x >= 0) << probe;
            }
        }
    }

    const SmallWorld world;
};

std::vector<Ray> randomRays(const Bounds& bounds, int count) {
    std::mt19937 random(11);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    std::vector<Ray> rays;
    while (int(rays.size()) < count) {
        const glm::vec3 at(unit(random), unit(random), unit(random));
        const glm::vec3 to = glm::vec3(unit(random), unit(random), unit(random)) - 0.5f;
        if (glm::length(to) < 0.1f) continue;
        rays.push_back({bounds.lower + bounds.size() * at, 0.0f, glm::normalize(to), 1e30f});
    }
    return rays;
}

// A box that moves through a room and turns.
Scene animatedScene() {
    Scene scene = *makeBuiltinScene("cornell");
    const ScenePose pose = poseAt(scene);
    const float size = 0.2f * pose.bounds.size().x;
    Primitive p;
    p.positions = {{0, 0, 0}, {size, 0, 0}, {0, size, 0}, {0, 0, size}};
    p.indices = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
    p.material = 0;
    scene.meshes.push_back({"flying", {p}});
    for (int i = 0; i < 3; ++i) {
        Node node;
        node.mesh = int(scene.meshes.size()) - 1;
        const int number = scene.addNode(node);
        AnimationChannel move;
        move.node = number;
        move.path = AnimationPath::translation;
        move.times = {0.0f, 1.0f};
        const glm::vec3 from = pose.bounds.lower + pose.bounds.size() * glm::vec3(0.1f, 0.2f + 0.2f * float(i), 0.2f);
        move.values = {glm::vec4(from, 0), glm::vec4(from + 0.5f * pose.bounds.size() * glm::vec3(1, 0.1f, 1), 0)};
        scene.animations.push_back(move);
        AnimationChannel turn = move;
        turn.path = AnimationPath::rotation;
        turn.values = {{0, 0, 0, 1}, {0, 0.7071068f, 0, 0.7071068f}};
        scene.animations.push_back(turn);
    }
    return scene;
}

// Closest hits in a GpuScene, as an engine would have it.
std::vector<Hit> hitsOf(const vulkan::GpuScene& scene, std::span<const Ray> rays) {
    vulkan::Exchange exchange(testDevice());
    exchange.begin(rays.size_bytes(), rays.size() * sizeof(Hit));
    const kernels::RaysPush push{.rays = vulkan::packAddress(exchange.add(rays)),
                                 .hits = vulkan::packAddress(exchange.out()),
                                 .results = {},
                                 .count = std::uint32_t(rays.size()),
                                 .spread = 0};
    exchange.run(
        [&](const vulkan::Recorder& recorder) {
            recorder.bindScene(scene.impl().set());
            recorder.push(push);
            recorder.dispatchOver(scene.impl().shader("trace_rays"), rays.size());
        },
        rays.size() * sizeof(Hit));
    const auto hits = exchange.results<Hit>().first(rays.size());
    return {hits.begin(), hits.end()};
}

int differing(std::span<const Hit> a, std::span<const Hit> b) {
    int count = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        count += a[i].valid() != b[i].valid() ||
                 (a[i].valid() && std::abs(a[i].distance - b[i].distance) > 1e-4f * (1e-2f + b[i].distance));
    return count;
}

}  // namespace

TEST_F(VulkanRays, oddRayDataLeavesTheAtlasesFinite) {
    for (const BackfaceRule rule : {BackfaceRule::zeroSample, BackfaceRule::excluded}) {
        FieldSetup desc = world.desc;
        desc.backfaceRule = rule;
        Field field = *vulkan::makeField(testContext(), testDevice(), desc, desc);
        Field onCpu = *Field::create(testContext(), desc, desc);
        std::vector<RayDatum> rays(18 * 16);
        const std::size_t odds = std::size(kOdd);
        for (std::size_t i = 0; i < rays.size(); ++i)
            rays[i] = {{kOdd[i % odds], kOdd[(i + 3) % odds], 1.0f}, i % 3 == 0 ? 0.5f : kOdd[(i / 3) % odds]};
        for (int update = 0; update < 3; ++update) {
            ASSERT_TRUE(field.update(rays));
            ASSERT_TRUE(onCpu.update(rays));
        }
        expectFinite(field);
        expectFinite(onCpu);
        const glm::vec3 e = field.irradiance(world.query()), expected = onCpu.irradiance(world.query());
        EXPECT_TRUE(finite(e));
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(e[c], expected[c], 1e-2f * std::max(1.0f, expected[c])) << c;
        // NaN everywhere, for every ray.
        const std::vector<RayDatum> nothing(rays.size(), {glm::vec3(kNan), kNan});
        ASSERT_TRUE(field.update(nothing));
        expectFinite(field);
    }
}

TEST_F(VulkanRays, oddRaysHitNothing) {
    for (const vulkan::TracerKind kind : tracerKinds(testDevice())) {
        SCOPED_TRACE(int(kind));
        const auto tracer = vulkan::makeTracer(testContext(), testDevice(), world.scene, world.pose, {.tracer = kind});
        ASSERT_TRUE(tracer);
        const Ray good{world.pose.bounds.centre(), 0.0f, {0, -1, 0}, 1e30f};
        std::vector<Ray> odd;
        for (const float value : {kNan, kInfinity, -kInfinity})
            for (int axis = 0; axis < 3; ++axis) {
                odd.insert(odd.end(), 2, good);
                odd[odd.size() - 2].origin[axis] = value;
                odd.back().direction[axis] = value;
            }
        odd.insert(odd.end(), 3, good);
        odd[odd.size() - 3].far = kNan;
        odd[odd.size() - 2].direction = glm::vec3(0.0f);
        odd.back().far = -1.0f;
        const std::size_t refused = odd.size();
        odd.push_back(good);  // the ray itself is valid
        std::vector<Hit> hits(odd.size());
        std::vector<std::uint8_t> blocked(odd.size());
        (*tracer)->closestHits(odd, hits).value();
        (*tracer)->occluded(odd, blocked).value();
        for (std::size_t i = 0; i < refused; ++i) {
            EXPECT_FALSE(hits[i].valid()) << i;
            EXPECT_EQ(blocked[i], 0) << i;
        }
        EXPECT_TRUE(hits.back().valid());
        EXPECT_EQ(blocked.back(), 1);
        // Rays with huge numbers may hit anything, but must terminate.
        for (Ray& ray : odd) ray = good;
        for (std::size_t i = 0; i < odd.size(); ++i) {
            odd[i].origin[int(i % 3)] = kOdd[i % std::size(kOdd)];
            odd[i].direction[int(i / 3 % 3)] = kOdd[(i + 4) % std::size(kOdd)];
        }
        (*tracer)->closestHits(odd, hits).value();
        (*tracer)->occluded(odd, blocked).value();
    }
}

TEST_F(VulkanRays, movedInstancesAgreeWithANewScene) {
    const Scene scene = animatedScene();
    ASSERT_TRUE(validate(scene));
    const ScenePose start = poseAt(scene, 0.0f);
    const std::vector<Ray> rays = randomRays(start.bounds, 4000);
    for (const vulkan::TracerKind kind : tracerKinds(testDevice())) {
        SCOPED_TRACE(int(kind));
        vulkan::GpuScene moving =
            *vulkan::GpuScene::create(testContext(), testDevice(), scene, start, {.tracer = kind, .movable = true});
        vulkan::submitAndWait(testDevice(),
                              [&](const vulkan::Recorder& r) { moving.recordUpload(r.commands()).value(); });
        moving.releaseStaging();
        const std::vector<Hit> before = hitsOf(moving, rays);
        for (const float time : {0.25f, 1.0f, 0.0f}) {
            SCOPED_TRACE(time);
            const ScenePose pose = poseAt(scene, time);
            vulkan::submitAndWait(testDevice(), [&](const vulkan::Recorder& r) {
                EXPECT_TRUE(moving.recordPose(r.commands(), poseAt(scene, 0.5f)));
                EXPECT_TRUE(moving.recordPose(r.commands(), pose));
            });
            const std::vector<Hit> moved = hitsOf(moving, rays);
            std::vector<Hit> wanted(rays.size());
            (*makeEmbreeTracer(testContext(), scene, pose))->closestHits(rays, wanted).value();
            EXPECT_LE(differing(moved, wanted), 1);
            const auto fresh = vulkan::makeTracer(testContext(), testDevice(), scene, pose, {.tracer = kind});
            (*fresh)->closestHits(rays, wanted).value();
            EXPECT_LE(differing(moved, wanted), 1);
            if (time > 0) {
                EXPECT_GT(differing(moved, before), 20) << "nothing moved";
            }
        }
    }
}

TEST_F(VulkanRays, aPoseOfAnotherSceneIsRefused) {
    const Scene scene = animatedScene();
    vulkan::GpuScene moving =
        *vulkan::GpuScene::create(testContext(), testDevice(), scene, poseAt(scene), {.movable = true});
    vulkan::submitAndWait(testDevice(), [&](const vulkan::Recorder& r) {
        moving.recordUpload(r.commands()).value();
        const auto refused = moving.recordPose(r.commands(), world.pose);
        ASSERT_FALSE(refused);
        EXPECT_EQ(refused.error().code, ErrorCode::invalidArgument);
        EXPECT_TRUE(moving.recordPose(r.commands(), poseAt(scene, 1.0f)));
    });
}

}  // namespace probegi::test

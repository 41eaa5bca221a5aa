// The paper's sphere tracing on the GPU against exact intersection on the CPU.
#ifdef PROBEGI_TEST_VULKAN
#include <glm/geometric.hpp>

#include "probegi/shapes.h"
#include "sdf_scene.h"
#include "support/vulkan_device.h"
#include "tracer_scene.h"
#include "vulkan/scene/gpu_scene_impl.h"
#include "vulkan/tracers/gpu_tracer.h"
#include "vulkan/tracers/sdf_scene_tracer.h"

namespace probegi::test {
namespace {

std::unique_ptr<MovableTracer> sphereTracer(const SdfScene& sdf, const Scene& scene) {
    vulkan::GpuSceneDesc desc;
    desc.tracer = TracerKind::sdf;
    desc.sdf = &sdf;
    auto uploaded = vulkan::GpuScene::Impl::create(makeContext(), testDevice(), scene, poseAt(scene), desc,
                                                   vulkan::sphereTracedSdf());
    return std::make_unique<vulkan::GpuTracer>(testDevice(), std::move(uploaded.value()));
}

// Rays that only one of them says to miss, and hits that differ where the surface is not grazed: by more than 1e-4 m,
// and far away by more than what sphere tracing takes for the surface.
struct Difference {
    double missed = 0, moved = 0, hits = 0, within = 0;
};

Difference compare(const Tracer& traced, const Tracer& exact, SdfDice& dice) {
    std::vector<Ray> rays;
    for (int i = 0; i < 4000; ++i) rays.push_back(rayAlong(dice.vector(-4, 4), dice.direction()));
    std::vector<Hit> hits(rays.size()), expected(rays.size());
    std::vector<Surface> surfaces(rays.size()), expectedSurfaces(rays.size());
    std::vector<std::uint8_t> blocked(rays.size());
    traced.closestHits(rays, hits).value();
    traced.surfaces(rays, hits, surfaces).value();
    traced.occluded(rays, blocked).value();
    exact.closestHits(rays, expected).value();
    exact.surfaces(rays, expected, expectedSurfaces).value();
    Difference d;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        d.missed += hits[i].valid() != expected[i].valid() ? 1 : 0;
        if (!hits[i].valid() || !expected[i].valid()) continue;
        ++d.hits;
        d.within += hits[i].geometry;
        EXPECT_TRUE(blocked[i]);
        if (std::abs(glm::dot(rays[i].direction, expectedSurfaces[i].geometricNormal)) < 0.2f) continue;
        d.moved +=
            hits[i].primitive != expected[i].primitive ||
                    std::abs(hits[i].distance - expected[i].distance) > std::max(1e-4f, 6e-6f * expected[i].distance) ||
                    surfaces[i].albedo != expectedSurfaces[i].albedo
                ? 1
                : 0;
    }
    return d;
}

TEST(SphereTracedSdf, hitsWhatIsHitExactly) {
    SdfDice dice;
    SdfScene sdf = randomPrimitives(dice, 60);
    Scene scene;
    scene.materials.emplace_back();
    Primitive box;
    addBox(box, glm::vec3(0), glm::vec3(1));
    addObject(scene, box, "mover");
    for (std::size_t i = 0; i < sdf.primitives.size(); i += 7) sdf.primitives[i].node = "mover";
    const auto traced = sphereTracer(sdf, scene);
    const auto exact = makeSdfTracer(makeContext(), sdf, scene, poseAt(scene)).value();
    for (const glm::vec3 place : {glm::vec3(0), glm::vec3(1, 0.5f, -2)}) {
        scene.nodes[0].translation = place;
        traced->setPose(poseAt(scene)).value();
        exact->setPose(poseAt(scene)).value();
        const Difference d = compare(*traced, *exact, dice);
        EXPECT_GT(d.hits, 1500);
        EXPECT_GT(d.within, 50);
        EXPECT_LE(d.missed, 12);
        EXPECT_LE(d.moved, 4);
    }
}

TEST(GpuSceneDesc, primitivesAndTheirTracerComeTogether) {
    const SdfScene sdf;
    const Scene scene;
    for (const bool primitives : {false, true}) {
        vulkan::GpuSceneDesc desc;
        if (primitives) desc.sdf = &sdf;
        if (!primitives) desc.tracer = TracerKind::sdf;
        const auto made = vulkan::GpuScene::create(makeContext(), testDevice(), scene, poseAt(scene), desc);
        ASSERT_FALSE(made);
        EXPECT_EQ(made.error().code, ErrorCode::invalidArgument);
    }
    vulkan::GpuSceneDesc both;
    both.tracer = TracerKind::sdf;
    both.sdf = &sdf;
    const auto made = vulkan::GpuScene::create(makeContext(), testDevice(), scene, poseAt(scene), both);
    ASSERT_TRUE(made);
    EXPECT_EQ(made->tracer(), TracerKind::sdf);
}

}  // namespace
}  // namespace probegi::test
#endif

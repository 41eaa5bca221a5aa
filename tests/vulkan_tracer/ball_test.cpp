// A tracer unknown to the library lights a field on both backends, with the same result.
#include <gmock/gmock.h>

#include <glm/geometric.hpp>
#include <random>

#include "probegi/probegi.h"
#include "support/vulkan_device.h"
#include "vulkan/device/errors.h"
#include "vulkan/scene/gpu_scene_impl.h"
#include "vulkan/tracers/gpu_tracer.h"
#include "vulkan_tracer/ball_tracers.h"

namespace probegi::test {
namespace {

constexpr float kAlbedo = 0.5f, kEmission = 1.5f;
constexpr float kPi = 3.14159265f;

/// A furnace, and triangles that only define the ball's size; rays do not hit them.
Scene furnace() {
    Scene scene;
    scene.materials.resize(1);
    scene.materials[0].baseColor = glm::vec4(glm::vec3(kAlbedo), 1);
    scene.materials[0].emission = glm::vec3(kEmission);
    Primitive box;
    addRoom(box, {-1, 0, -1}, {3, 4, 3});
    addObject(scene, box, "bounds");
    return scene;
}

std::vector<Ray> randomRays(std::size_t count) {
    std::mt19937 random(11);
    std::uniform_real_distribution<float> at(-1, 1);
    std::vector<Ray> rays;
    while (rays.size() < count) {
        const glm::vec3 direction(at(random), at(random), at(random)), from(at(random), at(random), at(random));
        if (glm::length(direction) < 0.1f) continue;
        rays.push_back({glm::vec3(1, 2, 1) + 2.0f * from, 0, glm::normalize(direction), 3 + 3 * at(random)});
    }
    return rays;
}

class BallOnBothBackends : public testing::Test {
protected:
    FieldDesc fieldDesc() const {
        FieldDesc desc;
        desc.volumes = {{{0, 1, 0}, glm::vec3(0.5f), glm::ivec3(5)}};
        desc.raysPerProbe = 64;
        return desc;
    }
    // Light of the field at points in the ball, after some updates with the tracer.
    std::vector<glm::vec3> light(Field field, const Tracer& tracer) const {
        Lighting lighting;
        PlacedLight lamp;
        lamp.type = LightType::point;
        lamp.position = {1, 2.5f, 1};
        lamp.intensity = glm::vec3(2, 1, 0.5f);
        lighting.lights.push_back(lamp);
        for (int i = 0; i < 6; ++i) field.update(tracer, lighting).value();
        std::vector<FieldQuery> queries;
        for (const Ray& ray : randomRays(200))
            queries.push_back({glm::vec3(1, 2, 1) + 0.5f * (ray.origin - glm::vec3(1, 2, 1)), ray.direction, {}});
        std::vector<glm::vec3> irradiance(queries.size());
        field.irradiance(queries, irradiance).value();
        return irradiance;
    }

    Context context = Context::create({.threads = 2}).value();
    Scene scene = furnace();
    vulkan::GpuTracer gpu{
        testDevice(),
        vulkan::GpuScene::Impl::create(context, testDevice(), scene, poseAt(scene), {}, ballSceneTracer()).value()};
    BallTracer cpu{ballIn(gpu.bounds()), scene.materials[0]};
};

TEST_F(BallOnBothBackends, GivesTheSameHitsAndSurfaces) {
    const std::vector<Ray> rays = randomRays(3000);
    std::vector<Hit> hits(rays.size()), expected(rays.size());
    std::vector<Surface> surfaces(rays.size()), expectedSurfaces(rays.size());
    std::vector<std::uint8_t> blocked(rays.size()), expectedBlocked(rays.size());
    for (const auto& [tracer, h, s, b] :
         {std::tuple<const Tracer*, std::span<Hit>, std::span<Surface>, std::span<std::uint8_t>>{&gpu, hits, surfaces,
                                                                                                 blocked},
          {&cpu, expected, expectedSurfaces, expectedBlocked}}) {
        tracer->closestHits(rays, h).value();
        tracer->surfaces(rays, h, s).value();
        tracer->occluded(rays, b).value();
    }
    int met = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        ASSERT_EQ(hits[i].valid(), expected[i].valid()) << i;
        EXPECT_EQ(blocked[i], hits[i].valid() ? 1 : 0) << i;
        EXPECT_EQ(blocked[i], expectedBlocked[i]) << i;
        if (!hits[i].valid()) continue;
        ++met;
        EXPECT_NEAR(hits[i].distance, expected[i].distance, 1e-4f) << i;
        EXPECT_LT(glm::distance(surfaces[i].position, expectedSurfaces[i].position), 1e-4f) << i;
        EXPECT_LT(glm::distance(surfaces[i].shadingNormal, expectedSurfaces[i].shadingNormal), 1e-4f) << i;
        EXPECT_EQ(surfaces[i].emission, glm::vec3(kEmission));
        EXPECT_EQ(surfaces[i].albedo, glm::vec3(kAlbedo));
        EXPECT_EQ(surfaces[i].material, 0);
    }
    EXPECT_GT(met, 1000);
    EXPECT_LT(met, 2000);
}

TEST_F(BallOnBothBackends, LightsAField) {
    const auto onGpu = light(vulkan::makeField(context, testDevice(), fieldDesc()).value(), gpu);
    const auto onCpu = light(Field::create(context, fieldDesc()).value(), cpu);
    for (std::size_t i = 0; i < onGpu.size(); ++i)  // measured: 1.1e-6
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(onGpu[i][c] / onCpu[i][c], 1, 1e-5f) << i;
}

// E = pi Le / (1 - a) at every point and normal of a furnace.
TEST_F(BallOnBothBackends, IsAFurnace) {
    Field field = vulkan::makeField(context, testDevice(), fieldDesc()).value();
    field.converge(gpu, {}, 0.002f).value();
    const float expected = kPi * kEmission / (1 - kAlbedo);
    for (const glm::vec3 normal : {glm::vec3(0, 1, 0), glm::vec3(0.6f, 0, 0.8f)})
        EXPECT_NEAR(field.irradiance({{1.2f, 2.1f, 0.9f}, normal, {}}).x / expected, 1, 0.01f);
}

TEST_F(BallOnBothBackends, IsDrawn) {
    PictureDesc desc;
    desc.width = desc.height = 16;
    desc.camera.position = {1, 2, 1};
    const Picture picture = vulkan::renderPicture(context, testDevice(), gpu, {}, nullptr, desc).value().picture;
    for (const glm::vec3& depth : picture.depth.pixels) EXPECT_NEAR(depth.x, 2, 1e-4f);
    for (const glm::vec3& light : picture.color.pixels) EXPECT_NEAR(light.x, kEmission, 1e-5f);
}

}  // namespace
}  // namespace probegi::test

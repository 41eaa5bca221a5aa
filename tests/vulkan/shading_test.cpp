// Deferred shading and tone mapping in an engine's own command buffers, against the layers of the CPU's picture.
#include <cmath>

#include "kernels/screen/pinhole.h"
#include "vulkan/engine.h"
#include "vulkan/hooks.h"
#include "vulkan/log_book.h"
#include "vulkan/small_world.h"

namespace probegi::test {
namespace {

/// Surfaces at the pixels' centres by the CPU's tracer, as an engine would rasterise them.
std::vector<ScreenSample> rasterised(const Tracer& tracer, const PictureDesc& desc) {
    const kernels::PinholeCamera camera = kernels::makePinhole(
        desc.camera.position, desc.camera.forward, desc.camera.up, desc.camera.yfov, desc.width, desc.height);
    std::vector<ScreenSample> samples;
    for (int y = 0; y < desc.height; ++y)
        for (int x = 0; x < desc.width; ++x) {
            const Ray ray{camera.origin, 0.0f, kernels::pinholeDirection(camera, float(x) + 0.5f, float(y) + 0.5f)};
            Hit hit;
            Surface s;
            tracer.closestHits({&ray, 1}, {&hit, 1}).value();
            tracer.surfaces({&ray, 1}, {&hit, 1}, {&s, 1}).value();
            ScreenSample sample;
            sample.viewDirection = ray.direction;
            if (hit.valid()) {
                sample.kind = s.backface ? kSampleBackface : kSampleSurface;
                sample.position = s.position;
                sample.geometricNormal = s.geometricNormal;
                sample.shadingNormal = s.shadingNormal;
                sample.metallic = s.metallic;
                sample.roughness = s.roughness;
                sample.albedo = s.albedo;
                sample.direct = s.emission;
            }
            samples.push_back(sample);
        }
    return samples;
}

}  // namespace

TEST(VulkanShading, samplesOfAnEngineLookLikeTheCpusPicture) {
    hooks().reset();
    const SmallWorld world;
    LogBook log;
    PictureDesc desc = world.picture();
    desc.samplesPerAxis = 1;
    const auto cpuTracer = *makeEmbreeTracer(log, world.scene, world.pose);
    const std::vector<RayDatum> rays(18 * 16, RayDatum{{0.5f, 0.25f, 1.0f}, 0.6f});
    Field cpuField = *Field::create(log, world.desc, world.desc);
    ASSERT_TRUE(cpuField.update(rays));
    const Picture picture = renderPicture(log, *cpuTracer, world.lighting, &cpuField, desc)->picture;
    const std::vector<ScreenSample> samples = rasterised(*cpuTracer, desc);

    Engine engine;
    const vulkan::Device device = *vulkan::Device::adopt(log, engine.adoptDesc());
    auto scene = *vulkan::GpuScene::create(log, device, world.scene, world.pose);
    auto lighting = *vulkan::GpuLighting::create(device, world.lighting);
    auto volume = *vulkan::GpuField::create(device, world.desc, world.desc);
    const EngineBuffer rayBuffer = engine.makeBuffer(std::span(rays));
    const EngineBuffer withField = engine.makeBuffer(std::span(samples)),
                       without = engine.makeBuffer(std::span(samples));
    const std::uint32_t count = std::uint32_t(samples.size());
    engine.run([&](VkCommandBuffer commands) {
        scene.recordUpload(commands).value();
        lighting.recordUpload(commands).value();
        volume.recordClear(commands).value();
        EXPECT_TRUE(volume.recordUpdate(commands, rayBuffer.range()));
        EXPECT_TRUE(vulkan::recordShading(commands, scene, lighting, &volume, withField.address, count));
        EXPECT_TRUE(vulkan::recordShading(commands, scene, lighting, nullptr, without.address, count));
    });
    const auto got = withField.as<ScreenSample>(), unlit = without.as<ScreenSample>();
    float brightest = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const glm::vec3 direct = picture.direct.pixels[i], e = picture.irradiance.pixels[i];
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(got[i].direct[c], direct[c], 1e-3f * (direct[c] + 0.01f)) << "sample " << i;
            EXPECT_NEAR(got[i].irradiance[c], e[c], 6e-3f * (e[c] + 0.01f)) << "sample " << i;
            EXPECT_EQ(unlit[i].direct[c], got[i].direct[c]);
            EXPECT_EQ(unlit[i].irradiance[c], 0.0f);
            brightest = std::max(brightest, e[c]);
        }
    }
    EXPECT_GT(brightest, 0.1f);
}

TEST(VulkanShading, toneMappingInAnEnginesBuffersIsTheLibrarys) {
    hooks().reset();
    LogBook log;
    Engine engine;
    const vulkan::Device device = *vulkan::Device::adopt(log, engine.adoptDesc());
    const std::vector<glm::vec3> linear = {
        glm::vec3(0.0f), {0.18f, 0.5f, 1.0f}, {2, 30, 4000}, {-1, 1e-4f, NAN}, {1e9f, 0.003f, 0.02f}};
    for (const ToneMap toneMap : {ToneMap{}, ToneMap{1.7f, true}, ToneMap{1, false, false}}) {
        const EngineBuffer in = engine.makeBuffer(std::span(linear)), out = engine.makeBuffer(4 * linear.size());
        engine.run([&](VkCommandBuffer commands) {
            EXPECT_TRUE(vulkan::recordToneMap(commands, device, in.address, out.address, std::uint32_t(linear.size()),
                                              1, toneMap));
        });
        for (std::size_t i = 0; i < linear.size(); ++i) {
            const glm::vec3 display = toDisplay(linear[i], toneMap);
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(out.as<std::uint8_t>()[4 * i + std::size_t(c)], display[c] * 255.0f,
                            toneMap.dither ? 1.0f : 0.501f)
                    << i;
            EXPECT_EQ(out.as<std::uint8_t>()[4 * i + 3], 255);
        }
    }
}

TEST(VulkanShading, objectsOfTwoDevicesAreRefused) {
    hooks().reset();
    const SmallWorld world;
    LogBook log;
    Engine engine;
    const vulkan::Device one = *vulkan::Device::adopt(log, engine.adoptDesc());
    const vulkan::Device other = *vulkan::Device::adopt(log, engine.adoptDesc());
    const auto scene = *vulkan::GpuScene::create(log, one, world.scene, world.pose);
    const auto lighting = *vulkan::GpuLighting::create(other, world.lighting);
    engine.run([&](VkCommandBuffer commands) {
        const auto refused = vulkan::recordShading(commands, scene, lighting, nullptr, 0, 1);
        ASSERT_FALSE(refused);
        EXPECT_EQ(refused.error().code, ErrorCode::invalidArgument);
    });
}

// As for a new level: the probes are cleared, and the next update counts as the first.
TEST(VulkanShading, aClearedVolumeBeginsAnew) {
    hooks().reset();
    const SmallWorld world;
    LogBook log;
    Engine engine;
    const vulkan::Device device = *vulkan::Device::adopt(log, engine.adoptDesc());
    auto volume = *vulkan::GpuField::create(device, world.desc, world.desc);
    const std::vector<RayDatum> bright(18 * 16, RayDatum{glm::vec3(9.0f), 0.6f}), dim(18 * 16, {glm::vec3(0.5f), 0.6f});
    const EngineBuffer brightRays = engine.makeBuffer(std::span(bright)), dimRays = engine.makeBuffer(std::span(dim));
    const FieldQuery query = world.query();
    const EngineBuffer question = engine.makeBuffer(std::span(&query, 1)), answer = engine.makeBuffer(12);
    engine.run([&](VkCommandBuffer commands) {
        volume.recordClear(commands).value();
        for (int i = 0; i < 3; ++i) EXPECT_TRUE(volume.recordUpdate(commands, brightRays.range()));
        volume.recordClear(commands).value();
        EXPECT_EQ(volume.control().frame(), 0);
        EXPECT_TRUE(volume.recordUpdate(commands, dimRays.range()));
        EXPECT_TRUE(volume.recordQuery(commands, question.address, answer.address, 1));
    });
    EXPECT_NEAR(answer.as<glm::vec3>()[0].x, 0.5f * 3.14159265f, 0.01f);
}

}  // namespace probegi::test

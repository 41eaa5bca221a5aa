// A screen pass that no file of the library knows, on the GPU: the frames that it sees, and the CPU's same pass.
#include <gmock/gmock.h>

#include <cmath>

#include "probegi/probegi.h"
#include "render/picture_runner.h"
#include "support/vulkan_device.h"
#include "vulkan/device/exchange.h"
#include "vulkan/field/vulkan_field.h"
#include "vulkan/picture/gpu_picture.h"
#include "vulkan/tracers/gpu_tracer.h"

namespace probegi::vulkan {

// Made by the build of picture_toy.comp.
std::span<const std::uint32_t> toyPasses(std::string_view name);

}  // namespace probegi::vulkan

namespace probegi::test {
namespace {

// What picture_toy.comp does.
Result<void> toyOnCpu(PictureTask&, const PixelRect& part, Frame& frame) {
    const PixelRect& all = frame.rect();
    const int plane = frame.firstPlane();
    forEachPixel(part, [&](int x, int y) {
        const int right = std::min(x + 1, all.x + all.width - 1), below = std::min(y + 1, all.y + all.height - 1);
        frame.at(x, y, plane).direct = {frame.at(right, y, plane).distance, frame.at(x, below, plane).distance, 0};
    });
    return {};
}

class ToyPass : public testing::Test {
protected:
    ToyPass() {
        desc.camera = lookAt(pose.bounds.centre(), pose.bounds.lower);
        desc.width = 70;
        desc.height = 30;
        lighting = {pose.lights, scene.sky};
        lighting.lights.push_back({.position = pose.bounds.centre(), .intensity = {3, 2, 1}});
        lights = vulkan::GpuLighting::create(testDevice(), lighting).value();
        vulkan::submitAndWait(
            testDevice(), [&](const vulkan::Recorder& recorder) { lights.recordUpload(recorder.commands()).value(); });
    }

    Picture onGpu(const std::vector<vulkan::GpuPass>& passes, std::size_t framePixels = kFramePixels) {
        return vulkan::runPicture(context, {testDevice(), gpuScene(), lights, &field, &fieldPasses(), desc}, passes,
                                  framePixels)
            .picture;
    }
    std::vector<vulkan::GpuPass> gpuPasses(bool toy) {
        std::vector<vulkan::GpuPass> passes = vulkan::gpuPasses({gpuScene(), &fieldPasses()});
        if (toy)
            passes.insert(
                passes.end() - 1,
                {.name = "toy", .shader = vulkan::Shader("picture_toy", vulkan::toyPasses), .neighbours = true});
        return passes;
    }
    // The library's passes, but plane by plane.
    std::vector<vulkan::GpuPass> planeByPlane() {
        std::vector<vulkan::GpuPass> passes = gpuPasses(false);
        passes.insert(passes.end() - 1, {.name = "nothing", .shader = {}, .neighbours = true});
        return passes;
    }
    vulkan::FieldPasses& fieldPasses() { return dynamic_cast<const vulkan::VulkanField&>(backendOf(field)).passes(); }
    const vulkan::GpuScene& gpuScene() { return dynamic_cast<const vulkan::GpuTracer&>(*tracer).scene(); }

    Context context = Context::create({.threads = 2}).value();
    Scene scene = *makeBuiltinScene("cornell");
    ScenePose pose = poseAt(scene);
    Lighting lighting{pose.lights, scene.sky};
    PictureDesc desc;
    std::unique_ptr<Tracer> tracer = vulkan::makeTracer(context, testDevice(), scene, pose).value();
    vulkan::GpuLighting lights = vulkan::GpuLighting::create(testDevice(), lighting).value();
    Field field = lit();

    Field lit() {
        FieldDesc of;
        of.volumes = {placeVolume(pose.bounds, {.counts = {4, 4, 4}}).value()};
        Field made = vulkan::makeField(context, testDevice(), of).value();
        for (int i = 0; i < 3; ++i) made.update(*tracer, {pose.lights, scene.sky}).value();
        return made;
    }
};

void expectEqual(const Picture& a, const Picture& b) {
    EXPECT_EQ(a.color.pixels, b.color.pixels);
    EXPECT_EQ(a.direct.pixels, b.direct.pixels);
    EXPECT_EQ(a.indirect.pixels, b.indirect.pixels);
    EXPECT_EQ(a.irradiance.pixels, b.irradiance.pixels);
    EXPECT_GT(a.indirect.at(35, 15).x, 0.0f);
    EXPECT_EQ(a.albedo.pixels, b.albedo.pixels);
    EXPECT_EQ(a.normal.pixels, b.normal.pixels);
    EXPECT_EQ(a.depth.pixels, b.depth.pixels);
}

TEST_F(ToyPass, SeesNeighboursInTheWholePicture) {
    desc.samplesPerAxis = 1;
    const Picture p = onGpu(gpuPasses(true));
    for (int y = 0; y < desc.height; ++y)
        for (int x = 0; x < desc.width; ++x) {
            const float right = p.depth.at(std::min(x + 1, desc.width - 1), y).x;
            const float below = p.depth.at(x, std::min(y + 1, desc.height - 1)).x;
            ASSERT_EQ(p.direct.at(x, y), glm::vec3(right, below, 0)) << x << ' ' << y;
        }
}

TEST_F(ToyPass, IsTheCpus) {
    const auto cpuTracer = makeEmbreeTracer(context, scene, pose).value();
    std::vector<FramePass> passes = picturePasses();
    passes.insert(passes.end() - 1, {toyOnCpu, nullptr, true});
    for (const int samples : {1, 3}) {
        desc.samplesPerAxis = samples;
        // In bands, so that those end alike.
        const std::size_t framePixels = 70 * 8;
        const Picture cpu =
            runPicture(context, {*cpuTracer, lighting, nullptr, desc}, passes, framePixels).value().picture;
        const Picture gpu = onGpu(gpuPasses(true), framePixels);
        double differences = 0;
        for (std::size_t i = 0; i < cpu.direct.pixels.size(); ++i)
            differences += glm::length(cpu.direct.pixels[i] - gpu.direct.pixels[i]);
        EXPECT_LT(differences / double(cpu.direct.pixels.size()), 1e-3);  // but for rays that pass an edge
    }
}

TEST_F(ToyPass, PlanesAreSubSamples) {
    for (const int samples : {1, 2, 3}) {
        desc.samplesPerAxis = samples;
        expectEqual(onGpu(planeByPlane()), onGpu(gpuPasses(false)));
    }
}

TEST_F(ToyPass, BandsAreTheWholePicture) {
    const Picture whole = onGpu(planeByPlane());
    for (const std::size_t pixels : {70, 1, 70 * 9 + 3, 70 * 29}) expectEqual(onGpu(planeByPlane(), pixels), whole);
}

}  // namespace
}  // namespace probegi::test

// Faults below the library: lost devices, no memory, refused pipelines. The result is always an error, never a crash or
// a leak, and the CPU backend still works.
#include "support/field_setup.h"
#include "support/probes.h"
#include "vulkan/hooks.h"
#include "vulkan/log_book.h"
#include "vulkan/small_world.h"

namespace probegi::test {

namespace {

class VulkanFaults : public testing::Test {
protected:
    void SetUp() override { hooks().reset(); }
    void TearDown() override {
        EXPECT_EQ(hooks().liveObjects(), 0) << hooks().liveText();
        hooks().reset();
    }

    vulkan::Device open() {
        vulkan::OpenDesc desc;
        desc.validation = true;
        desc.getInstanceProcAddr = hookedLoader;
        auto opened = vulkan::Device::open(log, desc);
        if (!opened) throw std::runtime_error(opened.error().message);
        return *opened;
    }

    // Runs `work` repeatedly, failing one call after the other until it makes no more. Each failure must be reported.
    template <class Work>
    void failEachCall(VkResult result, const std::string& only, ErrorCode expected, const Work& work) {
        const int before = hooks().liveObjects();
        for (int n = 1; n < 500; ++n) {
            hooks().failCall(n, result, only);
            const auto done = work();
            if (!hooks().failed()) {
                EXPECT_TRUE(done) << done.error().message;
                EXPECT_GT(n, 1) << "nothing was called that could fail";
                return;
            }
            ASSERT_FALSE(done) << "call " << n << " failed and nobody noticed";
            EXPECT_EQ(done.error().code, expected) << n << ": " << done.error().message;
            EXPECT_GT(done.error().message.size(), 20u);
            ASSERT_EQ(hooks().liveObjects(), before) << "after call " << n << ": " << hooks().liveText();
        }
        FAIL() << "more than 500 calls";
    }

    LogBook log;
    const SmallWorld world;
};

// A Result without its value.
template <class T>
Result<void> only(const Result<T>& result) {
    if (!result) return result.error();
    return {};
}

void expectCpuWorks(const Context& context, const SmallWorld& world) {
    const auto tracer = makeEmbreeTracer(context, world.scene, world.pose);
    ASSERT_TRUE(tracer);
    auto field = Field::create(context, world.desc, world.desc);
    ASSERT_TRUE(field);
    ASSERT_TRUE(field->update(**tracer, world.lighting));
    EXPECT_TRUE(finite(field->irradiance(world.query())));
}

void expectLost(const Error& error) {
    EXPECT_EQ(error.code, ErrorCode::deviceLost) << error.message;
    EXPECT_NE(error.message.find("CPU backend"), std::string::npos) << error.message;
}

void expectTracerLost(const Tracer& tracer, const Ray& ray) {
    Hit hit;
    std::uint8_t blocked = 0;
    Surface surface;
    for (const Result<void>& traced :
         {tracer.closestHits({&ray, 1}, {&hit, 1}), tracer.occluded({&ray, 1}, {&blocked, 1}),
          tracer.surfaces({&ray, 1}, {&hit, 1}, {&surface, 1})}) {
        ASSERT_FALSE(traced);
        expectLost(traced.error());
    }
}

}  // namespace

// CPU passes on rays traced by a GPU end with the GPU's error, not with black light or a black picture.
TEST_F(VulkanFaults, whatTheCpuDoesWithRaysOfALostDeviceFails) {
    const vulkan::Device device = open();
    for (const char* lamps : {"sun", "none"}) {
        SCOPED_TRACE(lamps);
        hooks().failCall(0, VK_SUCCESS);
        const vulkan::Device other = open();
        const auto tracer = vulkan::makeTracer(log, other, world.scene, world.pose);
        ASSERT_TRUE(tracer) << tracer.error().message;
        Lighting lighting = world.lighting;
        if (lamps == std::string_view("sun"))
            lighting.lights.push_back({.direction = {0, -1, 0}, .intensity = {1, 1, 1}});
        auto field = Field::create(log, world.desc, world.desc);
        ASSERT_TRUE(field);
        ASSERT_TRUE(field->update(**tracer, lighting));
        const glm::vec3 before = field->irradiance(world.query());
        const auto pathTracer = PathTracer::create(log, world.scene, world.pose, **tracer, lighting);
        ASSERT_TRUE(pathTracer);

        hooks().failCall(1, VK_ERROR_DEVICE_LOST, "vkQueueSubmit");
        const auto updated = field->update(**tracer, lighting);
        ASSERT_FALSE(updated);
        expectLost(updated.error());
        EXPECT_EQ(field->control().frame(), 1);
        EXPECT_EQ(field->irradiance(world.query()), before);
        const auto converged = field->converge(**tracer, lighting);
        ASSERT_FALSE(converged);
        expectLost(converged.error());
        const auto picture = renderPicture(log, **tracer, lighting, &*field, world.picture());
        ASSERT_FALSE(picture);
        expectLost(picture.error());
        const auto truth = pathTracer->render({.picture = world.picture(), .samplesPerPixel = 1});
        ASSERT_FALSE(truth);
        expectLost(truth.error());
        const auto guided = pathTracer->render({.picture = world.picture(), .samplesPerPixel = 1, .guide = &*field});
        ASSERT_FALSE(guided);
        expectLost(guided.error());
        const FieldQuery query = world.query();
        const auto irradiance = pathTracer->irradiance({&query, 1}, 16);
        ASSERT_FALSE(irradiance);
        expectLost(irradiance.error());
    }
}

TEST_F(VulkanFaults, aLostDeviceStaysLostAndNothingCrashes) {
    for (const char* function : {"vkQueueSubmit", "vkWaitForFences"}) {
        SCOPED_TRACE(function);
        hooks().reset();
        const vulkan::Device device = open();
        for (const vulkan::TracerKind kind : tracerKinds(device)) {
            hooks().failCall(0, VK_SUCCESS);
            const vulkan::Device other = open();
            const auto tracer = vulkan::makeTracer(log, other, world.scene, world.pose, {.tracer = kind});
            ASSERT_TRUE(tracer) << tracer.error().message;
            auto field = vulkan::makeField(log, other, world.desc, world.desc);
            ASSERT_TRUE(field);
            ASSERT_TRUE(field->update(**tracer, world.lighting));
            EXPECT_TRUE(finite(field->irradiance(world.query())));
            const FieldSnapshot before = field->read().value();

            hooks().failCall(1, VK_ERROR_DEVICE_LOST, function);
            const auto updated = field->update(**tracer, world.lighting);
            ASSERT_FALSE(updated);
            expectLost(updated.error());
            ASSERT_TRUE(hooks().failed());

            // The driver works again, but the device is lost, and nothing more may be submitted to it.
            const int submits = hooks().submits;
            const std::vector<RayDatum> rays(18 * 16);
            const auto fed = field->update(rays);
            ASSERT_FALSE(fed);
            expectLost(fed.error());
            const glm::vec3 one = field->irradiance(world.query());
            EXPECT_TRUE(std::isnan(one.x) && std::isnan(one.y) && std::isnan(one.z));
            const FieldQuery query = world.query();
            glm::vec3 answer;
            const auto batch = field->irradiance({&query, 1}, {&answer, 1});
            ASSERT_FALSE(batch);
            expectLost(batch.error());
            const auto probes = field->read();
            ASSERT_FALSE(probes);
            expectLost(probes.error());
            const auto written = field->write(before);
            ASSERT_FALSE(written);
            expectLost(written.error());
            EXPECT_EQ(field->fallbackQueries(), 0u);
            const Ray ray{world.pose.bounds.centre(), 0.0f, {0, -1, 0}, 1e30f};
            expectTracerLost(**tracer, ray);
            const auto picture = vulkan::renderPicture(log, other, **tracer, world.lighting, &*field, world.picture());
            ASSERT_FALSE(picture);
            expectLost(picture.error());
            const auto another = vulkan::makeField(log, other, world.desc, world.desc);
            ASSERT_FALSE(another);
            expectLost(another.error());
            EXPECT_EQ(hooks().submits, submits);
            expectCpuWorks(log, world);
        }
        // Another device of the process is not affected.
        EXPECT_TRUE(vulkan::makeField(log, device, world.desc, world.desc));
    }
}

TEST_F(VulkanFaults, aWaitThatFailsForLackOfMemoryIsALostDevice) {
    const vulkan::Device device = open();
    hooks().failCall(1, VK_ERROR_OUT_OF_HOST_MEMORY, "vkWaitForFences");
    const auto field = vulkan::makeField(log, device, world.desc, world.desc);
    ASSERT_FALSE(field);
    expectLost(field.error());
}

TEST_F(VulkanFaults, aSubmitWithoutMemoryFailsAndTheNextWorks) {
    const vulkan::Device device = open();
    hooks().failCall(1, VK_ERROR_OUT_OF_DEVICE_MEMORY, "vkQueueSubmit");
    const auto refused = vulkan::makeField(log, device, world.desc, world.desc);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::outOfMemory);
    auto field = vulkan::makeField(log, device, world.desc, world.desc);
    ASSERT_TRUE(field) << field.error().message;
    EXPECT_TRUE(finite(field->irradiance(world.query())));
}

TEST_F(VulkanFaults, makingATracerSurvivesEveryRefusedAllocation) {
    const vulkan::Device device = open();
    for (const vulkan::TracerKind kind : tracerKinds(device)) {
        const auto work = [&] {
            return only(vulkan::makeTracer(log, device, world.scene, world.pose, {.tracer = kind}));
        };
        failEachCall(VK_ERROR_OUT_OF_DEVICE_MEMORY, "", ErrorCode::outOfMemory, work);
        failEachCall(VK_ERROR_TOO_MANY_OBJECTS, "vkAllocateMemory", ErrorCode::outOfMemory, work);
        failEachCall(VK_ERROR_MEMORY_MAP_FAILED, "vkMapMemory", ErrorCode::outOfMemory, work);
        failEachCall(VK_ERROR_OUT_OF_HOST_MEMORY, "vkCreateDescriptorPool", ErrorCode::outOfMemory, work);
    }
}

TEST_F(VulkanFaults, aFieldSurvivesEveryRefusedAllocation) {
    const vulkan::Device device = open();
    const auto tracer = vulkan::makeTracer(log, device, world.scene, world.pose);
    ASSERT_TRUE(tracer);
    // Compiles all pipelines first, so that objects can be counted.
    ASSERT_TRUE(vulkan::makeField(log, device, world.desc, world.desc)->update(**tracer, world.lighting));
    const auto work = [&]() -> Result<void> {
        auto field = vulkan::makeField(log, device, world.desc, world.desc);
        if (!field) return field.error();
        if (auto ok = field->update(**tracer, world.lighting); !ok) return only(ok);
        const FieldQuery query = world.query();
        glm::vec3 answer;
        return field->irradiance({&query, 1}, {&answer, 1});
    };
    ASSERT_TRUE(work());
    failEachCall(VK_ERROR_OUT_OF_DEVICE_MEMORY, "", ErrorCode::outOfMemory, work);
    failEachCall(VK_ERROR_OUT_OF_DEVICE_MEMORY, "vkCreateImageView", ErrorCode::outOfMemory, work);
    failEachCall(VK_ERROR_OUT_OF_HOST_MEMORY, "vkCreateQueryPool", ErrorCode::outOfMemory, work);
}

TEST_F(VulkanFaults, aFieldThatRanOutOfMemoryWorksOnceThereIsSome) {
    const vulkan::Device device = open();
    const auto tracer = vulkan::makeTracer(log, device, world.scene, world.pose);
    ASSERT_TRUE(tracer);
    auto reference = vulkan::makeField(log, device, world.desc, world.desc);
    ASSERT_TRUE(reference->update(**tracer, world.lighting));
    for (int n = 1; n < 20; ++n) {
        auto field = vulkan::makeField(log, device, world.desc, world.desc);
        ASSERT_TRUE(field);
        hooks().failCall(n, VK_ERROR_OUT_OF_DEVICE_MEMORY);
        if (!field->update(**tracer, world.lighting)) {
            EXPECT_EQ(field->control().frame(), 0);
            hooks().failCall(0, VK_SUCCESS);
            ASSERT_TRUE(field->update(**tracer, world.lighting));
        }
        hooks().failCall(0, VK_SUCCESS);
        EXPECT_GT(reference->irradiance(world.query()).x, 0.0f);
        EXPECT_EQ(field->irradiance(world.query()), reference->irradiance(world.query()));
    }
}

TEST_F(VulkanFaults, aPictureSurvivesEveryRefusedAllocation) {
    const vulkan::Device device = open();
    const auto tracer = vulkan::makeTracer(log, device, world.scene, world.pose);
    auto field = vulkan::makeField(log, device, world.desc, world.desc);
    ASSERT_TRUE(tracer && field);
    const auto work = [&] {
        return only(vulkan::renderPicture(log, device, **tracer, world.lighting, &*field, world.picture()));
    };
    ASSERT_TRUE(work());
    failEachCall(VK_ERROR_OUT_OF_DEVICE_MEMORY, "", ErrorCode::outOfMemory, work);
    HdrImage image;
    image.width = image.height = 2;
    image.pixels.resize(4);
    failEachCall(VK_ERROR_OUT_OF_DEVICE_MEMORY, "vkAllocateMemory", ErrorCode::outOfMemory,
                 [&] { return only(vulkan::toneMapImage(device, image, {})); });
}

TEST_F(VulkanFaults, openingSurvivesEveryRefusedObject) {
    failEachCall(VK_ERROR_OUT_OF_HOST_MEMORY, "vkCreate", ErrorCode::outOfMemory, [&] {
        vulkan::OpenDesc desc;
        desc.getInstanceProcAddr = hookedLoader;
        return only(vulkan::Device::open(log, desc));
    });
}

TEST_F(VulkanFaults, pipelinesThatDoNotCompileAreErrorsAndAreTriedAgain) {
    const vulkan::Device device = open();
    const auto tracer = vulkan::makeTracer(log, device, world.scene, world.pose);
    ASSERT_TRUE(tracer);
    // Each attempt compiles one more pipeline than the one before.
    int refusals = 0;
    for (; refusals < 20; ++refusals) {
        auto field = vulkan::makeField(log, device, world.desc, world.desc);
        ASSERT_TRUE(field);
        hooks().failCall(refusals % 2 + 1, VK_ERROR_UNKNOWN, "vkCreateComputePipelines");
        const auto done = field->update(**tracer, world.lighting);
        if (!hooks().failed()) {
            EXPECT_TRUE(done);
            break;
        }
        ASSERT_FALSE(done);
        EXPECT_EQ(done.error().code, ErrorCode::unsupported);
        EXPECT_NE(done.error().message.find("driver failed"), std::string::npos) << done.error().message;
    }
    EXPECT_GE(refusals, 3);
    hooks().failCall(1, VK_ERROR_OUT_OF_DEVICE_MEMORY, "vkCreateComputePipelines");
    auto field = vulkan::makeField(log, device, world.desc, world.desc);
    EXPECT_TRUE(std::isnan(field->irradiance(world.query()).x));
    hooks().failCall(0, VK_SUCCESS);
    EXPECT_TRUE(finite(field->irradiance(world.query())));
}

TEST_F(VulkanFaults, theGuardOfAFailedQueryIsAppliedLater) {
    const vulkan::Device device = open();
    const auto tracer = vulkan::makeTracer(log, device, world.scene, world.pose);
    auto field = vulkan::makeField(log, device, world.desc, world.desc);
    auto other = vulkan::makeField(log, device, world.desc, world.desc);
    ASSERT_TRUE(tracer && field && other);
    ASSERT_TRUE(field->update(**tracer, world.lighting));
    ASSERT_TRUE(other->update(**tracer, world.lighting));
    changeSettings(*field, [&](FieldSettings& s) { s.guard = LeakGuard::none; });
    changeSettings(*other, [&](FieldSettings& s) { s.guard = LeakGuard::none; });
    // The first query compiles its pass.
    hooks().failCall(1, VK_ERROR_OUT_OF_DEVICE_MEMORY, "vkCreateComputePipelines");
    EXPECT_TRUE(std::isnan(field->irradiance(world.query()).x));
    hooks().failCall(1, VK_ERROR_OUT_OF_DEVICE_MEMORY, "vkQueueSubmit");
    EXPECT_TRUE(std::isnan(field->irradiance(world.query()).x));
    hooks().failCall(0, VK_SUCCESS);
    EXPECT_EQ(field->irradiance(world.query()), other->irradiance(world.query()));
    // Nor the settings of a picture that failed.
    for (Field* f : {&*field, &*other}) changeSettings(*f, [&](FieldSettings& s) { s.guard = LeakGuard::moments; });
    PictureDesc picture;
    picture.camera = world.pose.cameras.front();
    picture.width = picture.height = 8;
    hooks().failCall(1, VK_ERROR_OUT_OF_DEVICE_MEMORY, "vkQueueSubmit");
    int refused = 0;
    for (int call = 0; call < 3 && refused == 0; ++call)
        refused += vulkan::renderPicture(log, device, **tracer, world.lighting, &*field, picture) ? 0 : 1;
    EXPECT_EQ(refused, 1);
    hooks().failCall(0, VK_SUCCESS);
    EXPECT_EQ(field->irradiance(world.query()), other->irradiance(world.query()));
}

}  // namespace probegi::test

// Devices adopted from an engine.
#include "vulkan/engine.h"
#include "vulkan/hooks.h"
#include "vulkan/log_book.h"
#include "vulkan/small_world.h"

#include <set>

namespace probegi::test {

namespace {

class VulkanAdopt : public testing::Test {
protected:
    void SetUp() override { hooks().reset(); }
    void TearDown() override { hooks().reset(); }

    void expectRefused(const vulkan::AdoptDesc& desc, ErrorCode code, const std::string& named) const {
        const auto device = vulkan::Device::adopt(log, desc);
        ASSERT_FALSE(device) << named;
        EXPECT_EQ(device.error().code, code);
        EXPECT_NE(device.error().message.find(named), std::string::npos) << device.error().message;
    }

    LogBook log;
    const SmallWorld world;
};

bool hasRayQuery() {
    const auto devices = vulkan::listDevices();
    return devices && !devices->empty() && devices->front().rayQuery;
}

/// An engine's allocator that counts, and fails on request.
struct CountingAllocator {
    explicit CountingAllocator(const Engine& e) : engine(e) {}

    vulkan::Allocator functions() {
        return {[this](const VkMemoryRequirements& needs, vulkan::MemoryUse use, vulkan::Allocation& out) {
                    if (countdown > 0 && --countdown == 0) return VK_ERROR_OUT_OF_DEVICE_MEMORY;
                    return allocate(needs, use, out);
                },
                [this](const vulkan::Allocation& a) {
                    EXPECT_EQ(alive.erase(a.userData), 1u);
                    vkFreeMemory(engine.device, a.memory, nullptr);
                    delete static_cast<int*>(a.userData);
                }};
    }

    VkResult allocate(const VkMemoryRequirements& needs, vulkan::MemoryUse use, vulkan::Allocation& out) {
        const VkMemoryAllocateFlagsInfo flags{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO, nullptr,
                                              VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT, 0};
        // At an offset, like pieces of a pool.
        out.offset = use == vulkan::MemoryUse::device ? needs.alignment : 0;
        VkPhysicalDeviceMemoryProperties properties;
        vkGetPhysicalDeviceMemoryProperties(engine.physical, &properties);
        const VkMemoryPropertyFlags wanted =
            use == vulkan::MemoryUse::device
                ? VkMemoryPropertyFlags(VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT)
                : VkMemoryPropertyFlags(VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
        for (std::uint32_t i = 0; i < properties.memoryTypeCount; ++i) {
            if (!(needs.memoryTypeBits >> i & 1u) || (properties.memoryTypes[i].propertyFlags & wanted) != wanted)
                continue;
            const VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, &flags, needs.size + out.offset, i};
            if (const VkResult result = vkAllocateMemory(engine.device, &info, nullptr, &out.memory)) return result;
            if (use != vulkan::MemoryUse::device && !unmapped)
                vkMapMemory(engine.device, out.memory, 0, VK_WHOLE_SIZE, 0, &out.mapped);
            out.userData = new int(0);
            alive.insert(out.userData);
            ++allocations;
            return VK_SUCCESS;
        }
        return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    }

    const Engine& engine;
    std::set<void*> alive;
    int allocations = 0;
    int countdown = 0;  // the allocation that fails; 0: none
    bool unmapped = false;
};

}  // namespace

TEST_F(VulkanAdopt, aCompleteDeviceIsAdopted) {
    Engine engine;
    const auto device = vulkan::Device::adopt(log, engine.adoptDesc());
    ASSERT_TRUE(device) << device.error().message;
    EXPECT_TRUE(device->info().usable());
    EXPECT_FALSE(device->rayQuery());
    EXPECT_EQ(device->validationMessages(), 0);
}

TEST_F(VulkanAdopt, rayQueryIsSeenWhereItIsEnabled) {
    if (!hasRayQuery()) {
        // The device lacks it; requesting it is refused (device_test.cpp).
        EXPECT_FALSE(vulkan::Device::open(log)->rayQuery());
        return;
    }
    Engine engine({.rayQuery = true});
    const auto device = vulkan::Device::adopt(log, engine.adoptDesc());
    ASSERT_TRUE(device) << device.error().message;
    EXPECT_TRUE(device->rayQuery());
    const auto scene =
        vulkan::GpuScene::create(log, *device, world.scene, world.pose, {.tracer = vulkan::TracerKind::rayQuery});
    ASSERT_TRUE(scene);
    EXPECT_EQ(scene->tracer(), vulkan::TracerKind::rayQuery);
    // By default, the library uses ray query if it is in hardware.
    const auto chosen = vulkan::GpuScene::create(log, *device, world.scene, world.pose);
    ASSERT_TRUE(chosen);
    const bool software = device->info().type == "software";
    EXPECT_EQ(chosen->tracer(), software ? vulkan::TracerKind::bvh : vulkan::TracerKind::rayQuery);
}

TEST_F(VulkanAdopt, eachMissingFeatureIsNamed) {
    const auto lacks = [&](const EngineDesc& desc, const char* feature) {
        Engine engine(desc);
        expectRefused(engine.adoptDesc(), ErrorCode::unsupported, feature);
    };
    lacks({.synchronization2 = false}, "synchronization2");
    lacks({.bufferDeviceAddress = false}, "bufferDeviceAddress");
    lacks({.scalarBlockLayout = false}, "scalarBlockLayout");
    lacks({.storageImageExtendedFormats = false}, "shaderStorageImageExtendedFormats");
}

TEST_F(VulkanAdopt, missingMembersAreNamed) {
    Engine engine;
    const auto without = [&](const char* member, const std::function<void(vulkan::AdoptDesc&)>& change) {
        vulkan::AdoptDesc desc = engine.adoptDesc();
        change(desc);
        expectRefused(desc, ErrorCode::invalidArgument, member);
    };
    without("AdoptDesc::instance", [](auto& d) { d.instance = VK_NULL_HANDLE; });
    without("AdoptDesc::physicalDevice", [](auto& d) { d.physicalDevice = VK_NULL_HANDLE; });
    without("AdoptDesc::device", [](auto& d) { d.device = VK_NULL_HANDLE; });
    without("AdoptDesc::createInfo", [](auto& d) { d.createInfo = nullptr; });
    without("queue family 77", [](auto& d) { d.queueFamily = 77; });
    without("allocator", [](auto& d) { d.allocator.free = [](const vulkan::Allocation&) {}; });
    without("allocator", [](auto& d) {
        d.allocator.allocate = [](const auto&, auto, auto&) { return VK_ERROR_OUT_OF_DEVICE_MEMORY; };
    });
}

// A field that is updated on one queue and read on another: the driver has one family only, so it is told of two and
// does not see the sharing.
TEST_F(VulkanAdopt, readingFamiliesShareBuffersAndImages) {
    Engine engine;
    vulkan::AdoptDesc desc = engine.adoptDesc();
    desc.getInstanceProcAddr = hookedLoader;
    std::uint32_t familyCount = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(engine.physical, &familyCount, nullptr);
    const auto sharing = [&](std::vector<std::uint32_t> reading) {
        hooks().reset();
        hooks().moreFamilies = 2;
        std::set<std::vector<std::uint32_t>> seen;
        const auto look = [&](auto& info) {
            const bool concurrent = info.sharingMode == VK_SHARING_MODE_CONCURRENT;
            seen.insert(concurrent ? std::vector<std::uint32_t>(info.pQueueFamilyIndices,
                                                                info.pQueueFamilyIndices + info.queueFamilyIndexCount)
                                   : std::vector<std::uint32_t>());
            info.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
            info.queueFamilyIndexCount = 0;
        };
        hooks().buffers = look;
        hooks().images = look;
        desc.readingFamilies = reading;
        const vulkan::Device device = vulkan::Device::adopt(log, desc).value();
        vulkan::GpuField::create(device, world.desc).value();
        return seen;
    };
    using Families = std::set<std::vector<std::uint32_t>>;
    const std::uint32_t own = desc.queueFamily;
    EXPECT_EQ(sharing({}), Families{{}});
    EXPECT_EQ(sharing({own}), Families{{}});
    EXPECT_EQ(sharing({familyCount, own, familyCount}), (Families{{own, familyCount}}));
    EXPECT_EQ(sharing({familyCount + 1, familyCount}), (Families{{own, familyCount + 1, familyCount}}));
    const std::uint32_t none[] = {familyCount};
    desc.readingFamilies = none;
    hooks().reset();
    expectRefused(desc, ErrorCode::invalidArgument, "readingFamilies");
}

TEST_F(VulkanAdopt, whatTheDriverLacksIsNamed) {
    Engine engine;
    vulkan::AdoptDesc desc = engine.adoptDesc();
    desc.getInstanceProcAddr = hookedLoader;
    hooks().properties = [](VkPhysicalDeviceProperties& p) { p.apiVersion = VK_MAKE_API_VERSION(0, 1, 2, 190); };
    expectRefused(desc, ErrorCode::unsupported, "1.2.190");
    hooks().reset();
    hooks().formats = [](VkFormat f, VkFormatProperties& p) {
        if (f == VK_FORMAT_R16G16_UNORM) p = {};
    };
    expectRefused(desc, ErrorCode::unsupported, "R16G16Unorm");
    hooks().reset();
    hooks().hidden = "vkCmdPipelineBarrier2";
    expectRefused(desc, ErrorCode::unsupported, "apiVersion 1.3");
    hooks().reset();
    desc.getInstanceProcAddr = [](VkInstance, const char*) -> PFN_vkVoidFunction { return nullptr; };
    expectRefused(desc, ErrorCode::unsupported, "getInstanceProcAddr");
}

TEST_F(VulkanAdopt, aFamilyWithoutComputeIsRefused) {
    Engine engine;
    vulkan::AdoptDesc desc = engine.adoptDesc();
    desc.getInstanceProcAddr = hookedLoader;
    // The device supports compute, but in another queue family.
    int asked = 0;
    hooks().families = [&](VkQueueFamilyProperties& f) {
        if (++asked > 1) f.queueFlags &= ~VkQueueFlags(VK_QUEUE_COMPUTE_BIT);
    };
    expectRefused(desc, ErrorCode::invalidArgument, "compute");
}

TEST_F(VulkanAdopt, worksWithoutDebugUtils) {
    Engine engine({.debugUtils = false});
    const auto device = vulkan::Device::adopt(log, engine.adoptDesc());
    ASSERT_TRUE(device);
    auto volume = vulkan::GpuField::create(*device, world.desc);
    ASSERT_TRUE(volume);
    const EngineBuffer rays = engine.makeBuffer(18 * 16 * 16);
    engine.run([&](VkCommandBuffer commands) {
        volume->recordClear(commands).value();
        EXPECT_TRUE(volume->recordUpdate(commands, rays.range()));
    });
    EXPECT_EQ(volume->control().frame(), 1);
}

TEST_F(VulkanAdopt, debugUtilsClaimedButMissingDoNotCrash) {
    Engine engine({.debugUtils = false});
    vulkan::AdoptDesc desc = engine.adoptDesc();
    const char* const claimed[] = {VK_EXT_DEBUG_UTILS_EXTENSION_NAME};
    desc.instanceExtensions = claimed;
    desc.getInstanceProcAddr = hookedLoader;
    hooks().hidden = "DebugUtils";
    const auto device = vulkan::Device::adopt(log, desc);
    ASSERT_TRUE(device);
    EXPECT_TRUE(vulkan::GpuField::create(*device, world.desc));
}

TEST_F(VulkanAdopt, callsThatSubmitAreRefusedWithAMessage) {
    Engine engine;
    const auto device = vulkan::Device::adopt(log, engine.adoptDesc());
    ASSERT_TRUE(device);
    const auto refused = [](const auto& result) {
        ASSERT_FALSE(result);
        EXPECT_EQ(result.error().code, ErrorCode::unsupported);
        EXPECT_NE(result.error().message.find("engine's device"), std::string::npos) << result.error().message;
    };
    refused(vulkan::makeTracer(log, *device, world.scene, world.pose));
    refused(vulkan::makeField(log, *device, world.desc, world.desc));
    HdrImage image(2, 2);
    refused(vulkan::toneMapImage(*device, image, {}));
    const auto own = vulkan::Device::open(log);
    const auto tracer = vulkan::makeTracer(log, *own, world.scene, world.pose);
    const auto picture = vulkan::renderPicture(log, *device, **tracer, world.lighting, nullptr, world.picture());
    ASSERT_FALSE(picture);
    EXPECT_EQ(picture.error().code, ErrorCode::invalidArgument);
}

TEST_F(VulkanAdopt, allMemoryGoesThroughTheEnginesAllocator) {
    Engine engine;
    CountingAllocator allocator(engine);
    vulkan::AdoptDesc desc = engine.adoptDesc();
    desc.allocator = allocator.functions();
    desc.getInstanceProcAddr = hookedLoader;
    {
        const auto device = vulkan::Device::adopt(log, desc);
        ASSERT_TRUE(device);
        auto scene = vulkan::GpuScene::create(log, *device, world.scene, world.pose);
        auto lighting = vulkan::GpuLighting::create(*device, world.lighting);
        auto volume = vulkan::GpuField::create(*device, world.desc);
        ASSERT_TRUE(scene && lighting && volume);
        engine.run([&](VkCommandBuffer commands) {
            scene->recordUpload(commands).value();
            lighting->recordUpload(commands).value();
            volume->recordClear(commands).value();
            EXPECT_TRUE(volume->recordUpdate(commands, *scene, *lighting));
        });
        const std::size_t withStaging = allocator.alive.size();
        scene->releaseStaging();
        lighting->releaseStaging();
        EXPECT_LT(allocator.alive.size(), withStaging);
        EXPECT_TRUE(hooks().allocations.empty()) << "the library allocated by itself";
        EXPECT_GT(allocator.allocations, 20);
    }
    EXPECT_TRUE(allocator.alive.empty());
    EXPECT_EQ(hooks().liveObjects(), 0) << hooks().liveText();
}

TEST_F(VulkanAdopt, anAllocatorThatFailsIsAResultAndLeaksNothing) {
    Engine engine;
    CountingAllocator allocator(engine);
    vulkan::AdoptDesc desc = engine.adoptDesc();
    desc.allocator = allocator.functions();
    const auto device = vulkan::Device::adopt(log, desc);
    ASSERT_TRUE(device);
    const auto work = [&]() -> Result<void> {
        auto scene = vulkan::GpuScene::create(log, *device, world.scene, world.pose);
        if (!scene) return scene.error();
        auto lighting = vulkan::GpuLighting::create(*device, world.lighting);
        if (!lighting) return lighting.error();
        auto volume = vulkan::GpuField::create(*device, world.desc);
        if (!volume) return volume.error();
        Result<void> updated;
        engine.run([&](VkCommandBuffer commands) {
            scene->recordUpload(commands).value();
            lighting->recordUpload(commands).value();
            volume->recordClear(commands).value();
            updated = volume->recordUpdate(commands, *scene, *lighting);
        });
        return updated;
    };
    int n = 0;
    for (bool failed = true; failed;) {
        allocator.countdown = ++n;
        const auto done = work();
        failed = allocator.countdown == 0;
        EXPECT_EQ(failed, !done) << n;
        if (!done) {
            EXPECT_EQ(done.error().code, ErrorCode::outOfMemory) << done.error().message;
        }
        EXPECT_TRUE(allocator.alive.empty()) << n;
    }
    EXPECT_GT(n, 20);
    allocator.countdown = 0;
    allocator.unmapped = true;
    const auto unmapped = work();
    ASSERT_FALSE(unmapped);
    EXPECT_NE(unmapped.error().message.find("mapped"), std::string::npos) << unmapped.error().message;
    EXPECT_TRUE(allocator.alive.empty());
}

}  // namespace probegi::test

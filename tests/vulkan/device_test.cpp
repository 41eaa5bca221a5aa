// Listing, opening and refusing devices.
#include "vulkan/hooks.h"
#include "vulkan/log_book.h"
#include "vulkan/small_world.h"

#include <cstdlib>
#include <cstring>

namespace probegi::test {

namespace {

class VulkanDevice : public testing::Test {
protected:
    void SetUp() override { hooks().reset(); }
    void TearDown() override { hooks().reset(); }

    Result<vulkan::Device> open(const std::string& name) const {
        vulkan::OpenDesc desc;
        desc.device = name;
        desc.getInstanceProcAddr = hookedLoader;
        return vulkan::Device::open(log, desc);
    }

    void expectRefused(const Result<vulkan::Device>& device, const std::string& named) const {
        ASSERT_FALSE(device);
        EXPECT_EQ(device.error().code, ErrorCode::unsupported);
        EXPECT_NE(device.error().message.find(named), std::string::npos) << device.error().message;
    }

    LogBook log;
};

template <class T>
void hide(VkPhysicalDeviceFeatures2& features, VkStructureType type, VkBool32 T::*member) {
    for (auto* link = static_cast<VkBaseOutStructure*>(features.pNext); link; link = link->pNext)
        if (link->sType == type) reinterpret_cast<T*>(link)->*member = VK_FALSE;
}

}  // namespace

TEST_F(VulkanDevice, allDevicesAreDescribed) {
    const auto devices = vulkan::listDevices();
    ASSERT_TRUE(devices) << devices.error().message;
    ASSERT_FALSE(devices->empty());
    for (std::size_t i = 0; i < devices->size(); ++i) {
        const vulkan::DeviceInfo& info = (*devices)[i];
        EXPECT_EQ(info.index, int(i));
        EXPECT_FALSE(info.name.empty());
        EXPECT_FALSE(info.driver.empty());
        EXPECT_TRUE(info.api.starts_with("1.")) << info.api;
        EXPECT_EQ(info.usable(), info.missing.empty());
    }
}

TEST_F(VulkanDevice, opensByIndexAndByPartOfTheName) {
    const auto devices = *vulkan::listDevices();
    for (const vulkan::DeviceInfo& info : devices) {
        const auto byIndex = open(std::to_string(info.index));
        ASSERT_TRUE(byIndex) << byIndex.error().message;
        EXPECT_EQ(byIndex->info().name, info.name);
        std::string part = info.name.substr(1, 4);
        for (char& c : part) c = char(std::toupper(static_cast<unsigned char>(c)));
        const auto byName = open(part);
        ASSERT_TRUE(byName) << byName.error().message;
    }
    EXPECT_TRUE(open(""));
}

TEST_F(VulkanDevice, aNumberThatIsNotAnIndexMayBePartOfAName) {
    hooks().properties = [](VkPhysicalDeviceProperties& p) { std::strcpy(p.deviceName, "Imaginary RTX 3090"); };
    const auto device = open("3090");
    ASSERT_TRUE(device) << device.error().message;
    EXPECT_EQ(device->info().name, "Imaginary RTX 3090");
}

// With several drivers (registered as both.vulkan): each in turn claims to be the GPU, whatever its index.
TEST_F(VulkanDevice, aGpuIsChosenBeforeSoftware) {
    const auto devices = *vulkan::listDevices();
    for (const vulkan::DeviceInfo& gpu : devices) {
        hooks().properties = [&](VkPhysicalDeviceProperties& p) {
            p.deviceType = gpu.api.ends_with("." + std::to_string(VK_API_VERSION_PATCH(p.apiVersion)))
                               ? VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU
                               : VK_PHYSICAL_DEVICE_TYPE_CPU;
        };
        const auto device = open("");
        ASSERT_TRUE(device) << device.error().message;
        EXPECT_EQ(device->info().api, gpu.api);
        EXPECT_EQ(device->info().name, gpu.name);
    }
}

TEST_F(VulkanDevice, anUnknownNameListsTheKnownOnes) {
    const auto devices = *vulkan::listDevices();
    for (const char* name : {"no such GPU", "99", "-1", "0x"}) {
        const auto device = open(name);
        expectRefused(device, name);
        for (const vulkan::DeviceInfo& info : devices)
            EXPECT_NE(device.error().message.find(info.name), std::string::npos) << device.error().message;
    }
}

TEST_F(VulkanDevice, aLoaderWithoutFunctionsIsRefused) {
    vulkan::OpenDesc desc;
    desc.getInstanceProcAddr = [](VkInstance, const char*) -> PFN_vkVoidFunction { return nullptr; };
    for (const bool validation : {false, true}) {
        desc.validation = validation;
        expectRefused(vulkan::Device::open(log, desc), "no Vulkan loader");
    }
}

TEST_F(VulkanDevice, withoutADriverThereIsAMessage) {
    const char* const old = std::getenv("VK_DRIVER_FILES");
    const std::string before = old ? old : "";
    ::setenv("VK_DRIVER_FILES", "/nonexistent/driver.json", 1);
    const auto device = open("");
    const auto listed = vulkan::listDevices();
    if (old)
        ::setenv("VK_DRIVER_FILES", before.c_str(), 1);
    else
        ::unsetenv("VK_DRIVER_FILES");
    expectRefused(device, "driver");
    if (listed) {
        EXPECT_TRUE(listed->empty());
    } else {
        EXPECT_EQ(listed.error().code, ErrorCode::unsupported);
    }
    EXPECT_TRUE(open(""));
}

TEST_F(VulkanDevice, anOlderVersionIsNamed) {
    hooks().properties = [](VkPhysicalDeviceProperties& p) { p.apiVersion = VK_MAKE_API_VERSION(0, 1, 2, 190); };
    for (const char* name : {"", "0"}) {
        const auto device = open(name);
        expectRefused(device, "Vulkan 1.3");
        expectRefused(device, "1.2.190");
    }
    hooks().properties = [](VkPhysicalDeviceProperties& p) { p.apiVersion = VK_MAKE_API_VERSION(0, 1, 0, 3); };
    expectRefused(open(""), "1.0.3");
}

TEST_F(VulkanDevice, withheldFormatsAreNamed) {
    const std::pair<VkFormat, const char*> formats[] = {{VK_FORMAT_R16G16B16A16_SFLOAT, "R16G16B16A16Sfloat"},
                                                        {VK_FORMAT_R16G16_UNORM, "R16G16Unorm"}};
    for (const auto& [withheld, name] : formats)
        for (const VkFormatFeatureFlags feature :
             {VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT, VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT,
              VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT}) {
            hooks().formats = [withheld = withheld, feature](VkFormat format, VkFormatProperties& p) {
                if (format == withheld) p.optimalTilingFeatures &= ~feature;
            };
            expectRefused(open(""), name);
        }
}

TEST_F(VulkanDevice, withheldFeaturesAreNamed) {
    using F12 = VkPhysicalDeviceVulkan12Features;
    using F13 = VkPhysicalDeviceVulkan13Features;
    const auto without = [&](const char* name, std::function<void(VkPhysicalDeviceFeatures2&)> features) {
        hooks().features = std::move(features);
        expectRefused(open(""), name);
    };
    without("synchronization2", [](VkPhysicalDeviceFeatures2& f) {
        hide(f, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES, &F13::synchronization2);
    });
    without("bufferDeviceAddress", [](VkPhysicalDeviceFeatures2& f) {
        hide(f, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES, &F12::bufferDeviceAddress);
    });
    without("scalarBlockLayout", [](VkPhysicalDeviceFeatures2& f) {
        hide(f, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES, &F12::scalarBlockLayout);
    });
    without("shaderStorageImageExtendedFormats",
            [](VkPhysicalDeviceFeatures2& f) { f.features.shaderStorageImageExtendedFormats = VK_FALSE; });
}

TEST_F(VulkanDevice, withoutComputeThereIsNoDevice) {
    hooks().families = [](VkQueueFamilyProperties& f) { f.queueFlags &= ~VkQueueFlags(VK_QUEUE_COMPUTE_BIT); };
    expectRefused(open(""), "compute");
}

TEST_F(VulkanDevice, missingDebugFunctionsAreNotCalled) {
    hooks().hidden = "DebugUtils";
    const auto device = open("");
    ASSERT_TRUE(device) << device.error().message;
    const SmallWorld world;
    EXPECT_TRUE(vulkan::makeField(log, *device, world.desc, world.desc));
}

TEST_F(VulkanDevice, rayQueryIsOnlyEnabledIfRequested) {
    vulkan::OpenDesc desc;
    desc.rayQuery = false;
    const auto device = vulkan::Device::open(log, desc);
    ASSERT_TRUE(device);
    EXPECT_FALSE(device->rayQuery());
    const SmallWorld world;
    const auto refused =
        vulkan::makeTracer(log, *device, world.scene, world.pose, {.tracer = vulkan::TracerKind::rayQuery});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::unsupported);
    EXPECT_NE(refused.error().message.find("ray query"), std::string::npos);
    EXPECT_TRUE(vulkan::makeTracer(log, *device, world.scene, world.pose));
}

TEST_F(VulkanDevice, aFamilyWithoutTimestampsHasNoTimesAndNoError) {
    hooks().families = [](VkQueueFamilyProperties& f) { f.timestampValidBits = 0; };
    const auto device = open("");
    ASSERT_TRUE(device);
    const SmallWorld world;
    auto field = vulkan::makeField(log, *device, world.desc, world.desc);
    ASSERT_TRUE(field);
    const std::vector<RayDatum> rays(18 * 16);
    ASSERT_TRUE(field->update(rays));
    EXPECT_TRUE(vulkan::lastPassTimes(*field).empty());
}

TEST_F(VulkanDevice, whatIsMadeOnADeviceKeepsItAlive) {
    const SmallWorld world;
    std::optional<vulkan::Device> device = *open("");
    auto tracer = *vulkan::makeTracer(log, *device, world.scene, world.pose);
    auto field = *vulkan::makeField(log, *device, world.desc, world.desc);
    auto profiler = *vulkan::Profiler::create(*device);
    device.reset();
    EXPECT_TRUE(field.update(*tracer, world.lighting));
    tracer.reset();
    EXPECT_TRUE(finite(field.irradiance(world.query())));
    { const Field last = std::move(field); }
    EXPECT_GT(hooks().live["QueryPool"], 0);
    { const vulkan::Profiler last = std::move(profiler); }
    EXPECT_EQ(hooks().liveObjects(), 0) << hooks().liveText();
}

}  // namespace probegi::test

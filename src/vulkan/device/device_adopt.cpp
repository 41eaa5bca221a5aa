#include <algorithm>
#include <string_view>
#include <vector>

#include "core/sentence.h"
#include "vulkan/device/device_impl.h"
#include "vulkan/device/errors.h"
#include "vulkan/device/loader.h"

namespace probegi::vulkan {

namespace {

Result<void> checkHandles(const AdoptDesc& desc) {
    const char* absent = !desc.instance         ? "instance"
                         : !desc.physicalDevice ? "physicalDevice"
                         : !desc.device         ? "device"
                         : !desc.createInfo     ? "createInfo"
                                                : nullptr;
    if (bool(desc.allocator.allocate) != bool(desc.allocator.free))
        return fail(ErrorCode::invalidArgument,
                    "AdoptDesc::allocator has only one of its two functions; set allocate and free, or neither");
    if (!absent) return {};
    return fail(ErrorCode::invalidArgument, sentence("AdoptDesc::", absent, " is null; set it to the engine's"));
}

bool contains(std::span<const char* const> names, std::string_view wanted) {
    for (const char* name : names)
        if (wanted == name) return true;
    return false;
}

void require(const std::string& missing) {
    if (!missing.empty())
        throw Failure(ErrorCode::unsupported,
                      sentence("the engine's device lacks ", missing, "; enable it or use the CPU backend"));
}

// The queue families that share buffers and images, each once; none where there is only one.
std::vector<std::uint32_t> sharingFamilies(const AdoptDesc& desc, std::size_t families) {
    std::vector<std::uint32_t> sharing{desc.queueFamily};
    for (const std::uint32_t family : desc.readingFamilies) {
        if (family >= families)
            throw Failure(ErrorCode::invalidArgument, sentence("AdoptDesc::readingFamilies has ", family,
                                                               "; the device has ", families, " queue families"));
        if (std::find(sharing.begin(), sharing.end(), family) == sharing.end()) sharing.push_back(family);
    }
    if (sharing.size() == 1) sharing.clear();
    return sharing;
}

}  // namespace

Result<Device> Device::adopt(const Context& context, const AdoptDesc& desc) {
    if (auto ok = checkHandles(desc); !ok) return ok.error();
    return guarded("adopting a device", [&] {
        const PFN_vkGetInstanceProcAddr loader = desc.getInstanceProcAddr ? desc.getInstanceProcAddr : systemLoader();
        if (!loader || !loader(desc.instance, "vkGetDeviceProcAddr"))
            throw Failure(ErrorCode::unsupported,
                          "no Vulkan loader knows this instance; set AdoptDesc::getInstanceProcAddr");
        auto impl = std::make_shared<Impl>(context, loader);
        impl->instance = vk::raii::Instance(impl->vulkan, desc.instance);
        impl->physical = vk::raii::PhysicalDevice(impl->instance, desc.physicalDevice);
        const Features features = enabledFeatures(*desc.createInfo);
        require(missingBesidesFeatures(impl->physical));
        require(features.missing());
        const auto families = impl->physical.getQueueFamilyProperties();
        if (desc.queueFamily >= families.size() ||
            !(families[desc.queueFamily].queueFlags & vk::QueueFlagBits::eCompute))
            throw Failure(ErrorCode::invalidArgument,
                          sentence("queue family ", desc.queueFamily, " has no compute; choose one that has"));
        impl->device = vk::raii::Device(impl->physical, desc.device);
        impl->family = desc.queueFamily;
        impl->sharing = sharingFamilies(desc, families.size());
        impl->debugUtilsEnabled = contains(desc.instanceExtensions, VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
        impl->allocator = desc.allocator;
        impl->info = describe(impl->physical, 0);
        impl->finish(features, desc.cacheFolder);
        return Device(std::move(impl));
    });
}

}  // namespace probegi::vulkan

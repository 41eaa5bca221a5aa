#include <utility>

#include "vulkan/device/device_impl.h"
#include "vulkan/device/errors.h"

namespace probegi::vulkan {

Device::Impl::~Impl() {
    if (pipelines) {
        const auto saved = guarded("saving pipelines", [&] { pipelines->save(); });
        if (!saved) warn(saved.error().message);
        pipelines.reset();
    }
    submitter.reset();
    if (owned) return;
    // Do not destroy an engine's handles.
    if (*device) device.release();
    if (*instance) instance.release();
}

void Device::Impl::finish(const Features& features, const std::filesystem::path& cacheFolder) {
    // Functions of enabled features and extensions may still be missing if the instance is older or the loader
    // incomplete.
    const auto& functions = *device.getDispatcher();
    if (!functions.vkCmdPipelineBarrier2 || !functions.vkCmdWriteTimestamp2 || !functions.vkGetBufferDeviceAddress)
        throw Failure(ErrorCode::unsupported,
                      "the device lacks functions of Vulkan 1.3; create its instance with "
                      "VkApplicationInfo::apiVersion 1.3, or use the CPU backend");
    debugUtilsEnabled &= functions.vkSetDebugUtilsObjectNameEXT && functions.vkCmdBeginDebugUtilsLabelEXT &&
                         functions.vkCmdEndDebugUtilsLabelEXT;
    const auto properties = physical.getProperties();
    limits = properties.limits;
    memoryProperties = physical.getMemoryProperties();
    maxBufferBytes = physical.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceMaintenance4Properties>()
                         .get<vk::PhysicalDeviceMaintenance4Properties>()
                         .maxBufferSize;
    timestampBits = physical.getQueueFamilyProperties()[family].timestampValidBits;
    rayQuery = features.canRayQuery() && functions.vkCreateAccelerationStructureKHR &&
               functions.vkCmdBuildAccelerationStructuresKHR;
    if (rayQuery)
        scratchAlignment =
            physical
                .getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceAccelerationStructurePropertiesKHR>()
                .get<vk::PhysicalDeviceAccelerationStructurePropertiesKHR>()
                .minAccelerationStructureScratchOffsetAlignment;
    std::string warning;
    pipelines.emplace(physical, device, cacheFolder, warning);
    if (!warning.empty()) warn(warning);
}

void Device::Impl::setName(vk::ObjectType type, std::uint64_t handle, const char* name) const {
    if (!debugUtilsEnabled) return;
    // Failing to set a name is not an error.
    const VkDebugUtilsObjectNameInfoEXT named = vk::DebugUtilsObjectNameInfoEXT(type, handle, name);
    device.getDispatcher()->vkSetDebugUtilsObjectNameEXT(*device, &named);
}

const DeviceInfo& Device::info() const noexcept {
    return m_impl->info;
}
bool Device::rayQuery() const noexcept {
    return m_impl->rayQuery;
}
int Device::validationMessages() const noexcept {
    return m_impl->validationMessages.load();
}

Result<void> Device::savePipelines() const {
    return guarded("saving pipelines", [&] { m_impl->pipelines->save(); });
}

}  // namespace probegi::vulkan

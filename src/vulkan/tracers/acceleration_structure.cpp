#include "vulkan/tracers/acceleration_structure.h"

namespace probegi::vulkan {

namespace {

vk::AccelerationStructureBuildGeometryInfoKHR buildInfo(vk::AccelerationStructureTypeKHR type,
                                                        vk::BuildAccelerationStructureFlagsKHR flags,
                                                        const AccelerationStructure::Geometries& geometries) {
    return vk::AccelerationStructureBuildGeometryInfoKHR(type, flags).setGeometries(geometries);
}

}  // namespace

AccelerationStructure::AccelerationStructure(const Device::Impl& device, const char* name,
                                             vk::AccelerationStructureTypeKHR type,
                                             vk::BuildAccelerationStructureFlagsKHR flags, Geometries geometries,
                                             Ranges ranges)
    : m_type(type), m_flags(flags), m_geometries(std::move(geometries)), m_ranges(std::move(ranges)) {
    std::vector<std::uint32_t> counts;
    for (const auto& range : m_ranges) counts.push_back(range.primitiveCount);
    const auto sizes = device.device.getAccelerationStructureBuildSizesKHR(
        vk::AccelerationStructureBuildTypeKHR::eDevice, buildInfo(m_type, m_flags, m_geometries), counts);
    m_storage = Buffer(
        device, name, sizes.accelerationStructureSize,
        vk::BufferUsageFlagBits::eAccelerationStructureStorageKHR | vk::BufferUsageFlagBits::eShaderDeviceAddress);
    const VkDeviceSize alignment = device.scratchAlignment;
    m_scratch = Buffer(device, "build scratch", std::max(sizes.buildScratchSize, sizes.updateScratchSize) + alignment,
                       vk::BufferUsageFlagBits::eStorageBuffer | vk::BufferUsageFlagBits::eShaderDeviceAddress);
    m_scratchAddress = (m_scratch.address() + alignment - 1) / alignment * alignment;
    m_handle = vk::raii::AccelerationStructureKHR(
        device.device,
        vk::AccelerationStructureCreateInfoKHR({}, m_storage.handle(), 0, sizes.accelerationStructureSize, m_type));
    m_address =
        device.device.getAccelerationStructureAddressKHR(vk::AccelerationStructureDeviceAddressInfoKHR(*m_handle));
}

void AccelerationStructure::recordBuild(const Recorder& recorder, bool update) const {
    auto info = buildInfo(m_type, m_flags, m_geometries);
    info.mode = update ? vk::BuildAccelerationStructureModeKHR::eUpdate : vk::BuildAccelerationStructureModeKHR::eBuild;
    if (update) info.srcAccelerationStructure = *m_handle;
    info.dstAccelerationStructure = *m_handle;
    info.scratchData.deviceAddress = m_scratchAddress;
    recorder.commands().buildAccelerationStructuresKHR(info, m_ranges.data(), recorder.dispatcher());
}

}  // namespace probegi::vulkan

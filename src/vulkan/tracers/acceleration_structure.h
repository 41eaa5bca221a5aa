#pragma once

#include "vulkan/device/recorder.h"

namespace probegi::vulkan {

/// One VkAccelerationStructureKHR with its memory and the scratch memory of its build. Throws.
class AccelerationStructure {
public:
    using Geometries = std::vector<vk::AccelerationStructureGeometryKHR>;
    using Ranges = std::vector<vk::AccelerationStructureBuildRangeInfoKHR>;

    AccelerationStructure() = default;
    AccelerationStructure(const Device::Impl& device, const char* name, vk::AccelerationStructureTypeKHR type,
                          vk::BuildAccelerationStructureFlagsKHR flags, Geometries geometries, Ranges ranges);

    void recordBuild(const Recorder& recorder, bool update = false) const;
    /// Call it after the build has finished; updates are impossible afterwards.
    void releaseScratch() noexcept { m_scratch = Buffer(); }

    VkDeviceAddress address() const noexcept { return m_address; }
    std::size_t bytes() const noexcept { return m_storage.bytes() + m_scratch.bytes(); }

private:
    vk::AccelerationStructureTypeKHR m_type{};
    vk::BuildAccelerationStructureFlagsKHR m_flags;
    Geometries m_geometries;
    Ranges m_ranges;
    Buffer m_storage, m_scratch;
    VkDeviceAddress m_scratchAddress = 0;
    vk::raii::AccelerationStructureKHR m_handle{nullptr};
    VkDeviceAddress m_address = 0;
};

}  // namespace probegi::vulkan

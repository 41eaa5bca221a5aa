#pragma once

#include <memory>
#include <span>
#include <string>

#include "room_field.h"
#include "vulkan/field/field_mirror.h"
#include "vulkan/field/gpu_field_impl.h"

namespace probegi::bench {

namespace vk = vulkan::vk;

/// A compute pass of bench/shaders with the library's pass layout.
class BenchPass {
public:
    BenchPass(const vulkan::Device& device, std::span<const std::uint32_t> spirv);

    /// Records it over `count` threads, like Recorder::dispatchOver.
    void record(const vulkan::Recorder& recorder, std::uint64_t count) const;

private:
    vk::raii::Pipeline m_pipeline;
};

/// The room's probes on the first usable Vulkan device. Throws Failure if there is none.
class VulkanRoom {
public:
    explicit VulkanRoom(const RoomField& room, std::span<const RayDatum> rayData);

    const vulkan::Device& device() const noexcept { return m_device; }
    vulkan::FieldPasses& volume() noexcept { return m_volume; }
    VkDeviceAddress rayData() const noexcept { return m_rayData.address(); }
    VkDeviceAddress directions() const noexcept { return m_directions.address(); }

    /// The same update each time, with a hysteresis of a half.
    UpdateFrame frame() const;
    /// Records, runs and waits; returns the milliseconds of each pass by GPU timestamps.
    std::vector<vulkan::PassTime> run(const std::function<void(const vulkan::Recorder&, vulkan::Profiler&)>& passes);
    void clear();
    /// One update by the library.
    std::vector<vulkan::PassTime> update();

private:
    vulkan::Device m_device;
    const RoomField& m_room;
    vulkan::FieldPasses m_volume;
    vulkan::Profiler m_profiler;
    vulkan::Buffer m_rayData, m_directions;
};

double sumOf(const std::vector<vulkan::PassTime>& passes);
double median(std::vector<double> values);

}  // namespace probegi::bench

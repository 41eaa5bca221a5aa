#pragma once

#include <optional>

#include "field/layout.h"
#include "field/update_frame.h"
#include "kernels/abi/field_constants.h"
#include "kernels/abi/gpu_passes.h"
#include "vulkan/device/recorder.h"

namespace probegi::vulkan {

/// Where an update's ray data lie, and what the looks at emitters brought.
struct RayAddresses {
    VkDeviceAddress update = 0;         ///< RayDatum[task][ray]
    VkDeviceAddress fixed = 0;          ///< FixedRayDatum[task][ray]; 0 where the frame has no fixed rays
    VkDeviceAddress emitterLights = 0;  ///< EmitterLight[task][look]
    int looks = 0;                      ///< a task; 0: none
};

/// A field's probes in GPU memory and the passes over them. What an update needs to know of the frame comes from the
/// FieldControl of a GpuField or a Field. Throws Failure and what Vulkan-Hpp throws.
class FieldPasses {
public:
    /// The desc must be valid. Failure: unsupported (more probes than the device's images hold).
    FieldPasses(const Device& device, const FieldDesc& desc);

    /// Forgets what the probes hold. `settings` are those of the shaders that read the field from now on.
    void recordClear(const Recorder& recorder, const FieldSettings& settings);
    /// Traces and shades the rays of the tasks into rayData(), then blends it.
    void recordUpdate(const Recorder& recorder, const UpdateFrame& frame, const GpuScene& scene,
                      const GpuLighting& lighting, Profiler* profiler);
    /// Blends the data at addresses.
    void recordUpdate(const Recorder& recorder, const UpdateFrame& frame, const RayAddresses& data, Profiler* profiler);
    void recordQuery(const Recorder& recorder, const FieldSettings& settings, VkDeviceAddress queries,
                     VkDeviceAddress irradiance, std::uint32_t count, Profiler* profiler);
    /// Brings the constants up to date with the settings, for whoever reads set() in passes of its own.
    void recordSettings(const Recorder& recorder, const FieldSettings& settings);
    /// After commands that were recorded but will not run: the next pass writes constants and tasks again.
    void forgetRecorded() noexcept {
        m_recordedSettings.reset();
        m_recordedTasks.reset();
    }

    vk::DescriptorSet set() const noexcept { return *m_sets.front(); }
    void writeQueryBindings(VkDescriptorSet set, std::uint32_t firstBinding) const;
    FieldMemory memory() const noexcept;

    const FieldDesc& desc() const noexcept { return m_desc; }
    const FieldLayout& layout() const noexcept { return m_layout; }
    std::span<const kernels::Volume> volumes() const noexcept { return m_volumes; }
    kernels::PoolTiles tiles() const noexcept { return m_tiles; }
    const Image& irradiance() const noexcept { return m_irradiance; }
    const Image& visibility() const noexcept { return m_visibility; }
    const Buffer& states() const noexcept { return m_states; }
    const Buffer& sides() const noexcept { return m_sides; }
    const Buffer& filters() const noexcept { return m_filters; }
    const Device& device() const noexcept { return m_device; }

private:
    kernels::FieldConstants constants(const FieldSettings& settings) const;
    void writeSet();
    void makeRayBuffers(int looks);
    void beginUpdate(const Recorder& recorder, const UpdateFrame& frame, int looks, Profiler* profiler);
    void recordTasks(const Recorder& recorder, const UpdateFrame& frame, int looks);
    void recordWeights(const Recorder& recorder, const UpdateFrame& frame, Profiler* profiler);
    void recordTrace(const Recorder& recorder, const UpdateFrame& frame, const GpuScene& scene,
                     const GpuLighting& lighting, const RayAddresses& data, Profiler* profiler);
    /// From ray data on.
    void recordRest(const Recorder& recorder, const UpdateFrame& frame, const RayAddresses& data, Profiler* profiler);
    void recordWindows(const Recorder& recorder, const UpdateFrame& frame, const RayAddresses& data,
                       Profiler* profiler);
    void recordFilter(const Recorder& recorder, const UpdateFrame& frame, const RayAddresses& data, Profiler* profiler);
    void recordSolidProbes(const Recorder& recorder, Profiler* profiler);
    kernels::FilterPush filterPush(const UpdateFrame& frame, const RayAddresses& data) const;
    void recordBlend(const Recorder& recorder, const UpdateFrame& frame, const RayAddresses& data, Profiler* profiler);

    Device m_device;
    FieldDesc m_desc;
    FieldLayout m_layout;
    std::vector<kernels::Volume> m_volumes;
    kernels::PoolTiles m_tiles;
    Image m_irradiance, m_visibility;
    Buffer m_constants;                     // FieldConstants
    Buffer m_states;                        // the count of fallbacks, then each probe's share of backfaces
    Buffer m_tasks;                         // GpuTaskCounts, GpuTask[task]
    Buffer m_sides;                         // ProbeSides a probe
    Buffer m_filters;                       // PackedProbeFilter a probe
    Buffer m_steps, m_changes;              // what the passes of an update hand to each other
    Buffer m_directions;                    // vec3 a ray: those of the update, then the fixed ones
    Buffer m_irradianceWeights;             // float[ray][texel]
    Buffer m_visibilityRays;                // GpuTexelRays[texel]
    Buffer m_visibilityWeights;             // GpuRayWeight[entry][texel]
    Buffer m_hits, m_rayData, m_fixedRays;  // made by the first traced update
    Buffer m_emitterLights;                 // made by the first with emitters
    vk::raii::DescriptorPool m_pool{nullptr};
    vk::raii::DescriptorSets m_sets{nullptr};
    // What the buffers hold once all that was recorded has run.
    std::optional<FieldSettings> m_recordedSettings;
    std::optional<std::uint32_t> m_recordedTasks;  // UpdateFrame::taskList
};

}  // namespace probegi::vulkan

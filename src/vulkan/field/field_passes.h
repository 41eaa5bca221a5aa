#pragma once

#include <algorithm>
#include <optional>

#include "field/layout.h"
#include "field/update_frame.h"
#include "kernels/abi/field_constants.h"
#include "kernels/abi/gpu_passes.h"
#include "vulkan/device/recorder.h"

namespace probegi::vulkan {

/// Addresses of an update's ray data and of the light of its emitter samples.
struct RayAddresses {
    VkDeviceAddress update = 0;         ///< RayDatum[task][ray], or as `format` says
    VkDeviceAddress fixed = 0;          ///< FixedRayDatum[task][ray]; 0 if the frame has no fixed rays
    VkDeviceAddress emitterLights = 0;  ///< EmitterLight[task][look]
    int looks = 0;                      ///< emitter samples per task; 0: none
    RayFormat format = RayFormat::full;
};

/// Of the first binding of query.glsl.
inline vk::DescriptorType constantsType(QueryConstants constants) noexcept {
    return constants == QueryConstants::storageBuffer ? vk::DescriptorType::eStorageBuffer
                                                      : vk::DescriptorType::eUniformBuffer;
}

/// What relocation and states of recorded updates need to know besides the frame.
struct PlacesFrame {
    std::span<const Bounds> moving{}, media{};  ///< at most kMostBounds together
    std::span<const std::uint32_t> chosen{};    ///< slots; empty: all
    std::uint32_t chosenList = 0;               ///< differs between lists
};
inline constexpr std::size_t kMostBounds = 256;

/// A field's probes in GPU memory and the passes over them. The UpdateFrame of an update comes from the FieldControl of
/// a GpuField or a Field. Throws Failure and Vulkan-Hpp's exceptions.
class FieldPasses {
public:
    /// The desc must be valid. Failure: unsupported (more probes than the device's images hold).
    FieldPasses(const Device& device, const FieldDesc& desc);

    /// The volumes stand elsewhere from now on: slots keep what they hold.
    void place(std::span<const kernels::Volume> volumes) noexcept {
        std::copy(volumes.begin(), volumes.end(), m_volumes.begin());
        forgetRecorded();
    }
    /// Compiles what recordEnter() needs, which then cannot fail.
    void prepareEnter() { m_device.impl().pipelines->get("enter_volume"); }
    /// After place(): FieldBackend::enter().
    void recordEnter(const Recorder& recorder, const FieldSettings& settings, int volume, glm::ivec3 cells);
    /// FieldBackend::setPlacements(), from GpuPlacement[slot].
    void recordPlacements(const Recorder& recorder, const FieldSettings& settings, VkDeviceAddress placements);
    /// Of recorded updates with relocation or states, before recordUpdate(): steps the probes' states and lists the
    /// tasks, in GPU memory. With a scene, new probes are placed first; without, recordLook() places them.
    void recordPlaces(const Recorder& recorder, const UpdateFrame& frame, const PlacesFrame& places,
                      const GpuScene* scene, Profiler* profiler);
    /// After recordPlaces(): the sizes of dispatches over the tasks, for callers that trace.
    void recordCounts(const Recorder& recorder, const UpdateFrame& frame);
    /// After recordUpdate() with the caller's rays: they place new probes.
    void recordLook(const Recorder& recorder, const RayAddresses& data);
    /// Clears all probes. From here on, `settings` and `rays` are what shaders that read the field see.
    void recordClear(const Recorder& recorder, const FieldSettings& settings, const kernels::RaySet& rays = {});
    /// Traces and shades the rays of the tasks, then blends the ray data.
    void recordUpdate(const Recorder& recorder, const UpdateFrame& frame, const GpuScene& scene,
                      const GpuLighting& lighting, Profiler* profiler);
    /// Blends ray data that are already in GPU memory.
    void recordUpdate(const Recorder& recorder, const UpdateFrame& frame, const RayAddresses& data, Profiler* profiler);
    void recordQuery(const Recorder& recorder, const FieldSettings& settings, VkDeviceAddress queries,
                     VkDeviceAddress irradiance, std::uint32_t count, Profiler* profiler);
    /// Updates the constants to the settings, for callers that bind set() in passes of their own.
    void recordSettings(const Recorder& recorder, const FieldSettings& settings);
    /// Call it if recorded commands will not run: the next pass writes constants and tasks again.
    void forgetRecorded() noexcept {
        m_recordedSettings.reset();
        m_recordedMasks.reset();
        m_recordedBlockers.reset();
        m_recordedTasks.reset();
        m_recordedChoice.reset();
        m_listed = false;
        m_hasNew = true;
    }

    vk::DescriptorSet set() const noexcept { return *m_sets.front(); }
    void writeQueryBindings(VkDescriptorSet set, std::uint32_t firstBinding,
                            QueryConstants constants = QueryConstants::uniformBuffer) const;
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
    const Buffer& tasks() const noexcept { return m_tasks; }
    /// UpdateFrame::reportsProgress, by slot: of the last updates that the GPU has finished, in memory that it may be
    /// writing. Empty before the first that was recorded with it.
    std::span<const kernels::ProbeProgress> progress() const noexcept {
        return m_progress ? m_progress.mapped<const kernels::ProbeProgress>()
                          : std::span<const kernels::ProbeProgress>();
    }
    bool watched() const noexcept { return m_desc.relocation || m_desc.probeStates; }
    const Device& device() const noexcept { return m_device; }

private:
    kernels::FieldConstants constants(const FieldSettings& settings) const;
    kernels::VolumeBlending blending(const FieldSettings& settings) const;
    /// Writes the constants of the settings, and, if they are others than before, the masks. Throws before it records.
    void recordConstants(const Recorder& recorder, const FieldSettings& settings);
    void recordMasks(const Recorder& recorder, const FieldSettings& settings);
    void recordBlockers(const Recorder& recorder, const FieldSettings& settings);
    /// Writes to a buffer that may still be read: ordered by barriers, or, where it is too small, to another one.
    void replace(const Recorder& recorder, Buffer& buffer, const char* name, std::span<const std::byte> bytes);
    void writeSet();
    void makeRayBuffers(int looks);
    /// What an update with a budget needs besides.
    void makeBudgetBuffers(const UpdateFrame& frame);
    void beginUpdate(const Recorder& recorder, const UpdateFrame& frame, int looks, Profiler* profiler);
    void recordTasks(const Recorder& recorder, const UpdateFrame& frame, int looks);
    kernels::PlacesPush placesPush(const UpdateFrame& frame, const PlacesFrame& places) const;
    void recordWeights(const Recorder& recorder, const UpdateFrame& frame, Profiler* profiler);
    void recordTrace(const Recorder& recorder, const UpdateFrame& frame, const GpuScene& scene,
                     const GpuLighting& lighting, const RayAddresses& data, Profiler* profiler);
    /// All passes after the ray data.
    void recordRest(const Recorder& recorder, const UpdateFrame& frame, const RayAddresses& data, Profiler* profiler);
    void recordWindows(const Recorder& recorder, const UpdateFrame& frame, const RayAddresses& data,
                       Profiler* profiler);
    void recordEvents(const Recorder& recorder, const UpdateFrame& frame, Profiler* profiler);
    void recordFilter(const Recorder& recorder, const UpdateFrame& frame, const RayAddresses& data, Profiler* profiler);
    void recordSolidProbes(const Recorder& recorder, Profiler* profiler);
    kernels::FilterPush filterPush(const UpdateFrame& frame, const RayAddresses& data) const;
    void recordBlend(const Recorder& recorder, const UpdateFrame& frame, const RayAddresses& data, Profiler* profiler);

    Device m_device;
    FieldDesc m_desc;
    FieldLayout m_layout;
    std::vector<kernels::Volume> m_volumes;
    std::vector<int> m_byDensity;
    kernels::PoolTiles m_tiles;
    Image m_irradiance, m_visibility;
    Buffer m_constants;                     // FieldConstants
    Buffer m_states;                        // count of fallback queries, then each probe's share of backfaces
    Buffer m_tasks;                         // GpuTaskCounts, ProbeTask[task]
    Buffer m_sides;                         // ProbeSides per probe
    Buffer m_filters;                       // PackedProbeFilter per probe
    Buffer m_steps, m_changes;              // passed between the passes of an update
    Buffer m_surfaces, m_bounds, m_chosen;  // of recorded updates with relocation or states: kernels::PlacesPush
    Buffer m_directions;                    // vec3 per ray: those of the update, then the fixed ones
    Buffer m_masks;                         // Masks::words(); created by the first settings with LeakGuard::masks
    Buffer m_blockers;                      // SdfBlocker of LeakGuard::sdfShadow
    std::vector<Buffer> m_earlier;          // masks and primitives that were too small for those of today
    Buffer m_events;                        // EventRegion of the update
    Buffer m_limits;                        // EventLimit per probe; created by the first update that has any
    Buffer m_progress;                      // ProbeProgress per probe, for the host; the same
    Buffer m_irradianceWeights;             // float[ray][texel]
    Buffer m_visibilityRays;                // GpuTexelRays[texel]
    Buffer m_visibilityWeights;             // GpuRayWeight[entry][texel]
    Buffer m_hits, m_rayData, m_fixedRays;  // created by the first traced update
    Buffer m_emitterLights;                 // created by the first with emitters
    vk::raii::DescriptorPool m_pool{nullptr};
    vk::raii::DescriptorSets m_sets{nullptr};
    // Contents of the buffers once all recorded commands have run.
    std::optional<FieldSettings> m_recordedSettings;
    std::shared_ptr<const Masks> m_recordedMasks;
    std::shared_ptr<const SdfBlockers> m_recordedBlockers;
    std::optional<std::uint32_t> m_recordedTasks;   // UpdateFrame::taskList
    std::optional<std::uint32_t> m_recordedChoice;  // PlacesFrame::chosenList
    kernels::RaySet m_rays{};                       // of the update after the last recorded one
    kernels::PlacesPush m_places{};                 // of the last recordPlaces()
    bool m_listed = false;                          // the tasks of the coming update are in m_tasks
    bool m_hasNew = true;                           // some probes may await their placement
};

}  // namespace probegi::vulkan

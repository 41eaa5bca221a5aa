#pragma once

#include <optional>

#include "field/frame_books.h"
#include "field/layout.h"
#include "kernels/abi/gpu_passes.h"
#include "kernels/volume/gpu_volume.h"
#include "vulkan/device/errors.h"
#include "vulkan/device/recorder.h"

namespace probegi::vulkan {

/// Where an update's ray data lie, and what the looks at emitters brought.
struct RayAddresses {
    VkDeviceAddress update = 0;         ///< RayDatum[probe][ray]
    VkDeviceAddress fixed = 0;          ///< FixedRayDatum[probe][ray]; 0 where the frame has no fixed rays
    VkDeviceAddress emitterLights = 0;  ///< EmitterLight[probe][look]
    int looks = 0;                      ///< a probe; 0: none
};

/// Probes in GPU memory and the passes over them. What an update needs to know of the frame comes from outside: from
/// ProbeVolume's books for an engine, from Field's for a FieldBackend. Throws Failure and what Vulkan-Hpp throws.
class VolumePasses {
public:
    /// The desc must be valid. Failure: unsupported (too many probes along an axis).
    VolumePasses(const Device& device, const FieldDesc& desc);

    /// Forgets what the probes hold. `guard` is that of the shaders that read the volume from now on.
    void recordClear(const Recorder& recorder, LeakGuard guard);
    /// Traces and shades the rays of all probes into rayData(), then blends it.
    void recordUpdate(const Recorder& recorder, const UpdateFrame& frame, const GpuScene& scene,
                      const GpuLighting& lighting, Profiler* profiler);
    /// Blends the data at addresses.
    void recordUpdate(const Recorder& recorder, const UpdateFrame& frame, const RayAddresses& data, Profiler* profiler);
    void recordQuery(const Recorder& recorder, const FieldDesc& desc, VkDeviceAddress queries,
                     VkDeviceAddress irradiance, std::uint32_t count, Profiler* profiler);
    /// Brings the constants up to date with the desc's guard, for whoever reads set() in passes of its own.
    void recordGuard(const Recorder& recorder, const FieldDesc& desc);
    /// After commands that were recorded but will not run: the next pass writes the constants again.
    void forgetGuard() noexcept { m_recordedGuard.reset(); }

    vk::DescriptorSet set() const noexcept { return *m_sets.front(); }
    void writeQueryBindings(VkDescriptorSet set, std::uint32_t firstBinding) const;
    FieldMemory memory() const noexcept;

    const FieldDesc& desc() const noexcept { return m_desc; }  ///< as it was made
    const FieldLayout& layout() const noexcept { return m_layout; }
    const Image& irradiance() const noexcept { return m_irradiance; }
    const Image& visibility() const noexcept { return m_visibility; }
    const Buffer& states() const noexcept { return m_states; }
    const Device& device() const noexcept { return m_device; }

private:
    kernels::GpuVolume constants(LeakGuard guard) const;
    void writeSet();
    void makeRayBuffers(int looks);
    void beginUpdate(const Recorder& recorder, const UpdateFrame& frame, Profiler* profiler);
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
    Image m_irradiance, m_visibility;
    Buffer m_constants;                     // GpuVolume
    Buffer m_states;                        // the count of fallbacks, then each probe's share of backfaces
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
    std::optional<LeakGuard> m_recordedGuard;  // what the constants hold once all that was recorded has run
};

struct ProbeVolume::Impl {
    Impl(const Device& device, const FieldDesc& desc) : passes(device, desc), books(desc) {}

    /// guarded(), for passes: a caller drops the command buffer of those that failed.
    template <class Body>
    Result<void> recorded(const char* doing, const Body& body) {
        auto done = guarded(doing, body);
        if (!done) passes.forgetGuard();
        return done;
    }

    VolumePasses passes;
    FrameBooks books;
};

}  // namespace probegi::vulkan

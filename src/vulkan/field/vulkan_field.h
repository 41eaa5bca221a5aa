#pragma once

#include <mutex>
#include <optional>

#include "field/field_backend.h"
#include "kernels/light/emitter_sampling.h"
#include "vulkan/device/exchange.h"
#include "vulkan/field/field_mirror.h"
#include "vulkan/tracers/gpu_tracer.h"

namespace probegi::vulkan {

/// A field whose probes and passes are on the GPU. Every call records, submits and waits.
class VulkanField final : public FieldBackend {
public:
    /// The desc must be valid. Throws.
    VulkanField(const Context& context, const Device& device, const FieldDesc& desc, const FieldSettings& settings);

    Result<UpdateTimes> update(const UpdateFrame& frame, std::span<const RayDatum> rayData,
                               std::span<const FixedRayDatum> fixedRays) override;
    Result<UpdateTimes> update(const UpdateFrame& frame, const Tracer& tracer, const Lighting& lighting) override;
    Result<void> irradiance(const FieldSettings& settings, std::span<const FieldQuery> queries,
                            std::span<glm::vec3> out) const override;
    glm::vec3 irradiance(const FieldSettings& settings, const FieldQuery& query) const noexcept override;
    Result<ProbeLight> light() const override;
    void place(std::span<const kernels::Volume> volumes) noexcept override;
    Result<void> enter(const FieldSettings& settings, int volume, glm::ivec3 cells) override;
    Result<void> setPlacements(const FieldSettings& settings, std::span<const std::uint32_t> placements,
                               std::span<const std::uint32_t> renewed) override;
    Result<FieldSnapshot> read(SlotRange slots) const override;
    Result<void> write(const FieldSnapshot& snapshot) override;

    std::span<const kernels::ProbeProgress> progress() const noexcept override { return m_passes.progress(); }
    FieldMemory memory() const noexcept override;
    std::uint64_t fallbackQueries() const noexcept override;

    const Device& device() const noexcept { return m_device; }
    FieldPasses& passes() const noexcept { return m_passes; }
    std::vector<PassTime> passTimes() const;

private:
    /// The lighting in GPU memory, uploaded again only if it has changed. Throws.
    const GpuLighting& uploaded(const Lighting& lighting) const;
    UpdateTimes updateOnGpu(const UpdateFrame& frame, const GpuTracer& tracer, const Lighting& lighting);
    UpdateTimes updateFrom(const UpdateFrame& frame, std::span<const RayDatum> rayData,
                           std::span<const FixedRayDatum> fixedRays, std::span<const kernels::EmitterLight> lights);
    /// guarded() for passes over the field.
    template <class Body>
    auto attempted(const char* doing, const Body& body) const;
    /// The mirror, refreshed if it is out of date. Throws.
    FieldMirror& mirror() const;

    Context m_context;
    Device m_device;
    mutable std::mutex m_mutex;  // queries may come from several threads
    mutable FieldPasses m_passes;
    mutable Exchange m_exchange;
    mutable std::optional<Profiler> m_profiler;
    mutable std::optional<FieldMirror> m_mirror;  // empty: out of date
    mutable std::optional<Lighting> m_lightingSource;
    mutable std::optional<GpuLighting> m_lighting;
    std::vector<RayDatum> m_rayData;         // of rays traced by another backend's tracer
    std::vector<FixedRayDatum> m_fixedRays;  // the same
    std::vector<kernels::EmitterLight> m_emitterLights;
    std::vector<PassTime> m_updatePasses;
    mutable std::vector<PassTime> m_queryPasses;
};

}  // namespace probegi::vulkan

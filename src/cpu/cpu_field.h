#pragma once

#include <atomic>
#include <vector>

#include "cpu/blend_pass.h"
#include "cpu/field_view.h"
#include "cpu/filter_passes.h"
#include "field/field_backend.h"

namespace probegi {

/// A field on threads and SIMD, with its probes in main memory.
class CpuField final : public FieldBackend {
public:
    CpuField(const Context& context, const FieldDesc& desc);

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

    std::span<const kernels::ProbeProgress> progress() const noexcept override { return m_filter.progress(); }
    FieldMemory memory() const noexcept override;
    std::uint64_t fallbackQueries() const noexcept override { return m_fallbacks.load(); }

private:
    void renew(std::size_t slot) noexcept;
    FieldView view(const FieldSettings& settings) const noexcept;
    void blend(const UpdateFrame& frame, std::span<const RayDatum> rayData, std::span<const FixedRayDatum> fixedRays,
               std::span<const kernels::EmitterLight> emitters);

    Context m_context;
    FieldDesc m_desc;
    FieldLayout m_layout;
    std::vector<kernels::Volume> m_volumes;
    std::vector<int> m_byDensity;
    FieldStorage m_storage;
    TapTable m_irradianceTaps, m_visibilityTaps;
    std::vector<RayDatum> m_rayData;
    std::vector<FixedRayDatum> m_fixedRays;
    TemporalFilter m_filter;
    std::vector<kernels::EmitterLight> m_emitterLights;
    BlendWeights m_weights;
    mutable std::atomic<std::uint64_t> m_fallbacks{0};
};

}  // namespace probegi

#pragma once

#include <atomic>

#include "field/field_backend.h"
#include "field/layout.h"

namespace probegi::test {

/// A field on one thread, in the plainest loops that kernels allow: no matrix product, no lanes, its probes in a
/// snapshot. With FieldRules::paper only, and among single-sided surfaces (it searches no path into the open).
class PlainField final : public FieldBackend {
public:
    PlainField(const Context& context, const FieldDesc& desc);

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
    FieldMemory memory() const noexcept override;
    std::uint64_t fallbackQueries() const noexcept override { return m_fallbacks; }

private:
    void renew(int slot);
    void blend(const UpdateFrame& frame, const ProbeTask& task, std::span<const RayDatum> rays);
    void blendIrradiance(const UpdateFrame& frame, const ProbeTask& task, std::span<const RayDatum> rays);
    void blendVisibility(const UpdateFrame& frame, const ProbeTask& task, std::span<const RayDatum> rays);
    void blendSides(const UpdateFrame& frame, const ProbeTask& task, std::span<const RayDatum> rays);
    FrameHysteresis keptBy(const UpdateFrame& frame, const ProbeTask& task) const;
    std::uint32_t numberOf(const ProbeTask& task) const;

    Context m_context;
    std::vector<kernels::Volume> m_volumes;
    std::vector<int> m_byDensity;
    FieldSnapshot m_probes;  // all of them
    mutable std::atomic<std::uint64_t> m_fallbacks{0};
};

}  // namespace probegi::test

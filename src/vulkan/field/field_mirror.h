#pragma once

#include <vector>

#include "field/field_backend.h"
#include "kernels/probe/solid_probe.h"
#include "vulkan/device/exchange.h"
#include "vulkan/field/gpu_field_impl.h"

namespace probegi::vulkan {

/// A field's atlases and states in main memory: read back from the GPU, and written to it. Throws.
class FieldMirror {
public:
    /// Copies everything from the GPU and waits.
    explicit FieldMirror(const FieldPasses& passes);

    ProbeLight light() const;
    FieldSnapshot read(SlotRange slots) const;
    /// Takes over the snapshot's probes, copies everything to the GPU and waits.
    void write(const FieldSnapshot& snapshot);

private:
    /// A texel of a slot's map in an atlas, border texels included: -1 <= x, y <= texels.
    std::size_t texelIndex(const Image& image, int texels, int slot, glm::ivec2 texel) const;
    void readMaps(FieldSnapshot& snapshot, std::size_t probe, int slot) const;
    void writeMaps(const FieldSnapshot& snapshot, std::size_t probe, int slot);
    void upload() const;

    const FieldPasses& m_passes;
    FieldDesc m_desc;
    std::vector<std::uint16_t> m_irradiance;  // four halves per texel
    std::vector<std::uint32_t> m_visibility;
    std::vector<kernels::ProbeStatus> m_statuses;
    std::vector<kernels::ProbeSides> m_sides;
    std::vector<kernels::PackedProbeFilter> m_filters;
};

}  // namespace probegi::vulkan

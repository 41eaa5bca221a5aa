#pragma once

#include <vector>

#include "vulkan/device/exchange.h"
#include "vulkan/field/gpu_field_impl.h"

namespace probegi::vulkan {

/// A volume's atlases and states as the CPU reads them back: for looking at single probes, not for rendering. Throws.
class FieldMirror {
public:
    /// Copies everything from the GPU and waits.
    explicit FieldMirror(const FieldPasses& passes);

    /// Encoded irradiance of an interior or border texel, -1 <= x, y <= size.
    glm::vec3 irradianceTexel(int probe, glm::ivec2 texel) const;
    /// Moments of an interior or border texel, as fractions of the farthest distance and its square.
    glm::vec2 visibilityTexel(int probe, glm::ivec2 texel) const;
    float backfaceShare(int probe) const { return m_shares[std::size_t(probe)]; }
    std::uint32_t fallbacks() const noexcept { return m_fallbacks; }

    /// As Field's of the same names.
    glm::vec3 probeIrradiance(int probe, glm::vec3 normal) const;
    glm::vec2 probeDistanceMoments(int probe, glm::vec3 direction) const;
    std::vector<float> brightness() const;

private:
    std::size_t texelIndex(const Image& image, int texels, int probe, glm::ivec2 texel) const;

    const FieldPasses& m_passes;
    FieldDesc m_desc;
    std::vector<std::uint16_t> m_irradiance;  // four halves a texel
    std::vector<std::uint32_t> m_visibility;
    std::vector<float> m_shares;
    std::uint32_t m_fallbacks = 0;
};

}  // namespace probegi::vulkan

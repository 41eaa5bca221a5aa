#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "probegi/scene.h"

namespace probegi {

/// Linear value of an 8-bit sRGB code (IEC 61966-2-1), 0..1.
float srgbToLinear(std::uint8_t code) noexcept;

/// A TextureRef resolved for look-ups. Copies no texels: the image's pixels must outlive the sampler.
/// Filtering happens on linear values: each texel is decoded first, then blended. Look-ups are on mip level 0: a Ray
/// carries no footprint, and an unfiltered look-up is unbiased, so noise falls with the number of rays.
class TextureSampler {
public:
    /// No texture: all look-ups give 1.
    TextureSampler() = default;
    TextureSampler(const TextureRef& ref, const TextureImage& image);

    bool present() const noexcept { return m_texels != nullptr; }
    int texCoord() const noexcept { return m_texCoord; }

    /// RGB decoded from sRGB. uv is the mesh's, before the material's uv transform; not finite: treated as 0.
    glm::vec3 color(glm::vec2 uv) const noexcept;
    /// RGB as it is stored, divided by 255.
    glm::vec3 data(glm::vec2 uv) const noexcept;
    /// Alpha divided by 255.
    float alpha(glm::vec2 uv) const noexcept;
    /// Bounds of alpha over all texels, 0..1.
    glm::vec2 alphaRange() const noexcept;

private:
    /// The texels that a look-up blends: byte offsets of the four corners and their weights.
    struct Footprint {
        std::uint32_t offset[4];
        glm::vec4 weights;
    };
    Footprint footprint(glm::vec2 uv) const noexcept;

    const std::uint8_t* m_texels = nullptr;
    std::int32_t m_width = 0;
    std::int32_t m_height = 0;
    glm::vec3 m_rowU{1, 0, 0};  ///< the uv transform's upper two rows
    glm::vec3 m_rowV{0, 1, 0};
    Wrap m_wrapU = Wrap::repeat;
    Wrap m_wrapV = Wrap::repeat;
    bool m_nearest = false;
    std::uint8_t m_texCoord = 0;
};

}  // namespace probegi

#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>

#include "probegi/scene.h"

namespace probegi {

/// Linear value of an 8-bit sRGB code (IEC 61966-2-1), 0..1.
float srgbToLinear(std::uint8_t code) noexcept;

/// A TextureRef resolved for look-ups. Copies no texels: the image's pixels must outlive the sampler.
/// Filtering is on linear values: each texel is decoded before blending. Look-ups without a level use mip level 0:
/// averaged over many rays they need no filter, since unfiltered look-ups are unbiased.
class TextureSampler {
public:
    /// No texture: all look-ups return 1.
    TextureSampler() = default;
    /// `mips`: makeMips() of the image, which must outlive the sampler; empty: level 0 only.
    TextureSampler(const TextureRef& ref, const TextureImage& image, std::span<const std::uint8_t> mips = {});

    bool present() const noexcept { return m_texels != nullptr; }
    int texCoord() const noexcept { return m_texCoord; }

    /// Number of levels for look-ups.
    int levels() const noexcept { return m_levels; }
    /// Texels per unit area of the mesh's uv space.
    float texelsPerUvArea() const noexcept;

    /// RGB decoded from sRGB. uv is the mesh's, before the material's uv transform; not finite: treated as 0.
    glm::vec3 color(glm::vec2 uv) const noexcept;
    /// The same between two mip levels, 0 <= level <= levels() - 1.
    glm::vec3 color(glm::vec2 uv, float level) const noexcept;
    /// RGB as stored, divided by 255.
    glm::vec3 data(glm::vec2 uv) const noexcept;
    glm::vec3 data(glm::vec2 uv, float level) const noexcept;
    /// Prefetches the texels that color(uv) and data(uv) read.
    void fetchAhead(glm::vec2 uv) const noexcept;
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
    Footprint footprint(glm::vec2 uv, std::int32_t width, std::int32_t height) const noexcept;
    /// One mip level's texels.
    struct Level {
        const std::uint8_t* texels;
        std::int32_t width, height;
    };
    Level level(int number) const noexcept;
    glm::vec3 color(const Level& level, glm::vec2 uv) const noexcept;
    glm::vec3 data(const Level& level, glm::vec2 uv) const noexcept;

    const std::uint8_t* m_texels = nullptr;
    const std::uint8_t* m_mips = nullptr;
    std::int32_t m_levels = 1;
    std::int32_t m_width = 0;
    std::int32_t m_height = 0;
    glm::vec3 m_rowU{1, 0, 0};  ///< upper two rows of the uv transform
    glm::vec3 m_rowV{0, 1, 0};
    Wrap m_wrapU = Wrap::repeat;
    Wrap m_wrapV = Wrap::repeat;
    bool m_nearest = false;
    std::uint8_t m_texCoord = 0;
};

}  // namespace probegi

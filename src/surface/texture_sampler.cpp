#include "surface/texture_sampler.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace probegi {

namespace {

std::array<float, 256> makeSrgbTable() {
    std::array<float, 256> table;
    for (int code = 0; code < 256; ++code) {
        const double s = code / 255.0;
        table[std::size_t(code)] = float(s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4));
    }
    return table;
}

const std::array<float, 256> kSrgbToLinear = makeSrgbTable();

/// Brings a coordinate into 0..1. Indices just outside are then repeated (repeat) or clamped (the other two: the
/// mirror image of the first texel is the first texel).
float fold(float u, Wrap wrap) {
    switch (wrap) {
        case Wrap::repeat:
            return u - std::floor(u);
        case Wrap::clampToEdge:
            return std::clamp(u, 0.0f, 1.0f);
        case Wrap::mirroredRepeat:
            return std::abs(u - 2.0f * std::floor(0.5f * u + 0.5f));
    }
    return u;
}

/// Index of a texel that is at most one step outside 0..size-1.
std::int32_t wrapIndex(std::int32_t i, std::int32_t size, Wrap wrap) {
    if (wrap == Wrap::repeat) return i < 0 ? size - 1 : (i >= size ? 0 : i);
    return std::clamp(i, 0, size - 1);
}

/// The two neighbouring texels along one axis and how far the point lies from the first to the second.
struct Span {
    std::int32_t first, second;
    float fraction;
};

// Inlined by force: returned in registers, the two indices are packed through memory, and reading them back as one word
// stalls longer than all the rest of the look-up takes.
[[gnu::always_inline]] inline Span neighbours(float u, std::int32_t size, Wrap wrap, bool nearest) {
    const float x = fold(u, wrap) * float(size);
    if (nearest) {
        const std::int32_t i = std::min(std::int32_t(x), size - 1);
        return {i, i, 0.0f};
    }
    const float centred = x - 0.5f;
    const float lower = std::floor(centred);
    const std::int32_t i = std::int32_t(lower);
    return {wrapIndex(i, size, wrap), wrapIndex(i + 1, size, wrap), centred - lower};
}

}  // namespace

float srgbToLinear(std::uint8_t code) noexcept {
    return kSrgbToLinear[code];
}

TextureSampler::TextureSampler(const TextureRef& ref, const TextureImage& image)
    : m_texels(image.rgba.data()),
      m_width(image.width),
      m_height(image.height),
      m_rowU(ref.uvTransform[0][0], ref.uvTransform[1][0]),
      m_rowV(ref.uvTransform[0][1], ref.uvTransform[1][1]),
      m_shift(ref.uvTransform[2][0], ref.uvTransform[2][1]),
      m_wrapU(ref.wrapU),
      m_wrapV(ref.wrapV),
      m_nearest(ref.nearest),
      m_texCoord(std::uint8_t(ref.texCoord)) {}

TextureSampler::Footprint TextureSampler::footprint(glm::vec2 uv) const noexcept {
    float u = glm::dot(m_rowU, uv) + m_shift.x;
    float v = glm::dot(m_rowV, uv) + m_shift.y;
    if (!std::isfinite(u)) u = 0.0f;
    if (!std::isfinite(v)) v = 0.0f;
    const Span x = neighbours(u, m_width, m_wrapU, m_nearest);
    const Span y = neighbours(v, m_height, m_wrapV, m_nearest);
    const auto offset = [this](std::int32_t i, std::int32_t j) {
        return 4u * (std::uint32_t(j) * std::uint32_t(m_width) + std::uint32_t(i));
    };
    return {
        {offset(x.first, y.first), offset(x.second, y.first), offset(x.first, y.second), offset(x.second, y.second)},
        {(1 - x.fraction) * (1 - y.fraction), x.fraction * (1 - y.fraction), (1 - x.fraction) * y.fraction,
         x.fraction * y.fraction}};
}

glm::vec3 TextureSampler::color(glm::vec2 uv) const noexcept {
    if (!present()) return glm::vec3(1.0f);
    const Footprint f = footprint(uv);
    glm::vec3 sum(0.0f);
    for (int i = 0; i < 4; ++i) {
        const std::uint8_t* texel = m_texels + f.offset[i];
        sum += f.weight[i] * glm::vec3(kSrgbToLinear[texel[0]], kSrgbToLinear[texel[1]], kSrgbToLinear[texel[2]]);
    }
    return sum;
}

glm::vec3 TextureSampler::data(glm::vec2 uv) const noexcept {
    if (!present()) return glm::vec3(1.0f);
    const Footprint f = footprint(uv);
    glm::vec3 sum(0.0f);
    for (int i = 0; i < 4; ++i) {
        const std::uint8_t* texel = m_texels + f.offset[i];
        sum += f.weight[i] * glm::vec3(texel[0], texel[1], texel[2]);
    }
    return sum * (1.0f / 255.0f);
}

float TextureSampler::alpha(glm::vec2 uv) const noexcept {
    if (!present()) return 1.0f;
    const Footprint f = footprint(uv);
    float sum = 0.0f;
    for (int i = 0; i < 4; ++i) sum += f.weight[i] * float(m_texels[f.offset[i] + 3]);
    return sum * (1.0f / 255.0f);
}

glm::vec2 TextureSampler::alphaRange() const noexcept {
    if (!present()) return glm::vec2(1.0f);
    std::uint8_t least = 255, most = 0;
    const std::size_t end = std::size_t(m_width) * std::size_t(m_height) * 4;
    for (std::size_t i = 3; i < end; i += 4) {
        least = std::min(least, m_texels[i]);
        most = std::max(most, m_texels[i]);
    }
    return glm::vec2(least, most) / 255.0f;
}

}  // namespace probegi

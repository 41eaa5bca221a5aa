#include "surface/texture_sampler.h"

#include <algorithm>
#include <array>

#include "kernels/colour.h"
#include "kernels/texture.h"

namespace probegi {

namespace {

std::array<float, 256> makeSrgbTable() {
    std::array<float, 256> table;
    for (std::size_t code = 0; code < table.size(); ++code) table[code] = kernels::decodeSrgb(float(code) / 255.0f);
    return table;
}

const std::array<float, 256> kSrgbToLinear = makeSrgbTable();

static_assert(int(Wrap::repeat) == kernels::kWrapRepeat);
static_assert(int(Wrap::clampToEdge) == kernels::kWrapClampToEdge);
static_assert(int(Wrap::mirroredRepeat) == kernels::kWrapMirroredRepeat);

}  // namespace

float srgbToLinear(std::uint8_t code) noexcept {
    return kSrgbToLinear[code];
}

TextureSampler::TextureSampler(const TextureRef& ref, const TextureImage& image)
    : m_texels(image.rgba.data()),
      m_width(image.width),
      m_height(image.height),
      m_rowU(ref.uvTransform[0][0], ref.uvTransform[1][0], ref.uvTransform[2][0]),
      m_rowV(ref.uvTransform[0][1], ref.uvTransform[1][1], ref.uvTransform[2][1]),
      m_wrapU(ref.wrapU),
      m_wrapV(ref.wrapV),
      m_nearest(ref.nearest),
      m_texCoord(std::uint8_t(ref.texCoord)) {}

// Flattened: were texelSpan's results returned in registers, the two indices would be packed through memory, and
// reading them back as one word stalls longer than all the rest of the look-up takes.
[[gnu::flatten]] TextureSampler::Footprint TextureSampler::footprint(glm::vec2 uv) const noexcept {
    const glm::vec2 at = kernels::transformUv(m_rowU, m_rowV, uv);
    const kernels::TexelSpan x = kernels::texelSpan(at.x, m_width, int(m_wrapU), m_nearest);
    const kernels::TexelSpan y = kernels::texelSpan(at.y, m_height, int(m_wrapV), m_nearest);
    const auto offset = [this](std::int32_t i, std::int32_t j) {
        return 4u * (std::uint32_t(j) * std::uint32_t(m_width) + std::uint32_t(i));
    };
    return {
        {offset(x.first, y.first), offset(x.second, y.first), offset(x.first, y.second), offset(x.second, y.second)},
        kernels::bilinearWeights(x.fraction, y.fraction)};
}

glm::vec3 TextureSampler::color(glm::vec2 uv) const noexcept {
    if (!present()) return glm::vec3(1.0f);
    const Footprint f = footprint(uv);
    const auto fetch = [&](int i) {
        const std::uint8_t* texel = m_texels + f.offset[i];
        return glm::vec3(kSrgbToLinear[texel[0]], kSrgbToLinear[texel[1]], kSrgbToLinear[texel[2]]);
    };
    return kernels::blendTexels(f.weights, fetch(0), fetch(1), fetch(2), fetch(3));
}

glm::vec3 TextureSampler::data(glm::vec2 uv) const noexcept {
    if (!present()) return glm::vec3(1.0f);
    const Footprint f = footprint(uv);
    const auto fetch = [&](int i) {
        const std::uint8_t* texel = m_texels + f.offset[i];
        return glm::vec3(texel[0], texel[1], texel[2]);
    };
    return kernels::blendTexels(f.weights, fetch(0), fetch(1), fetch(2), fetch(3)) * (1.0f / 255.0f);
}

float TextureSampler::alpha(glm::vec2 uv) const noexcept {
    if (!present()) return 1.0f;
    const Footprint f = footprint(uv);
    const auto fetch = [&](int i) { return float(m_texels[f.offset[i] + 3]); };
    return kernels::blendTexels(f.weights, fetch(0), fetch(1), fetch(2), fetch(3)) * (1.0f / 255.0f);
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

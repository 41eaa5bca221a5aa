#include "geometry/texture_sampler.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>

#include "core/prefetch.h"
#include "kernels/screen/colour.h"
#include "kernels/shade/texture.h"

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

TextureSampler::TextureSampler(const TextureRef& ref, const TextureImage& image, std::span<const std::uint8_t> mips)
    : m_texels(image.rgba.data()),
      m_mips(mips.data()),
      m_levels(mips.empty() ? 1 : kernels::mipLevels(image.width, image.height)),
      m_width(image.width),
      m_height(image.height),
      m_rowU(ref.uvTransform[0][0], ref.uvTransform[1][0], ref.uvTransform[2][0]),
      m_rowV(ref.uvTransform[0][1], ref.uvTransform[1][1], ref.uvTransform[2][1]),
      m_wrapU(ref.wrapU),
      m_wrapV(ref.wrapV),
      m_nearest(ref.nearest),
      m_texCoord(std::uint8_t(ref.texCoord)) {}

// Flattened: otherwise texelSpan's two indices are written to memory separately and read back as one word, and that
// stall takes longer than the rest of the look-up.
[[gnu::flatten]] TextureSampler::Footprint TextureSampler::footprint(glm::vec2 uv, std::int32_t width,
                                                                     std::int32_t height) const noexcept {
    const glm::vec2 at = kernels::transformUv(m_rowU, m_rowV, uv);
    const kernels::TexelSpan x = kernels::texelSpan(at.x, width, int(m_wrapU), m_nearest);
    const kernels::TexelSpan y = kernels::texelSpan(at.y, height, int(m_wrapV), m_nearest);
    const auto offset = [width](std::int32_t i, std::int32_t j) {
        return 4u * (std::uint32_t(j) * std::uint32_t(width) + std::uint32_t(i));
    };
    return {
        {offset(x.first, y.first), offset(x.second, y.first), offset(x.first, y.second), offset(x.second, y.second)},
        kernels::bilinearWeights(x.fraction, y.fraction)};
}

float TextureSampler::texelsPerUvArea() const noexcept {
    return kernels::texelsPerUvArea(m_rowU, m_rowV, m_width, m_height);
}

TextureSampler::Level TextureSampler::level(int number) const noexcept {
    if (number == 0) return {m_texels, m_width, m_height};
    return {m_mips + 4 * std::size_t(kernels::mipOffset(m_width, m_height, number)), kernels::mipSize(m_width, number),
            kernels::mipSize(m_height, number)};
}

glm::vec3 TextureSampler::color(glm::vec2 uv) const noexcept {
    return present() ? color(level(0), uv) : glm::vec3(1.0f);
}

glm::vec3 TextureSampler::data(glm::vec2 uv) const noexcept {
    return present() ? data(level(0), uv) : glm::vec3(1.0f);
}

glm::vec3 TextureSampler::color(glm::vec2 uv, float at) const noexcept {
    const int finer = int(at);
    const glm::vec3 texel = color(level(finer), uv);
    return at == float(finer) ? texel : glm::mix(texel, color(level(finer + 1), uv), at - float(finer));
}

glm::vec3 TextureSampler::data(glm::vec2 uv, float at) const noexcept {
    const int finer = int(at);
    const glm::vec3 texel = data(level(finer), uv);
    return at == float(finer) ? texel : glm::mix(texel, data(level(finer + 1), uv), at - float(finer));
}

glm::vec3 TextureSampler::color(const Level& on, glm::vec2 uv) const noexcept {
    const Footprint f = footprint(uv, on.width, on.height);
    const auto fetch = [&](int i) {
        const std::uint8_t* texel = on.texels + f.offset[i];
        return glm::vec3(kSrgbToLinear[texel[0]], kSrgbToLinear[texel[1]], kSrgbToLinear[texel[2]]);
    };
    return kernels::blendTexels(f.weights, fetch(0), fetch(1), fetch(2), fetch(3));
}

glm::vec3 TextureSampler::data(const Level& on, glm::vec2 uv) const noexcept {
    const Footprint f = footprint(uv, on.width, on.height);
    const auto fetch = [&](int i) {
        const std::uint8_t* texel = on.texels + f.offset[i];
        return glm::vec3(texel[0], texel[1], texel[2]);
    };
    return kernels::blendTexels(f.weights, fetch(0), fetch(1), fetch(2), fetch(3)) * (1.0f / 255.0f);
}

void TextureSampler::fetchAhead(glm::vec2 uv) const noexcept {
    if (!present()) return;
    const Footprint f = footprint(uv, m_width, m_height);
    prefetch(m_texels + f.offset[0]);
    prefetch(m_texels + f.offset[2]);
}

float TextureSampler::alpha(glm::vec2 uv) const noexcept {
    if (!present()) return 1.0f;
    const Footprint f = footprint(uv, m_width, m_height);
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

#include "geometry/mip_maps.h"

#include <algorithm>
#include <array>

#include "core/parallel.h"
#include "kernels/screen/colour.h"
#include "kernels/shade/texture.h"

namespace probegi {

namespace {

/// The texels of the finer level that one texel covers along an axis, and their weights.
struct Cover {
    int first = 0, count = 1;
    float shares[3] = {1, 0, 0};
};

// For n texels, halved and rounded down. Even n: two each. Odd n = 2 m + 1: texel i covers 2 + 1/m of them, from 2 i +
// i/m to 2 i + 2 + (i + 1)/m.
std::vector<Cover> covers(int n) {
    const int half = kernels::mipSize(n, 1);
    std::vector<Cover> result(static_cast<std::size_t>(half));
    for (int i = 0; i < half && n > 1; ++i) {
        const float m = float(half), all = float(n);
        if (n % 2 == 0)
            result[std::size_t(i)] = {2 * i, 2, {0.5f, 0.5f, 0}};
        else
            result[std::size_t(i)] = {2 * i, 3, {(m - float(i)) / all, m / all, float(i + 1) / all}};
    }
    return result;
}

/// Decodes a texel's codes, and encodes to the nearest code.
class Codes {
public:
    explicit Codes(TexelKind kind) {
        const auto value = [&](float code) {
            return kind == TexelKind::color ? kernels::decodeSrgb(code / 255) : code / 255;
        };
        for (int code = 0; code < 256; ++code) {
            m_values[std::size_t(code)] = value(float(code));
            m_upTo[std::size_t(code)] = value(float(code) + 0.5f);
        }
        for (int cell = 0; cell < kCells; ++cell) {
            const auto above = std::upper_bound(m_upTo.begin(), m_upTo.end() - 1, float(cell) / kCells);
            m_first[std::size_t(cell)] = std::uint8_t(above - m_upTo.begin());
        }
    }
    float value(std::uint8_t code) const { return m_values[code]; }
    std::uint8_t nearest(float value) const {
        std::uint8_t code = m_first[std::min(std::size_t(value * kCells), std::size_t(kCells) - 1)];
        while (code < 255 && m_upTo[code] <= value) ++code;
        return code;
    }

private:
    static constexpr int kCells = 4096;  // about the resolution of dark codes
    std::array<float, 256> m_values{}, m_upTo{};
    std::array<std::uint8_t, kCells> m_first{};  // of the values from where the cell begins
};

// Averages all four channels independently: look-ups of colour do not weight by alpha, so neither may the mean.
void halve(const std::uint8_t* from, int width, int height, std::uint8_t* to, const Codes& codes) {
    const std::vector<Cover> columns = covers(width), rows = covers(height);
    for (const Cover& row : rows)
        for (const Cover& column : columns) {
            std::array<float, 4> mean{};
            for (int y = 0; y < row.count; ++y)
                for (int x = 0; x < column.count; ++x) {
                    const std::uint8_t* texel =
                        from + 4 * (std::size_t(row.first + y) * std::size_t(width) + std::size_t(column.first + x));
                    const float share = row.shares[y] * column.shares[x];
                    for (std::size_t c = 0; c < 4; ++c) mean[c] += share * codes.value(texel[c]);
                }
            for (std::size_t c = 0; c < 4; ++c) *to++ = codes.nearest(mean[c]);
        }
}

}  // namespace

std::vector<std::uint8_t> makeMips(const TextureImage& image, TexelKind kind) {
    const int levels = kernels::mipLevels(image.width, image.height);
    std::vector<std::uint8_t> mips(4 * std::size_t(kernels::mipOffset(image.width, image.height, levels)));
    const std::uint8_t* from = image.rgba.data();
    const Codes codes(kind);
    for (int level = 1; level < levels; ++level) {
        std::uint8_t* to = mips.data() + 4 * std::size_t(kernels::mipOffset(image.width, image.height, level));
        halve(from, kernels::mipSize(image.width, level - 1), kernels::mipSize(image.height, level - 1), to, codes);
        from = to;
    }
    return mips;
}

MipMaps::MipMaps(const Context& context, const Scene& scene) {
    const auto use = [&](const TextureRef& ref, TexelKind kind) {
        if (ref.image >= 0) m_levels.try_emplace({ref.image, kind});
    };
    for (const Material& material : scene.materials) {
        use(material.baseColorTexture, TexelKind::color);
        use(material.emissiveTexture, TexelKind::color);
        use(material.metallicRoughnessTexture, TexelKind::data);
        use(material.normalTexture, TexelKind::data);
    }
    std::vector<std::pair<const std::pair<int, TexelKind>, std::vector<std::uint8_t>>*> jobs;
    for (auto& entry : m_levels) jobs.push_back(&entry);
    parallelFor(context, jobs.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            jobs[i]->second = makeMips(scene.images[std::size_t(jobs[i]->first.first)], jobs[i]->first.second);
    });
}

std::span<const std::uint8_t> MipMaps::of(int image, TexelKind kind) const noexcept {
    const auto found = m_levels.find({image, kind});
    return found == m_levels.end() ? std::span<const std::uint8_t>() : found->second;
}

}  // namespace probegi

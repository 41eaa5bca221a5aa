#include "compare/light_ratio.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace probegi {

namespace {

constexpr int kBlocksAcross = 8;
constexpr int kBlocksDown = 5;
// Of the mean luminance: a block of the reference below it is black, and a ratio to it means nothing.
constexpr double kBlack = 1e-6;

// Rec.709.
double luminance(glm::vec3 rgb) {
    return 0.2126 * rgb.x + 0.7152 * rgb.y + 0.0722 * rgb.z;
}

struct Light {
    double test = 0;
    double reference = 0;
    double pixels = 0;
};

// Small pictures have fewer blocks: none is empty.
std::vector<Light> blocksOf(const HdrImage& test, const HdrImage& reference) {
    const int across = std::min(kBlocksAcross, test.width), down = std::min(kBlocksDown, test.height);
    std::vector<Light> blocks(std::size_t(across) * std::size_t(down));
    for (int y = 0; y < test.height; ++y)
        for (int x = 0; x < test.width; ++x) {
            const auto column = std::int64_t(x) * across / test.width, row = std::int64_t(y) * down / test.height;
            Light& block = blocks[std::size_t(column + across * row)];
            block.test += luminance(test.at(x, y));
            block.reference += luminance(reference.at(x, y));
            ++block.pixels;
        }
    return blocks;
}

double percentile(const std::vector<double>& sorted, double share) {
    const double position = share * double(sorted.size() - 1);
    const auto below = std::size_t(position);
    return std::lerp(sorted[below], sorted[std::min(below + 1, sorted.size() - 1)], position - double(below));
}

}  // namespace

LightRatio lightRatio(const HdrImage& test, const HdrImage& reference) {
    const std::vector<Light> blocks = blocksOf(test, reference);
    Light whole;
    for (const Light& block : blocks) {
        whole.test += block.test;
        whole.reference += block.reference;
        whole.pixels += block.pixels;
    }
    if (!(whole.reference > 0)) return {};
    const double black = kBlack * whole.reference / whole.pixels;
    std::vector<double> ratios;
    for (const Light& block : blocks)
        if (block.reference > black * block.pixels) ratios.push_back(block.test / block.reference);
    std::sort(ratios.begin(), ratios.end());
    return {whole.test / whole.reference, percentile(ratios, 0.05), percentile(ratios, 0.5), percentile(ratios, 0.95),
            int(ratios.size())};
}

}  // namespace probegi

#include "measure/light_ratio.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "measure/luminance.h"

namespace probegi {

namespace {

constexpr int kBlocksAcross = 8;
constexpr int kBlocksDown = 5;
// Of the mean luminance: a block of the reference below it is black, and a ratio to it means nothing.
constexpr double kBlack = 1e-6;

struct BlockLight {
    double test = 0;
    double reference = 0;
    double pixels = 0;
};

// Small pictures have fewer blocks: none is empty.
std::vector<BlockLight> blocksOf(const HdrImage& test, const HdrImage& reference) {
    const int across = std::min(kBlocksAcross, test.width), down = std::min(kBlocksDown, test.height);
    std::vector<BlockLight> blocks(std::size_t(across) * std::size_t(down));
    for (int y = 0; y < test.height; ++y)
        for (int x = 0; x < test.width; ++x) {
            const auto column = std::int64_t(x) * across / test.width, row = std::int64_t(y) * down / test.height;
            BlockLight& block = blocks[std::size_t(column + across * row)];
            block.test += luminance(test.at(x, y));
            block.reference += luminance(reference.at(x, y));
            ++block.pixels;
        }
    return blocks;
}

}  // namespace

LightRatio lightRatio(const HdrImage& test, const HdrImage& reference) {
    const std::vector<BlockLight> blocks = blocksOf(test, reference);
    BlockLight whole;
    for (const BlockLight& block : blocks) {
        whole.test += block.test;
        whole.reference += block.reference;
        whole.pixels += block.pixels;
    }
    if (!(whole.reference > 0)) return {};
    const double black = kBlack * whole.reference / whole.pixels;
    std::vector<double> ratios;
    for (const BlockLight& block : blocks)
        if (block.reference > black * block.pixels) ratios.push_back(block.test / block.reference);
    const int count = int(ratios.size());
    const Percentiles p = percentiles(std::move(ratios));
    return {whole.test / whole.reference, p.low, p.median, p.high, count};
}

}  // namespace probegi

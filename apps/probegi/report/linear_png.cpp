#include "report/linear_png.h"

#include <algorithm>
#include <cstdint>
#include <glm/gtc/packing.hpp>

#include "probegi/measure.h"

namespace probegi::tool {

namespace {

constexpr float kLargest = 65504;
constexpr std::uint32_t kDropped = 3;  // of ten bits of mantissa; rounded, not truncated
constexpr std::uint32_t kInfinity = 0x7c00;

std::uint32_t shortHalf(float value) {
    if (!(value > 0)) return 0;
    const std::uint32_t bits = glm::packHalf1x16(std::min(value, kLargest));
    const std::uint32_t rounded = (bits + (1u << (kDropped - 1))) >> kDropped << kDropped;
    return std::min(rounded, kInfinity - (1u << kDropped));
}

}  // namespace

HdrImage halfFloatPlanes(const HdrImage& image) {
    HdrImage codes(image.width, 2 * image.height);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < 3; ++c) {
                const std::uint32_t half = shortHalf(image.at(x, y)[c]);
                codes.at(x, y)[c] = float(half >> 8) / 255.0f;
                codes.at(x, y + image.height)[c] = float(half & 255u) / 255.0f;
            }
    return linearFromDisplay(codes);
}

}  // namespace probegi::tool

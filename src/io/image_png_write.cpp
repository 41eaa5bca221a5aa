#include <png.h>

#include <algorithm>
#include <climits>

#include "io/image_codec.h"
#include "io/refused.h"
#include "kernels/screen/tone_map.h"

namespace probegi::io {

namespace {

std::vector<std::uint8_t> codesOf(const HdrImage& image, const ToneMap& toneMap) {
    std::vector<std::uint8_t> codes;
    codes.reserve(3 * image.pixels.size());
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const glm::uvec3 code = kernels::displayCodes(toDisplay(image.at(x, y), toneMap), toneMap.dither, x, y);
            for (int c = 0; c < 3; ++c) codes.push_back(std::uint8_t(code[c]));
        }
    return codes;
}

}  // namespace

std::vector<std::uint8_t> encodePng(const HdrImage& image, const ToneMap& toneMap) {
    constexpr int kWidest = 1000000;  // libpng's own limit
    if (std::max(image.width, image.height) > kWidest || 3 * image.pixels.size() + std::size_t(image.height) > INT_MAX)
        refuse(ErrorCode::invalidArgument, "a PNG of {} x {} pixels is too large; write .exr", image.width,
               image.height);
    const std::vector<std::uint8_t> codes = codesOf(image, toneMap);
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    png.width = png_uint_32(image.width);
    png.height = png_uint_32(image.height);
    png.format = PNG_FORMAT_RGB;
    std::vector<std::uint8_t> bytes(PNG_IMAGE_PNG_SIZE_MAX(png));
    png_alloc_size_t size = bytes.size();
    if (!png_image_write_to_memory(&png, bytes.data(), &size, 0, codes.data(), 0, nullptr))
        refuse(ErrorCode::outOfMemory, "the PNG of {} x {} pixels cannot be encoded ({})", image.width, image.height,
               static_cast<const char*>(png.message));
    bytes.resize(size);
    return bytes;
}

}  // namespace probegi::io

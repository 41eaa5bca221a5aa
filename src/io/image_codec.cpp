#include "io/image_codec.h"

#include <algorithm>

#include "io/budget.h"

namespace probegi::io {

namespace {

bool beginsWith(std::span<const std::uint8_t> bytes, std::initializer_list<std::uint8_t> magic) {
    return bytes.size() >= magic.size() && std::equal(magic.begin(), magic.end(), bytes.begin());
}
bool isPng(std::span<const std::uint8_t> bytes) {
    return beginsWith(bytes, {0x89, 'P', 'N', 'G'});
}
bool isJpeg(std::span<const std::uint8_t> bytes) {
    return beginsWith(bytes, {0xff, 0xd8, 0xff});
}

}  // namespace

HdrImage decodeImage(std::span<const std::uint8_t> bytes, ImageFormat format, const ReadLimits& limits) {
    if (bytes.empty()) refuseMalformed("is empty");
    switch (format) {
        case ImageFormat::exr:
            return decodeExr(bytes, limits);
        case ImageFormat::hdr:
            if (!beginsWith(bytes, {'#', '?'})) refuseMalformed("is not a Radiance .hdr picture");
            return decodeHdr(bytes, limits);
        case ImageFormat::png:
            if (!isPng(bytes)) refuseMalformed("is not a PNG picture");
            return decodePng(bytes, limits);
        case ImageFormat::jpeg:
            break;
    }
    if (!isJpeg(bytes)) refuseMalformed("is not a JPEG picture");
    return decodeJpeg(bytes, limits);
}

std::uint64_t texturePixels(std::span<const std::uint8_t> bytes) {
    if (isPng(bytes)) return pngPixels(bytes);
    if (isJpeg(bytes)) return jpegPixels(bytes);
    refuse(ErrorCode::unsupported, "is neither PNG nor JPEG; convert it to one");
}

TextureImage decodeTexture(std::span<const std::uint8_t> bytes) {
    if (isPng(bytes)) return decodePngTexture(bytes);
    if (isJpeg(bytes)) return decodeJpegTexture(bytes);
    refuse(ErrorCode::unsupported, "is neither PNG nor JPEG; convert it to one");
}

void checkImageSize(std::int64_t width, std::int64_t height, std::size_t fileBytes) {
    constexpr std::int64_t kMaxSide = 65536;
    constexpr std::int64_t kMaxPixels = std::int64_t(1) << 28;
    constexpr std::int64_t kMaxPixelsPerByte = 16384;
    if (width < 1 || height < 1) refuseMalformed("the picture's size of {} x {} is invalid", width, height);
    if (width > kMaxSide || height > kMaxSide || width * height > kMaxPixels) {
        refuse(ErrorCode::outOfMemory,
               "the picture has {} x {} pixels; at most {} per side and 2^28 in total are supported", width, height,
               kMaxSide);
    }
    if (width * height / kMaxPixelsPerByte > std::int64_t(fileBytes)) {
        refuseMalformed("claims {} x {} pixels in {} bytes, more than any compression allows", width, height,
                        fileBytes);
    }
}

HdrImage emptyImage(int width, int height, std::size_t fileBytes, const ReadLimits& limits) {
    HdrImage image;
    image.width = width;
    image.height = height;
    const std::size_t pixels = std::size_t(width) * std::size_t(height);
    Budget(limits, fileBytes).charge(pixels * sizeof(glm::vec3));
    image.pixels.reserve(pixels);
    return image;
}

}  // namespace probegi::io

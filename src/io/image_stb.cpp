#include <algorithm>
#include <array>
#include <climits>
#include <cmath>
#include <memory>

#include "io/image_codec.h"
#include "io/refused.h"
#include "io/srgb.h"
#include "io/stb.h"

namespace probegi::io {

namespace {

struct FreeStb {
    void operator()(void* pixels) const { stbi_image_free(pixels); }
};
template <class T>
using StbPixels = std::unique_ptr<T[], FreeStb>;

using Bytes = std::span<const std::uint8_t>;

bool beginsWith(Bytes bytes, std::initializer_list<std::uint8_t> magic) {
    return bytes.size() >= magic.size() && std::equal(magic.begin(), magic.end(), bytes.begin());
}
bool isPng(Bytes bytes) {
    return beginsWith(bytes, {0x89, 'P', 'N', 'G'});
}
bool isJpeg(Bytes bytes) {
    return beginsWith(bytes, {0xff, 0xd8, 0xff});
}

[[noreturn]] void refuseDamaged(const char* format) {
    const char* reason = stbi_failure_reason();
    refuseMalformed("is not a readable {} ({}); save it again", format, reason ? reason : "damaged");
}

/// A progressive JPEG visits the whole picture once a scan, so thousands of tiny scans take hours. Real ones have ten.
void checkScans(Bytes bytes) {
    constexpr int kMaxScans = 100;
    constexpr std::array<std::uint8_t, 2> kStartOfScan{0xff, 0xda};
    int scans = 0;
    for (auto at = bytes.begin();; at += 2, ++scans) {
        at = std::search(at, bytes.end(), kStartOfScan.begin(), kStartOfScan.end());
        if (at == bytes.end()) break;
    }
    if (scans > kMaxScans) refuseMalformed("the JPEG has {} scans; at most {} are supported", scans, kMaxScans);
}

struct Size {
    int width = 0;
    int height = 0;
};

Size checkedSize(Bytes bytes, const char* format) {
    if (bytes.empty()) refuseMalformed("is empty");
    if (bytes.size() > INT_MAX) refuse(ErrorCode::outOfMemory, "a picture file of over 2 GiB is not supported");
    Size size;
    int channels = 0;
    if (!stbi_info_from_memory(bytes.data(), int(bytes.size()), &size.width, &size.height, &channels)) {
        refuseDamaged(format);
    }
    checkImageSize(size.width, size.height, bytes.size());
    if (isJpeg(bytes)) checkScans(bytes);
    return size;
}

HdrImage decodeRadiance(Bytes bytes) {
    if (!beginsWith(bytes, {'#', '?'})) refuseMalformed("is not a Radiance .hdr picture");
    Size size = checkedSize(bytes, "Radiance .hdr");
    int channels = 0;
    const StbPixels<float> pixels(
        stbi_loadf_from_memory(bytes.data(), int(bytes.size()), &size.width, &size.height, &channels, 3));
    if (!pixels) refuseDamaged("Radiance .hdr");
    HdrImage image(size.width, size.height);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        image.pixels[i] = {pixels[3 * i], pixels[3 * i + 1], pixels[3 * i + 2]};
    }
    return image;
}

/// Read as 16 bits a channel, which loses nothing of either depth.
HdrImage decodeDisplayReferred(Bytes bytes, const char* format) {
    Size size = checkedSize(bytes, format);
    int channels = 0;
    const StbPixels<stbi_us> pixels(
        stbi_load_16_from_memory(bytes.data(), int(bytes.size()), &size.width, &size.height, &channels, 3));
    if (!pixels) refuseDamaged(format);
    std::vector<float> linear(65536);
    for (std::size_t code = 0; code < linear.size(); ++code) linear[code] = decodeSrgb(float(code) / 65535.0f);
    HdrImage image(size.width, size.height);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        image.pixels[i] = {linear[pixels[3 * i]], linear[pixels[3 * i + 1]], linear[pixels[3 * i + 2]]};
    }
    return image;
}

void appendBytes(void* context, void* data, int size) {
    const auto* bytes = static_cast<const std::uint8_t*>(data);
    auto& out = *static_cast<std::vector<std::uint8_t>*>(context);
    out.insert(out.end(), bytes, bytes + size);
}

}  // namespace

HdrImage decodeImage(Bytes bytes, ImageFormat format) {
    switch (format) {
        case ImageFormat::exr:
            return decodeExr(bytes);
        case ImageFormat::hdr:
            return decodeRadiance(bytes);
        case ImageFormat::png:
            if (!isPng(bytes)) refuseMalformed("is not a PNG picture");
            return decodeDisplayReferred(bytes, "PNG");
        case ImageFormat::jpeg:
            break;
    }
    if (!isJpeg(bytes)) refuseMalformed("is not a JPEG picture");
    return decodeDisplayReferred(bytes, "JPEG");
}

std::uint64_t texturePixels(Bytes bytes) {
    if (!isPng(bytes) && !isJpeg(bytes)) refuse(ErrorCode::unsupported, "is neither PNG nor JPEG; convert it to one");
    const Size size = checkedSize(bytes, isPng(bytes) ? "PNG" : "JPEG");
    return std::uint64_t(size.width) * std::uint64_t(size.height);
}

TextureImage decodeTexture(Bytes bytes) {
    texturePixels(bytes);
    TextureImage image;
    int channels = 0;
    const StbPixels<stbi_uc> pixels(
        stbi_load_from_memory(bytes.data(), int(bytes.size()), &image.width, &image.height, &channels, 4));
    if (!pixels) refuseDamaged(isPng(bytes) ? "PNG" : "JPEG");
    image.rgba.assign(pixels.get(), pixels.get() + 4 * std::size_t(image.width) * std::size_t(image.height));
    return image;
}

std::vector<std::uint8_t> encodePng(const HdrImage& image, const ToneMap& toneMap) {
    if (3 * image.pixels.size() + std::size_t(image.height) > INT_MAX) {
        refuse(ErrorCode::invalidArgument, "a PNG of {} x {} pixels is too large; write .exr", image.width,
               image.height);
    }
    std::vector<std::uint8_t> codes;
    codes.reserve(3 * image.pixels.size());
    for (const glm::vec3& pixel : image.pixels) {
        const glm::vec3 display = toDisplay(pixel, toneMap);
        for (int c = 0; c < 3; ++c) codes.push_back(std::uint8_t(std::lround(255.0f * display[c])));
    }
    std::vector<std::uint8_t> bytes;
    if (!stbi_write_png_to_func(appendBytes, &bytes, image.width, image.height, 3, codes.data(), 3 * image.width)) {
        refuse(ErrorCode::outOfMemory, "the PNG of {} x {} pixels cannot be encoded", image.width, image.height);
    }
    return bytes;
}

}  // namespace probegi::io

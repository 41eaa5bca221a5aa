#include <algorithm>
#include <cctype>
#include <optional>

#include "io/file_bytes.h"
#include "io/file_output.h"
#include "io/image_codec.h"
#include "io/refused.h"
#include "probegi/image.h"

namespace probegi {

using namespace io;

namespace {

std::string lowerExtension(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return char(std::tolower(c)); });
    return extension;
}

ImageFormat formatToRead(const std::filesystem::path& path) {
    const std::string extension = lowerExtension(path);
    if (extension == ".exr") return ImageFormat::exr;
    if (extension == ".hdr") return ImageFormat::hdr;
    if (extension == ".png") return ImageFormat::png;
    if (extension == ".jpg" || extension == ".jpeg") return ImageFormat::jpeg;
    refuse(ErrorCode::unsupported, "pictures are read from .exr, .hdr, .png and .jpg, not from '{}'", extension);
}

void checkToneMap(const ToneMap& toneMap) {
    if (!(toneMap.exposure > 0) || toneMap.exposure > 1e30f) {
        refuse(ErrorCode::invalidArgument, "the exposure {} must be positive and finite", toneMap.exposure);
    }
}

}  // namespace

Result<HdrImage> readImage(const std::filesystem::path& path, const ReadLimits& limits) {
    return guarded(path.string(), [&] {
        const ImageFormat format = formatToRead(path);
        return decodeImage(readFile(path), format, limits);
    });
}

Result<void> writeImage(const std::filesystem::path& path, const HdrImage& image, const ToneMap& toneMap) {
    return guarded(path.string(), [&] {
        if (image.width < 1 || image.height < 1 || image.width > 65536 || image.height > 65536 ||
            image.pixels.size() != std::size_t(image.width) * std::size_t(image.height)) {
            refuse(ErrorCode::invalidArgument, "a picture of {} x {} with {} pixels cannot be written", image.width,
                   image.height, image.pixels.size());
        }
        const std::string extension = lowerExtension(path);
        if (extension == ".exr") return writeBytes(path, encodeExr(image));
        if (extension != ".png") {
            refuse(ErrorCode::unsupported, "pictures are written as .exr or .png, not as '{}'", extension);
        }
        checkToneMap(toneMap);
        writeBytes(path, encodePng(image, toneMap));
    });
}

}  // namespace probegi

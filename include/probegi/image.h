#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "probegi/context.h"
#include "probegi/export.h"
#include "probegi/result.h"

namespace probegi {

/// Linear Rec.709 picture, row-major, top row first.
struct HdrImage {
    int width = 0;                  ///< pixels
    int height = 0;                 ///< pixels
    std::vector<glm::vec3> pixels;  ///< width * height values

    HdrImage() = default;
    HdrImage(int w, int h, glm::vec3 fill = glm::vec3(0)) : width(w), height(h), pixels(std::size_t(w) * h, fill) {}
    glm::vec3& at(int x, int y) { return pixels[std::size_t(y) * width + x]; }
    const glm::vec3& at(int x, int y) const { return pixels[std::size_t(y) * width + x]; }
};

/// How scene-referred values become 8-bit display values.
struct ToneMap {
    float exposure = 1.0f;  ///< factor on the linear value before the curve; > 0
    bool filmic = false;    ///< false: clip at 1 (measurement); true: a smooth shoulder (handsome pictures)
    bool dither = true;  ///< 8-bit files: neighbouring pixels are rounded up and down in turn, so that slow gradients
                         ///< show no bands; what an 8-bit step holds exactly stays as it is
};

/// Display-referred value in 0..1 of a linear one: exposure, curve, sRGB transfer function.
PROBEGI_API glm::vec3 toDisplay(glm::vec3 linear, const ToneMap& toneMap);

/// The exposure at which a picture is neither too dark nor too bright: the geometric mean of its luminance, without its
/// darkest tenth and its brightest twentieth, becomes middle grey (0.18 before the curve). A factor on the picture
/// divides the exposure. 1 where nothing shines. What is below a thousandth of the brightest counts as black.
PROBEGI_API float autoExposure(const HdrImage& image);

/// How much memory a file may fill: small ones can claim any amount. Whatever it unpacks to within 64 times its own
/// size is always allowed.
struct ReadLimits {
    /// What pixels may fill beyond that, MB (2^20 bytes); 1 to 2^20. Geometry and text, of which more is made later,
    /// may fill a sixteenth of it.
    std::uint64_t megabytes = 1024;
    /// What the sentence of an error calls this limit; a program with an option for it gives the option's name.
    std::string name = "ReadLimits::megabytes";
};

/// Reads .exr, .hdr, .png or .jpg (the 8-bit ones are decoded from sRGB to linear).
/// Errors: fileNotFound, fileUnreadable, malformed, unsupported (extension), outOfMemory (over 2^28 pixels, or over the
/// limits).
PROBEGI_API Result<HdrImage> readImage(const std::filesystem::path& path, const ReadLimits& limits = {});

/// Writes .exr (float, linear, no tone map) or .png (8-bit sRGB through toneMap), by extension, as writeFile() does.
/// Errors: unsupported (extension), writeFailed, invalidArgument.
PROBEGI_API Result<void> writeImage(const std::filesystem::path& path, const HdrImage& image,
                                    const ToneMap& toneMap = {});

}  // namespace probegi

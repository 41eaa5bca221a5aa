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
    bool filmic = false;    ///< false: clip at 1 (for measurement); true: a smooth shoulder (for viewing)
    bool dither = true;     ///< 8-bit output: ordered dithering against banding; values that 8 bits hold exactly are
                            ///< unchanged
};

/// Converts a linear value to a display-referred one in 0..1: exposure, curve, sRGB transfer function.
PROBEGI_API glm::vec3 toDisplay(glm::vec3 linear, const ToneMap& toneMap);

/// The exposure that maps the geometric mean of the luminance, without the darkest 10 % and the brightest 5 %, to
/// middle grey (0.18 before the curve). Scaling the picture divides the exposure. Pixels below a thousandth of the
/// brightest count as black. 1 for a black picture.
PROBEGI_API float autoExposure(const HdrImage& image);

/// How much memory reading a file may use, since even a small file can claim any amount. Unpacking to up to 64 times
/// the file's size is always allowed.
struct ReadLimits {
    /// Limit for pixels beyond that, MB (2^20 bytes); 1 to 2^20. Geometry and text, which are expanded later, may use a
    /// sixteenth of it.
    std::uint64_t megabytes = 1024;
    /// What error messages call this limit; a program with an option for it gives the option's name.
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

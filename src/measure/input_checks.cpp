#include "measure/input_checks.h"

#include <cmath>

namespace probegi {

Result<void> checkPicture(const HdrImage& image, const char* which) {
    if (image.width < 1 || image.height < 1 || image.pixels.size() != std::size_t(image.width) * image.height)
        return fail(ErrorCode::invalidArgument, sentence("The ", which, " picture is empty: give one with pixels."));
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const glm::vec3 v = image.pixels[i];
        if (std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z)) continue;
        return fail(
            ErrorCode::invalidArgument,
            sentence("The ", which, " picture has a value that is not finite at pixel (", i % std::size_t(image.width),
                     ", ", i / std::size_t(image.width), "): it cannot be compared; render it again."));
    }
    return {};
}

Result<void> checkSameSize(const HdrImage& a, const HdrImage& b) {
    if (a.width == b.width && a.height == b.height) return {};
    return fail(ErrorCode::invalidArgument, sentence("The pictures differ in size (", a.width, "x", a.height, " and ",
                                                     b.width, "x", b.height, "): render both at the same --size."));
}

Result<void> checkExposure(float exposure) {
    if (exposure > 0 && std::isfinite(exposure)) return {};
    return fail(ErrorCode::invalidArgument, sentence("The exposure is ", exposure, ": give a number above 0."));
}

Result<void> checkSameCount(const char* what, std::size_t count, std::size_t expected) {
    if (count == expected) return {};
    return fail(ErrorCode::invalidArgument,
                sentence(what, " has ", count, " values where there must be ", expected, ": give one for each point."));
}

}  // namespace probegi

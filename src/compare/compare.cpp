#include "probegi/compare.h"

#include <cmath>
#include <new>

#include "compare/flip.h"
#include "compare/light_ratio.h"
#include "core/sentence.h"

namespace probegi {

namespace {

Result<void> check(const HdrImage& image, const char* which) {
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

HdrImage displayed(const HdrImage& image, const ToneMap& toneMap) {
    HdrImage out(image.width, image.height);
    for (std::size_t i = 0; i < out.pixels.size(); ++i) out.pixels[i] = toDisplay(image.pixels[i], toneMap);
    return out;
}

double squaredDistance(glm::vec3 a, glm::vec3 b) {
    const double x = double(a.x) - b.x;
    const double y = double(a.y) - b.y;
    const double z = double(a.z) - b.z;
    return x * x + y * y + z * z;
}

/// The constant of relMSE: it keeps black pixels of the reference from dominating.
constexpr double kRelmseConstant = 0.01;

/// Mean over pixels and channels of the squared error over reference^2 + `constant`.
double relmse(const HdrImage& test, const HdrImage& reference, double constant) {
    double total = 0;
    for (std::size_t i = 0; i < test.pixels.size(); ++i)
        for (int channel = 0; channel < 3; ++channel) {
            const double r = reference.pixels[i][channel];
            const double d = test.pixels[i][channel] - r;
            if (d != 0) total += d * d / (r * r + constant);
        }
    return total / double(3 * test.pixels.size());
}

double meanOf(const HdrImage& image) {
    double total = 0;
    for (const glm::vec3& pixel : image.pixels) total += double(pixel.x) + pixel.y + pixel.z;
    return total / double(3 * image.pixels.size());
}

Comparison compareChecked(const HdrImage& test, const HdrImage& reference, const ToneMap& toneMap) {
    const HdrImage shownTest = displayed(test, toneMap);
    const HdrImage shownReference = displayed(reference, toneMap);
    const Plane flip = flip::differenceMap(shownTest, shownReference);

    Comparison out{{}, HdrImage(test.width, test.height), HdrImage(test.width, test.height)};
    double squares = 0;
    double flipTotal = 0;
    for (std::size_t i = 0; i < flip.values.size(); ++i) {
        // Mask paper, section 4.2: E(x) per pixel, and E_RMSE as the root of the mean of its square.
        const double square = squaredDistance(shownTest.pixels[i], shownReference.pixels[i]) / 3;
        squares += square;
        flipTotal += flip.values[i];
        out.rmseMap.pixels[i] = glm::vec3(float(std::sqrt(square)));
        out.flipMap.pixels[i] = glm::vec3(flip.values[i]);
    }
    const double count = double(flip.values.size());
    const double mean = meanOf(reference);
    // A black reference has no scale of its own.
    const double scaled = mean > 0 ? kRelmseConstant * mean * mean : kRelmseConstant;
    out.difference = {std::sqrt(squares / count), relmse(test, reference, kRelmseConstant),
                      relmse(test, reference, scaled), flipTotal / count, lightRatio(test, reference)};
    return out;
}

}  // namespace

Result<Comparison> compareImages(const HdrImage& test, const HdrImage& reference, const ToneMap& toneMap) {
    if (auto ok = check(test, "test"); !ok) return ok.error();
    if (auto ok = check(reference, "reference"); !ok) return ok.error();
    if (test.width != reference.width || test.height != reference.height)
        return fail(ErrorCode::invalidArgument,
                    sentence("The pictures differ in size (", test.width, "x", test.height, " and ", reference.width,
                             "x", reference.height, "): render both at the same --size."));
    if (!(toneMap.exposure > 0) || !std::isfinite(toneMap.exposure))
        return fail(ErrorCode::invalidArgument,
                    sentence("The exposure is ", toneMap.exposure, ": give a number above 0."));
    try {
        return compareChecked(test, reference, toneMap);
    } catch (const std::bad_alloc&) {
        return fail(ErrorCode::outOfMemory,
                    sentence("Not enough memory to compare pictures of ", test.width, "x", test.height, " pixels."));
    }
}

}  // namespace probegi

#include <cmath>

#include "measure/flip.h"
#include "measure/input_checks.h"
#include "measure/light_ratio.h"

namespace probegi {

namespace {

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
    if (auto ok = checkPicture(test, "test"); !ok) return ok.error();
    if (auto ok = checkPicture(reference, "reference"); !ok) return ok.error();
    if (auto ok = checkSameSize(test, reference); !ok) return ok.error();
    if (auto ok = checkExposure(toneMap.exposure); !ok) return ok.error();
    return withinMemory("compare the pictures",
                        [&]() -> Result<Comparison> { return compareChecked(test, reference, toneMap); });
}

}  // namespace probegi

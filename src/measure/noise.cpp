#include <glm/common.hpp>
#include <random>

#include "measure/input_checks.h"
#include "probegi/measure.h"

namespace probegi {

namespace {

Result<void> check(const HdrImage& picture, const HdrImage& standardError) {
    if (auto ok = checkPicture(picture, "reference"); !ok) return ok;
    if (auto ok = checkPicture(standardError, "standard error's"); !ok) return ok;
    return checkSameSize(picture, standardError);
}

}  // namespace

Result<Comparison> noiseFloor(const HdrImage& reference, const HdrImage& standardError, std::uint64_t seed,
                              const ToneMap& toneMap) {
    if (auto ok = check(reference, standardError); !ok) return ok.error();
    return withinMemory("measure the reference's noise", [&] {
        std::mt19937_64 random(seed);
        std::normal_distribution<float> normal;
        HdrImage twin = reference;
        for (std::size_t i = 0; i < twin.pixels.size(); ++i)
            twin.pixels[i] = glm::max(twin.pixels[i] + standardError.pixels[i] * normal(random), 0.0f);
        return compareImages(twin, reference, toneMap);
    });
}

Result<double> relativeNoise(const HdrImage& picture, const HdrImage& standardError) {
    if (auto ok = check(picture, standardError); !ok) return ok.error();
    double error = 0;
    double value = 0;
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
        const glm::vec3 e = standardError.pixels[i];
        const glm::vec3 v = picture.pixels[i];
        error += double(e.x) + e.y + e.z;
        value += double(v.x) + v.y + v.z;
    }
    return value > 0 ? error / value : 0;
}

}  // namespace probegi

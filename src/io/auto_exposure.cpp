#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "kernels/screen/colour.h"
#include "probegi/image.h"

namespace probegi {

namespace {

constexpr float kMiddleGrey = 0.18f;
// Excluded from the mean: unlit corners, and lamps and sky.
constexpr float kBlackStops = 10;  // below the brightest: practically black, such as the void around a model
constexpr double kDarkest = 0.10, kBrightest = 0.05;

/// Base-2 logarithms of all positive luminances.
std::vector<float> logLuminances(const HdrImage& image) {
    std::vector<float> logs;
    logs.reserve(image.pixels.size());
    for (const glm::vec3& pixel : image.pixels) {
        const float y = kernels::luminance(pixel);
        if (y > 1e-30f && y < 1e30f) logs.push_back(std::log2(y));
    }
    return logs;
}

}  // namespace

float autoExposure(const HdrImage& image) {
    std::vector<float> logs = logLuminances(image);
    if (logs.empty()) return 1.0f;
    std::sort(logs.begin(), logs.end());
    const float bright = logs[std::size_t((1 - kBrightest) * double(logs.size() - 1))];
    logs.erase(logs.begin(), std::lower_bound(logs.begin(), logs.end(), bright - kBlackStops));
    // Shares are of all pixels; the black ones, the darkest, are already removed.
    const std::size_t pixels = image.pixels.size(), black = pixels - logs.size();
    const std::size_t darkest = std::size_t(kDarkest * double(pixels)),
                      brightest = std::size_t(kBrightest * double(pixels));
    auto first = logs.begin() + std::ptrdiff_t(std::min(darkest - std::min(darkest, black), logs.size() - 1));
    auto last = logs.end() - std::ptrdiff_t(std::min(brightest, std::size_t(logs.end() - first) - 1));
    const double mean = std::accumulate(first, last, 0.0) / double(last - first);
    return kMiddleGrey * float(std::exp2(-mean));
}

}  // namespace probegi

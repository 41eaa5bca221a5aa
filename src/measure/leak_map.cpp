#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <utility>

#include "measure/input_checks.h"
#include "measure/luminance.h"
#include "probegi/measure.h"

namespace probegi {

namespace {

constexpr int kTilesAcross = 60;
constexpr int kSmallestTile = 8;   // pixels
constexpr double kSigmas = 4;      // of the reference's noise
constexpr double kVisible = 0.04;  // of display values

/// Means over one tile.
struct Tile {
    double color = 0, indirect = 0, truth = 0, error = 0;

    double ratio() const { return std::min(indirect / std::max(truth, 1e-12), kLargestRatio); }
    bool beyondNoise() const { return std::abs(indirect - truth) > kSigmas * error; }
    /// How far the shown picture is from what it would be with the truth, in display values.
    double visible(float exposure) const {
        const auto display = [&](double value) { return double(toDisplay(glm::vec3(float(value)), {exposure}).x); };
        return std::abs(display(color) - display(color - indirect + truth));
    }
    bool leaks(float exposure) const { return beyondNoise() && ratio() >= kLeakRatio && visible(exposure) > kVisible; }
};

Tile measure(const LeakInputs& in, glm::ivec2 first, glm::ivec2 end) {
    Tile tile;
    double variance = 0;
    for (int y = first.y; y < end.y; ++y)
        for (int x = first.x; x < end.x; ++x) {
            tile.color += luminance(in.color.at(x, y));
            tile.indirect += luminance(in.indirect.at(x, y));
            tile.truth += luminance(in.referenceIndirect.at(x, y));
            const double error = luminance(in.standardError.at(x, y));
            variance += error * error;
        }
    const double pixels = double(end.x - first.x) * (end.y - first.y);
    tile.color /= pixels, tile.indirect /= pixels, tile.truth /= pixels;
    tile.error = std::sqrt(variance) / pixels;
    return tile;
}

/// Red for too much light, blue for too little, the stronger the farther from 1; two stops are all of it. What nobody
/// sees is left grey.
glm::vec3 tinted(glm::vec3 grey, double ratio, double visible, bool leaks) {
    constexpr glm::vec3 kTooMuch(1.0f, 0.25f, 0.1f), kTooLittle(0.2f, 0.45f, 1.0f), kLeak(1.0f, 0.05f, 0.02f);
    if (leaks) return glm::mix(grey, kLeak, 0.85f);
    const float stops = float(std::log2(std::max(ratio, 1.0 / kLargestRatio)));
    const float strength = std::min(std::abs(stops) / 2, 1.0f) * std::min(float(2 * visible / kVisible), 1.0f);
    return glm::mix(grey, stops > 0 ? kTooMuch : kTooLittle, 0.6f * strength);
}

Result<void> check(const LeakInputs& in) {
    if (auto ok = checkExposure(in.exposure); !ok) return ok;
    for (const auto& [picture, name] :
         {std::pair(&in.color, "test"), std::pair(&in.indirect, "indirect test"),
          std::pair(&in.referenceIndirect, "indirect reference"), std::pair(&in.standardError, "standard error's")}) {
        if (auto ok = checkPicture(*picture, name); !ok) return ok;
        if (auto ok = checkSameSize(in.color, *picture); !ok) return ok;
    }
    return {};
}

LeakMap mapOf(const LeakInputs& in) {
    const int width = in.color.width, height = in.color.height;
    const int side = std::max(kSmallestTile, width / kTilesAcross);
    LeakMap map;
    map.picture = HdrImage(width, height);
    map.ratio = HdrImage(width, height, glm::vec3(1));
    for (int top = 0; top < height; top += side)
        for (int left = 0; left < width; left += side) {
            const glm::ivec2 first(left, top), end(std::min(left + side, width), std::min(top + side, height));
            const Tile tile = measure(in, first, end);
            const double ratio = tile.beyondNoise() ? tile.ratio() : 1;
            const bool leaks = tile.leaks(in.exposure);
            const double visible = tile.visible(in.exposure);
            ++map.tiles;
            map.leaks += leaks;
            if (leaks && ratio > map.worst) map.worst = ratio, map.where = (first + end) / 2;
            for (int y = first.y; y < end.y; ++y)
                for (int x = first.x; x < end.x; ++x) {
                    const glm::vec3 shown = toDisplay(in.color.at(x, y), {in.exposure});
                    map.picture.at(x, y) = tinted(glm::vec3(0.5f * float(luminance(shown))), ratio, visible, leaks);
                    map.ratio.at(x, y) = glm::vec3(float(ratio));
                }
        }
    map.picture = linearFromDisplay(map.picture);
    return map;
}

}  // namespace

Result<LeakMap> findLeaks(const LeakInputs& inputs) {
    if (auto ok = check(inputs); !ok) return ok.error();
    return withinMemory("map the leaks", [&]() -> Result<LeakMap> { return mapOf(inputs); });
}

}  // namespace probegi

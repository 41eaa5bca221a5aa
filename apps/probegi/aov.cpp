#include "aov.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <numbers>

#include "console/terminal.h"
#include "probegi/measure.h"

namespace probegi::tool {

namespace {

const HdrImage& layerOf(const Picture& picture, Aov aov) {
    switch (aov) {
        case Aov::irradiance:
            return picture.irradiance;
        case Aov::normal:
            return picture.normal;
        case Aov::albedo:
            return picture.albedo;
        case Aov::depth:
            return picture.depth;
        case Aov::direct:
            return picture.direct;
        case Aov::indirect:
            return picture.indirect;
        case Aov::glossy:
            return picture.glossy;
        case Aov::contact:
            return picture.contact;
        case Aov::openness:
            return picture.openness;
        case Aov::color:
            break;
    }
    return picture.color;
}

HdrImage displayNormals(HdrImage normals) {
    for (glm::vec3& n : normals.pixels) n = glm::clamp(0.5f + 0.5f * n, 0.0f, 1.0f);
    return linearFromDisplay(normals);
}

HdrImage displayDepth(HdrImage depth) {
    float farthest = 0;
    for (const glm::vec3& d : depth.pixels) farthest = std::max(farthest, d.x);
    for (glm::vec3& d : depth.pixels) d = glm::vec3(d.x > 0 && farthest > 0 ? 1.0f - d.x / farthest : 0.0f);
    return linearFromDisplay(depth);
}

// Display value of the brightest channel below which a pixel looks black on most screens.
constexpr float kNearBlack = 0.03f;
constexpr double kMostlyBlack = 0.9;

void warnWhereNearlyBlack(const std::string& path, const HdrImage& layer, const ToneMap& toneMap) {
    const auto dark = std::count_if(layer.pixels.begin(), layer.pixels.end(), [&](const glm::vec3& pixel) {
        const glm::vec3 display = toDisplay(pixel, toneMap);
        return std::max({display.x, display.y, display.z}) < kNearBlack;
    });
    const double share = double(dark) / double(layer.pixels.size());
    if (share < kMostlyBlack) return;
    printWarning(
        fmt::format("{:.0f} % of '{}' is nearly black at exposure {:.3g}; raise --exposure, or move the camera with "
                    "--camera or --look-from: it may be inside a wall or where no light arrives",
                    std::floor(100 * share), path, toneMap.exposure));
}

HdrImage asWhiteSurface(HdrImage irradiance) {
    for (glm::vec3& e : irradiance.pixels) e *= std::numbers::inv_pi_v<float>;
    return irradiance;
}

}  // namespace

bool isLight(Aov aov) {
    return aov == Aov::color || aov == Aov::direct || aov == Aov::indirect || aov == Aov::irradiance ||
           aov == Aov::glossy || aov == Aov::contact;
}

HdrImage shownLayer(const Picture& picture, Aov aov) {
    const HdrImage& layer = layerOf(picture, aov);
    if (aov == Aov::normal) return displayNormals(layer);
    if (aov == Aov::depth) return displayDepth(layer);
    if (aov == Aov::openness) return linearFromDisplay(layer);
    return aov == Aov::irradiance || aov == Aov::contact ? asWhiteSurface(layer) : layer;
}

Result<void> writeAov(const std::string& path, const Picture& picture, Aov aov, const ToneMap& toneMap,
                      bool warnWhereBlack) {
    if (path.ends_with(".exr")) return writeImage(path, layerOf(picture, aov));
    const HdrImage shown = shownLayer(picture, aov);
    if (!isLight(aov)) return writeImage(path, shown);
    auto written = writeImage(path, shown, toneMap);
    if (written && warnWhereBlack) warnWhereNearlyBlack(path, shown, toneMap);
    return written;
}

}  // namespace probegi::tool

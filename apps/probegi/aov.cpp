#include "aov.h"

#include <algorithm>
#include <glm/common.hpp>
#include <numbers>

#include "probegi/compare.h"

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
        case Aov::color:
            break;
    }
    return picture.color;
}

bool isLight(Aov aov) {
    return aov == Aov::color || aov == Aov::direct || aov == Aov::indirect || aov == Aov::irradiance;
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

HdrImage asWhiteSurface(HdrImage irradiance) {
    for (glm::vec3& e : irradiance.pixels) e *= std::numbers::inv_pi_v<float>;
    return irradiance;
}

}  // namespace

Result<void> writeAov(const std::string& path, const Picture& picture, Aov aov, const ToneMap& toneMap) {
    const HdrImage& layer = layerOf(picture, aov);
    if (path.ends_with(".exr")) return writeImage(path, layer);
    const ToneMap used = isLight(aov) ? toneMap : ToneMap{};
    if (aov == Aov::normal) return writeImage(path, displayNormals(layer), used);
    if (aov == Aov::depth) return writeImage(path, displayDepth(layer), used);
    if (aov == Aov::irradiance) return writeImage(path, asWhiteSurface(layer), used);
    return writeImage(path, layer, used);
}

}  // namespace probegi::tool

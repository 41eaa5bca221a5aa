#include "field/changed_lights.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace probegi {

namespace {

constexpr float kLargeTurn = 0.3f;  // rad, of a sun or a spot

bool sameLight(const PlacedLight& a, const PlacedLight& b) {
    return a.type == b.type && a.position == b.position && a.direction == b.direction && a.intensity == b.intensity &&
           a.range == b.range && a.cosInner == b.cosInner && a.cosOuter == b.cosOuter;
}

float largest(glm::vec3 v) {
    return std::max({v.x, v.y, v.z});
}

float changeOf(glm::vec3 before, glm::vec3 after) {
    const float most = largest(glm::max(before, after));
    return most > 0 ? largest(glm::abs(after - before)) / most : 0.0f;
}

}  // namespace

std::vector<LightPair> changedLights(const std::vector<PlacedLight>& before, const std::vector<PlacedLight>& after) {
    std::vector<bool> unchanged(after.size(), false);
    std::vector<LightPair> pairs;
    for (std::size_t i = 0; i < before.size(); ++i) {
        std::size_t j = 0;
        while (j < after.size() && (unchanged[j] || !sameLight(before[i], after[j]))) ++j;
        if (j < after.size())
            unchanged[j] = true;
        else
            pairs.push_back({int(i), -1});
    }
    for (std::size_t j = 0; j < after.size(); ++j) {
        if (unchanged[j]) continue;
        const auto partner = std::find_if(pairs.begin(), pairs.end(), [&](const LightPair& pair) {
            return pair.before >= 0 && pair.after < 0 && before[std::size_t(pair.before)].type == after[j].type;
        });
        if (partner != pairs.end())
            partner->after = int(j);
        else
            pairs.push_back({-1, int(j)});
    }
    return pairs;
}

float lightChange(const PlacedLight& a, const PlacedLight& b, float distance) {
    if (a.range != b.range || a.cosInner != b.cosInner || a.cosOuter != b.cosOuter) return 1.0f;
    float change = changeOf(a.intensity, b.intensity);
    if (a.type != LightType::point) {
        const float turn = std::acos(std::clamp(glm::dot(a.direction, b.direction), -1.0f, 1.0f));
        change = std::max(change, turn / kLargeTurn);
    }
    // An inverse square changes by twice the way over the distance.
    if (const float way = glm::distance(a.position, b.position); a.type != LightType::directional && way > 0)
        change = std::max(change, distance > 0 ? 2 * way / distance : 1.0f);
    return std::min(change, 1.0f);
}

float skyChange(const Sky& before, const Sky& after) {
    const bool sameImage = before.image.width == after.image.width && before.image.height == after.image.height &&
                           before.image.pixels == after.image.pixels;
    return sameImage ? changeOf(before.radiance, after.radiance) : 1.0f;
}

}  // namespace probegi

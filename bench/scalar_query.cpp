#include "scalar_query.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "kernels/irradiance_decoding.h"
#include "kernels/octahedral.h"
#include "kernels/probe_cage.h"
#include "kernels/probe_query.h"
#include "kernels/storage.h"

namespace probegi::bench {

namespace {

struct Footprint {
    const std::array<std::uint16_t, 4>* taps;
    std::array<float, 4> weights;
};

Footprint footprintOf(const TapTable& table, int size, glm::vec3 direction) {
    const glm::vec2 texel = kernels::octTexelPosition(kernels::octEncode(direction), size);
    const glm::vec2 corner = glm::clamp(glm::floor(texel), glm::vec2(-1.0f), glm::vec2(float(size - 1)));
    const glm::vec2 f = texel - corner;
    return {&table[std::size_t((int(corner.y) + 1) * (size + 1) + int(corner.x) + 1)],
            {(1 - f.x) * (1 - f.y), f.x * (1 - f.y), (1 - f.x) * f.y, f.x * f.y}};
}

float visibilityWeight(const FieldView& view, int probe, glm::vec3 fromProbe) {
    const int size = view.desc->visibilityTexels;
    const Footprint f = footprintOf(*view.visibilityTaps, size, fromProbe);
    const std::uint32_t* map = view.visibility + std::size_t(probe) * std::size_t(size * size);
    float mean = 0, meanSquare = 0;
    for (std::size_t tap = 0; tap < 4; ++tap) {
        const std::uint32_t packed = map[(*f.taps)[tap]];
        mean += f.weights[tap] * kernels::unpackUnorm16(packed & 0xffffu);
        meanSquare += f.weights[tap] * kernels::unpackUnorm16(packed >> 16u);
    }
    return kernels::chebyshevWeight(mean, meanSquare, glm::length(fromProbe) * view.inverseMaxDistance,
                                    kernels::kRulesMeasured);
}

glm::vec3 blendSpaceIrradiance(const FieldView& view, int probe, const Footprint& f) {
    const int texels = view.desc->irradianceTexels * view.desc->irradianceTexels;
    const std::uint16_t* map = view.irradiance + 3 * std::size_t(probe) * std::size_t(texels);
    glm::vec3 stored(0.0f);
    for (std::size_t tap = 0; tap < 4; ++tap) {
        const std::uint16_t* texel = map + 3 * (*f.taps)[tap];
        stored += f.weights[tap] * glm::vec3(kernels::unpackHalf(texel[0]), kernels::unpackHalf(texel[1]),
                                             kernels::unpackHalf(texel[2]));
    }
    return {kernels::decodeToBlendSpace(stored.x), kernels::decodeToBlendSpace(stored.y),
            kernels::decodeToBlendSpace(stored.z)};
}

glm::vec3 queryOne(const FieldView& view, FieldQuery query) {
    const GridDesc& grid = view.desc->grid;
    query.position = kernels::clampToGrid(query.position, grid.origin, grid.spacing, grid.counts);
    const float scale = view.desc->selfShadowBias;
    const glm::vec3 bias =
        kernels::visibilityBias(query.normal, query.toViewer, view.minSpacing, scale, kernels::kRulesMeasured);
    const glm::vec3 moved = query.position + kernels::cageBias(query.normal, query.toViewer, view.minSpacing, scale,
                                                               kernels::kRulesMeasured);
    const glm::vec3 local = kernels::gridCoordinates(moved, grid.origin, view.inverseSpacing);
    const glm::vec3 base = kernels::cageBase(local, grid.counts);
    const glm::vec3 alpha = kernels::cageAlpha(local, base);
    const Footprint footprint = footprintOf(*view.irradianceTaps, view.desc->irradianceTexels, query.normal);
    glm::vec3 sum(0.0f);
    float weightSum = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::ivec3 offset(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
        const glm::ivec3 at = glm::ivec3(base) + offset;
        const int probe = at.x + grid.counts.x * (at.y + grid.counts.y * at.z);
        const glm::vec3 toProbe = grid.origin + glm::vec3(at) * grid.spacing - query.position;
        const float cosine =
            kernels::cosineToProbe(glm::dot(toProbe, query.normal), glm::length(toProbe), view.minSpacing);
        const float trilinear = kernels::trilinearFactor(float(offset.x), alpha.x) *
                                kernels::trilinearFactor(float(offset.y), alpha.y) *
                                kernels::trilinearFactor(float(offset.z), alpha.z);
        const float visible = visibilityWeight(view, probe, bias - toProbe);
        const float weight = kernels::crushWeight(kernels::backfaceWeight(cosine, kernels::kRulesMeasured) * visible) *
                             trilinear * kernels::outsideWeight(view.backfaceShare[probe], kernels::kRulesMeasured);
        sum += weight * blendSpaceIrradiance(view, probe, footprint);
        weightSum += weight;
    }
    sum /= weightSum;
    return sum * sum * kernels::kPi;
}

}  // namespace

void queryScalar(const FieldView& view, std::span<const FieldQuery> queries, std::span<glm::vec3> out) {
    for (std::size_t i = 0; i < queries.size(); ++i) out[i] = queryOne(view, queries[i]);
}

}  // namespace probegi::bench

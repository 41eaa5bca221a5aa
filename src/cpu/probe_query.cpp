#include "cpu/probe_query.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

#include "cpu/footprint.h"
#include "cpu/query_lanes.h"
#include "kernels/lookup/probe_neighbours.h"
#include "kernels/probe/irradiance_decoding.h"
#include "kernels/probe/octahedral_texel.h"
#include "kernels/probe/probe_texel.h"
#include "kernels/volume/probe_cage.h"

namespace probegi {

namespace {

// E that one probe stores at a footprint of the irradiance maps.
glm::vec3 irradianceAt(const FieldView& view, int probe, const Footprint& f) {
    const std::size_t texels = std::size_t(view.desc->irradianceTexels) * std::size_t(view.desc->irradianceTexels);
    const std::uint16_t* map = view.irradiance + 3 * texels * std::size_t(probe);
    glm::vec3 stored(0.0f);
    for (std::size_t tap = 0; tap < 4; ++tap) {
        const std::uint16_t* texel = map + 3 * f.offset[tap];
        stored += f.weight[tap] * glm::vec3(kernels::unpackHalf(texel[0]), kernels::unpackHalf(texel[1]),
                                            kernels::unpackHalf(texel[2]));
    }
    return glm::vec3(kernels::decodeIrradiance(stored.x), kernels::decodeIrradiance(stored.y),
                     kernels::decodeIrradiance(stored.z)) *
           kernels::kPi;
}

Footprint irradianceFootprint(const FieldView& view, glm::vec3 normal) {
    return footprintOf(*view.irradianceTaps, view.desc->irradianceTexels, normal);
}

// How far one probe sees the point, as the field's guard has it.
float neighbourVisibility(const FieldView& view, int probe, glm::vec3 fromProbe) {
    if (view.settings->guard == LeakGuard::none) return 1.0f;
    const float distance = glm::length(fromProbe) + kernels::kNoLength;
    return kernels::neighbourVisibility(probeMoments(view, probe, fromProbe / distance),
                                        distance * view.volumes[0].inverseMaxDistance);
}

// The answer where the probes of the cage do not know (kernels/lookup/probe_neighbours.h). Black only where all
// neighbours stand in walls.
glm::vec3 queryNeighbours(const FieldView& view, FieldQuery query) {
    const kernels::Volume& grid = view.volumes[0];
    const float biasScale = view.settings->selfShadowBias;
    constexpr int rules = kernels::kRulesMeasured;
    query.toViewer = kernels::viewerOf(query.toViewer, query.normal);
    query.position = kernels::clampToGrid(query.position, grid.origin, grid.spacing, grid.counts);
    const glm::vec3 bias = kernels::visibilityBias(query.normal, query.toViewer, grid.minSpacing, biasScale, rules);
    const glm::vec3 local = kernels::gridCoordinates(
        query.position + kernels::cageBias(query.normal, query.toViewer, grid.minSpacing, biasScale, rules),
        grid.origin, grid.inverseSpacing);
    const glm::ivec3 base(kernels::cageBase(local, grid.counts));
    const Footprint footprint = irradianceFootprint(view, query.normal);
    glm::vec3 sum(0.0f);
    float weightSum = 0;
    for (int i = 0; i < kernels::kNeighbours; ++i) {
        const glm::ivec3 cell = kernels::neighbourCell(base, i);
        if (!kernels::isInGrid(cell, grid.counts)) continue;
        const int probe = kernels::probeNumber(cell, grid.counts);
        const float outside = kernels::outsideWeight(view.backfaceShare[probe], rules);
        if (outside <= 0.0f) continue;
        const glm::vec3 toProbe = kernels::probePlace(cell, grid.origin, grid.spacing) - query.position;
        const float visible = neighbourVisibility(view, probe, bias - toProbe);
        const float weight = kernels::neighbourWeight(outside, toProbe, query.normal, visible, grid.minSpacing);
        sum += weight * irradianceAt(view, probe, footprint);
        weightSum += weight;
    }
    return weightSum > 0 ? sum / weightSum : glm::vec3(0.0f);
}

}  // namespace

TapTable makeTapTable(int size) {
    TapTable table;
    table.reserve(std::size_t(size + 1) * (size + 1));
    const auto index = [size](int x, int y) {
        const glm::ivec2 t = kernels::octWrapTexel(x, y, size);
        return std::uint16_t(t.y * size + t.x);
    };
    for (int y = -1; y < size; ++y)
        for (int x = -1; x < size; ++x)
            table.push_back({index(x, y), index(x + 1, y), index(x, y + 1), index(x + 1, y + 1)});
    return table;
}

void queryIrradiance(const FieldView& view, std::span<const FieldQuery> queries, std::span<glm::vec3> out) {
    std::array<CageAnswer, 256> answers;
    for (std::size_t begin = 0; begin < queries.size(); begin += answers.size()) {
        const std::size_t count = std::min(answers.size(), queries.size() - begin);
        answerFromCages(view, queries.subspan(begin, count), answers.data());
        for (std::size_t i = 0; i < count; ++i) {
            const CageAnswer& answer = answers[i];
            const bool known = view.desc->rules == FieldRules::paper || answer.weightSum >= kernels::kDoubtful;
            if (!known && view.fallbacks) view.fallbacks->fetch_add(1, std::memory_order_relaxed);
            out[begin + i] = known ? answer.irradiance
                                   : kernels::completedByNeighbours(answer.root, answer.weightSum,
                                                                    queryNeighbours(view, queries[begin + i]));
        }
    }
}

glm::vec3 probeIrradiance(const FieldView& view, int probe, glm::vec3 normal) {
    return irradianceAt(view, probe, irradianceFootprint(view, normal));
}

glm::vec2 probeMoments(const FieldView& view, int probe, glm::vec3 direction) {
    return momentsAt(view, probe, footprintOf(*view.visibilityTaps, view.desc->visibilityTexels, direction));
}

}  // namespace probegi

#include "scalar_query.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "kernels/lookup/probe_neighbours.h"
#include "kernels/lookup/surface_gradient.h"
#include "kernels/probe/irradiance_decoding.h"
#include "kernels/probe/octahedral.h"
#include "kernels/probe/probe_texel.h"
#include "kernels/volume/probe_cage.h"

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

// One query, and what all its probes share.
struct Question {
    const FieldView& view;
    const VolumeDesc& grid;
    int rules;
    glm::vec3 position, normal, bias;
    glm::ivec3 base;
    glm::vec3 alpha;
    Footprint footprint;
};

int probeAt(const Question& q, glm::ivec3 cell) {
    return kernels::probeNumber(cell, q.grid.counts);
}

float outside(const Question& q, glm::ivec3 cell) {
    return kernels::outsideWeight(q.view.backfaceShare[probeAt(q, cell)], q.rules);
}

glm::vec2 moments(const Question& q, glm::ivec3 cell, glm::vec3 direction) {
    const int size = q.view.desc->visibilityTexels;
    const Footprint f = footprintOf(*q.view.visibilityTaps, size, direction);
    const std::uint32_t* map = q.view.visibility + std::size_t(probeAt(q, cell)) * std::size_t(size * size);
    glm::vec2 sum(0.0f);
    for (std::size_t tap = 0; tap < 4; ++tap) sum += f.weights[tap] * kernels::unpackMoments(map[(*f.taps)[tap]]);
    return sum;
}

float seen(const Question& q, glm::ivec3 cell, glm::vec3 direction, float distance) {
    if (q.view.desc->guard == LeakGuard::none) return 1.0f;
    const glm::vec2 m = moments(q, cell, direction);
    return kernels::chebyshevWeight(m.x, m.y, distance * q.view.inverseMaxDistance, q.rules);
}

glm::vec3 stored(const Question& q, glm::ivec3 cell) {
    const std::size_t texels = std::size_t(q.view.desc->irradianceTexels * q.view.desc->irradianceTexels);
    const std::uint16_t* map = q.view.irradiance + 3 * std::size_t(probeAt(q, cell)) * texels;
    glm::vec3 sum(0.0f);
    for (std::size_t tap = 0; tap < 4; ++tap) {
        const std::uint16_t* texel = map + 3 * (*q.footprint.taps)[tap];
        sum += q.footprint.weights[tap] *
               glm::vec3(kernels::unpackHalf(texel[0]), kernels::unpackHalf(texel[1]), kernels::unpackHalf(texel[2]));
    }
    return sum;
}

glm::vec3 root(const Question& q, glm::ivec3 cell) {
    const glm::vec3 s = stored(q, cell);
    return {kernels::decodeToBlendSpace(s.x), kernels::decodeToBlendSpace(s.y), kernels::decodeToBlendSpace(s.z)};
}

struct Sums {
    glm::vec3 root{0.0f}, rise{0.0f};
    float weight = 0, ahead = 0, pair = 0;
};

// Which layer of probes tells how light changes along the normal.
struct Front {
    int axis, side;
    glm::ivec3 step{0};
    float trust;
};

Front frontOf(const Question& q) {
    Front front{kernels::dominantAxis(q.normal), 0, glm::ivec3(0), 0.0f};
    front.side = q.normal[front.axis] > 0.0f ? 1 : 0;
    front.step[front.axis] = 2 * front.side - 1;
    const int beyond = q.base[front.axis] + (front.side == 1 ? 2 : -1);
    if (q.rules == kernels::kRulesMeasured && beyond >= 0 && beyond < q.grid.counts[front.axis])
        front.trust = kernels::axisTrust(q.normal);
    return front;
}

void addCorner(const Question& q, const Front& front, glm::ivec3 corner, Sums& sums) {
    const glm::ivec3 cell = q.base + corner;
    const glm::vec3 toProbe = kernels::probePlace(cell, q.grid.origin, q.grid.spacing) - q.position;
    const float ahead = glm::dot(toProbe, q.normal);
    const float cosine = kernels::cosineToProbe(ahead, glm::length(toProbe), q.view.minSpacing);
    float trilinear = 1;
    for (int axis = 0; axis < 3; ++axis) trilinear *= kernels::trilinearFactor(float(corner[axis]), q.alpha[axis]);
    const glm::vec3 fromProbe = q.bias - toProbe;
    const float weight = kernels::crushWeight(kernels::backfaceWeight(cosine, q.rules) *
                                              seen(q, cell, fromProbe, glm::length(fromProbe))) *
                         trilinear * outside(q, cell);
    const glm::vec3 here = root(q, cell);
    sums.root += weight * here;
    sums.weight += weight;
    sums.ahead += weight * ahead;
    if (front.trust <= 0.0f || corner[front.axis] != front.side) return;
    const float pair = weight / kernels::trilinearFactor(float(front.side), q.alpha[front.axis]) *
                       outside(q, cell + front.step) * seen(q, cell, glm::vec3(front.step), q.grid.spacing[front.axis]);
    sums.rise += pair * (root(q, cell + front.step) - here);
    sums.pair += pair;
}

glm::vec3 atSurface(const Question& q, const Front& front, const Sums& sums) {
    glm::vec3 result = sums.root / sums.weight;
    const float ahead = sums.ahead / sums.weight;
    if (front.trust > 0.0f && ahead > 0.0f) {
        const float cells = kernels::cellsAhead(ahead, q.grid.spacing[front.axis], q.normal[front.axis]);
        for (int c = 0; c < 3; ++c)
            result[c] = kernels::rootAtSurface(result[c], sums.rise[c], sums.pair, cells, front.trust);
    }
    return result * result * kernels::kPi;
}

glm::vec3 neighbours(const Question& q) {
    glm::vec3 sum(0.0f);
    float weightSum = 0;
    for (int i = 0; i < kernels::kNeighbours; ++i) {
        const glm::ivec3 cell = kernels::neighbourCell(q.base, i);
        if (!kernels::isInGrid(cell, q.grid.counts)) continue;
        const glm::vec3 toProbe = kernels::probePlace(cell, q.grid.origin, q.grid.spacing) - q.position;
        const glm::vec3 fromProbe = q.bias - toProbe;
        const float distance = (glm::length(fromProbe) + kernels::kNoLength) * q.view.inverseMaxDistance;
        const float visible = q.view.desc->guard == LeakGuard::none
                                  ? 1.0f
                                  : kernels::neighbourVisibility(moments(q, cell, fromProbe), distance);
        const float weight = kernels::neighbourWeight(outside(q, cell), toProbe, q.normal, visible, q.view.minSpacing);
        const glm::vec3 s = stored(q, cell);
        sum += weight * kernels::kPi * s * s * s * s * s;
        weightSum += weight;
    }
    return weightSum > 0 ? sum / weightSum : glm::vec3(0.0f);
}

glm::vec3 queryOne(const FieldView& view, const FieldQuery& query) {
    const VolumeDesc& grid = view.desc->grid;
    const int rules = view.desc->rules == FieldRules::paper ? kernels::kRulesPaper : kernels::kRulesMeasured;
    const float scale = view.desc->selfShadowBias;
    const glm::vec3 position = kernels::clampToGrid(query.position, grid.origin, grid.spacing, grid.counts);
    const glm::vec3 moved = position + kernels::cageBias(query.normal, query.toViewer, view.minSpacing, scale, rules);
    const glm::vec3 local = kernels::gridCoordinates(moved, grid.origin, view.inverseSpacing);
    const glm::vec3 base = kernels::cageBase(local, grid.counts);
    const Question q{view,
                     grid,
                     rules,
                     position,
                     query.normal,
                     kernels::visibilityBias(query.normal, query.toViewer, view.minSpacing, scale, rules),
                     glm::ivec3(base),
                     kernels::cageAlpha(local, base),
                     footprintOf(*view.irradianceTaps, view.desc->irradianceTexels, query.normal)};
    const Front front = frontOf(q);
    Sums sums;
    for (int i = 0; i < 8; ++i) addCorner(q, front, {i & 1, i >> 1 & 1, i >> 2}, sums);
    if (rules == kernels::kRulesPaper || sums.weight >= kernels::kDoubtful) return atSurface(q, front, sums);
    return kernels::completedByNeighbours(sums.root, sums.weight, neighbours(q));
}

}  // namespace

void queryScalar(const FieldView& view, std::span<const FieldQuery> queries, std::span<glm::vec3> out) {
    for (std::size_t i = 0; i < queries.size(); ++i) out[i] = queryOne(view, queries[i]);
}

}  // namespace probegi::bench

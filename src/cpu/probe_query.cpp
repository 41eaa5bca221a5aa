#include "cpu/probe_query.h"

#include <algorithm>
#include <bit>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

#include "cpu/footprint.h"
#include "cpu/leak_guards.h"
#include "kernels/irradiance_decoding.h"
#include "kernels/octahedral_texel.h"
#include "kernels/probe_cage.h"
#include "kernels/probe_neighbours.h"
#include "kernels/probe_texel.h"
#include "kernels/surface_gradient.h"

namespace probegi {

namespace {

namespace wide = kernels::wide;
using wide::Real;
using wide::stdx::element_aligned;

// One texel's three channels (and whatever follows) abreast.
using Texel = wide::stdx::fixed_size_simd<float, 4>;

// kernels::unpackHalf, four abreast, but for the factor kHalfRebase, which the weights of the footprint bring: a power
// of two changes no rounding. Inlined by force, as is storedIrradiance: a call returns four floats through memory,
// which took a quarter of the query.
[[gnu::always_inline]] inline Texel loadTexel(const std::uint16_t* halves) {
    using TexelBits = wide::stdx::fixed_size_simd<std::uint32_t, 4>;
    std::array<std::uint32_t, 4> bits;  // stdx has no bit_cast
    (TexelBits(halves, element_aligned) << 13).copy_to(bits.data(), element_aligned);
    return Texel(std::bit_cast<std::array<float, 4>>(bits).data(), element_aligned);
}

// A footprint of the irradiance maps, for storedIrradiance.
Footprint irradianceFootprint(const FieldView& view, glm::vec3 normal) {
    Footprint f = footprintOf(*view.irradianceTaps, view.desc->irradianceTexels, normal);
    for (float& weight : f.weight) weight *= kernels::kHalfRebase;
    return f;
}

[[gnu::always_inline]] inline Texel storedIrradiance(const std::uint16_t* map, const Footprint& f) {
    return f.weight[0] * loadTexel(map + 3 * f.offset[0]) + f.weight[1] * loadTexel(map + 3 * f.offset[1]) +
           f.weight[2] * loadTexel(map + 3 * f.offset[2]) + f.weight[3] * loadTexel(map + 3 * f.offset[3]);
}

const Real kCornerX([](int lane) { return float(lane & 1); });
const Real kCornerY([](int lane) { return float(lane >> 1 & 1); });
const Real kCornerZ([](int lane) { return float(lane >> 2 & 1); });

// E that one probe stores, from what storedIrradiance gives.
glm::vec3 decoded(const Texel& s) {
    return glm::vec3(kernels::decodeIrradiance(s[0]), kernels::decodeIrradiance(s[1]),
                     kernels::decodeIrradiance(s[2])) *
           kernels::kPi;
}

// How far one probe sees the point, as the field's guard has it.
float neighbourVisibility(const FieldView& view, int probe, glm::vec3 fromProbe) {
    if (view.desc->guard == LeakGuard::none) return 1.0f;
    const float distance = glm::length(fromProbe) + kernels::kNoLength;
    return kernels::neighbourVisibility(probeMoments(view, probe, fromProbe / distance),
                                        distance * view.inverseMaxDistance);
}

// What one probe stores at a footprint, in the space of kernels::decodeToBlendSpace, four channels abreast.
[[gnu::always_inline]] inline Texel storedRoot(const FieldView& view, std::int32_t probe, const Footprint& f) {
    const std::size_t size = std::size_t(view.desc->irradianceTexels);
    const Texel stored = storedIrradiance(view.irradiance + 3 * std::size_t(probe) * size * size, f);
    return stored * stored * wide::stdx::sqrt(stored);
}

// The answer where the probes of the cage do not know (kernels/probe_neighbours.h); `base` is the cage's lowest probe.
// Black only where all neighbours stand in walls.
glm::vec3 queryNeighbours(const FieldView& view, const FieldQuery& query, glm::vec3 bias, glm::ivec3 base) {
    const GridDesc& grid = view.desc->grid;
    const Footprint footprint = irradianceFootprint(view, query.normal);
    const std::size_t halvesPerProbe = 3 * std::size_t(view.desc->irradianceTexels * view.desc->irradianceTexels);
    glm::vec3 sum(0.0f);
    float weightSum = 0;
    for (int i = 0; i < kernels::kNeighbours; ++i) {
        const glm::ivec3 cell = kernels::neighbourCell(base, i);
        if (!kernels::isInGrid(cell, grid.counts)) continue;
        const int probe = kernels::probeNumber(cell, grid.counts);
        const float outside = kernels::outsideWeight(view.backfaceShare[probe], kernels::kRulesMeasured);
        if (outside <= 0.0f) continue;
        const glm::vec3 toProbe = kernels::probePlace(cell, grid.origin, grid.spacing) - query.position;
        const float visible = neighbourVisibility(view, probe, bias - toProbe);
        const float weight = kernels::neighbourWeight(outside, toProbe, query.normal, visible, view.minSpacing);
        sum += weight * decoded(storedIrradiance(view.irradiance + halvesPerProbe * std::size_t(probe), footprint));
        weightSum += weight;
    }
    return weightSum > 0 ? sum / weightSum : glm::vec3(0.0f);
}

// What the eight probes around a point answer, and what the way back to the surface needs of it.
struct CageAnswer {
    CageQuery cage;
    glm::ivec3 base;             // lowest probe
    glm::vec3 alpha;             // of the point in the cage
    std::array<Texel, 8> roots;  // of the probes
    Real weight;                 // of the probes
    Texel root;                  // weighted mean
    float ahead;                 // weighted mean of the probes' distance to the surface's plane, metres
};

// The cage's answer at the surface itself (kernels/surface_gradient.h), from the probes beyond the cage's front.
template <class Guard>
Texel atSurface(const FieldView& view, const FieldQuery& query, const CageAnswer& answer, const Footprint& footprint,
                const Guard& guard) {
    const GridDesc& grid = view.desc->grid;
    const int axis = kernels::dominantAxis(query.normal);
    const bool up = query.normal[axis] > 0.0f;
    const int beyond = answer.base[axis] + (up ? 2 : -1);
    const float trust = kernels::axisTrust(query.normal);
    const float cells = kernels::cellsAhead(answer.ahead, grid.spacing[axis], query.normal[axis]);
    if (beyond < 0 || beyond >= grid.counts[axis] || trust * cells <= 0.0f) return answer.root;

    const std::array<std::int32_t, 3> strides{1, grid.counts.x, grid.counts.x * grid.counts.y};
    const std::int32_t step = up ? strides[std::size_t(axis)] : -strides[std::size_t(axis)];
    glm::vec3 direction(0.0f);
    direction[axis] = up ? 1.0f : -1.0f;
    const Footprint towards = footprintOf(*view.visibilityTaps, view.desc->visibilityTexels, direction);
    // The pair's weight is that of the probe in front, without the share that the point's depth gives to its layer.
    const float alongAxis = kernels::trilinearFactor(up ? 1.0f : 0.0f, answer.alpha[axis]);
    Texel rise = 0.0f;
    float pairWeight = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t low = i & ((std::size_t(1) << axis) - 1);
        const std::size_t lane = ((i - low) << 1) + low + (up ? std::size_t(1) << axis : 0);
        const std::int32_t front = answer.cage.probes[lane];
        const float weight = answer.weight[lane] / alongAxis *
                             kernels::outsideWeight(view.backfaceShare[front + step], kernels::kRulesMeasured) *
                             guard.between(view, front, towards, grid.spacing[axis]);
        rise += weight * (storedRoot(view, front + step, footprint) - answer.roots[lane]);
        pairWeight += weight;
    }
    return Texel([&](auto c) { return kernels::rootAtSurface(answer.root[c], rise[c], pairWeight, cells, trust); });
}

// Steps 1 to 3 of section 2.2 for the eight probes around a point, then their weighted sum.
template <class Guard, int rules>
glm::vec3 queryOne(const FieldView& view, FieldQuery query, const Guard& guard) {
    const GridDesc& grid = view.desc->grid;
    const float biasScale = view.desc->selfShadowBias;
    query.position = kernels::clampToGrid(query.position, grid.origin, grid.spacing, grid.counts);
    const glm::vec3 bias = kernels::visibilityBias(query.normal, query.toViewer, view.minSpacing, biasScale, rules);
    // The cage and the trilinear weights belong to a point a little off the surface: on a wall that runs through a
    // layer of probes the answer would otherwise lean on that layer alone.
    const glm::vec3 local = kernels::gridCoordinates(
        query.position + kernels::cageBias(query.normal, query.toViewer, view.minSpacing, biasScale, rules),
        grid.origin, view.inverseSpacing);
    const glm::vec3 base = kernels::cageBase(local, grid.counts);
    const glm::vec3 alpha = kernels::cageAlpha(local, base);
    const glm::vec3 fromBase = query.position - (grid.origin + base * grid.spacing);

    // From the point to each probe.
    const Real dx = kCornerX * grid.spacing.x - fromBase.x;
    const Real dy = kCornerY * grid.spacing.y - fromBase.y;
    const Real dz = kCornerZ * grid.spacing.z - fromBase.z;
    const Real length = wide::sqrt(dx * dx + dy * dy + dz * dz);
    const Real ahead = dx * query.normal.x + dy * query.normal.y + dz * query.normal.z;
    const Real cosToProbe = wide::cosineToProbe(ahead, length, view.minSpacing);

    const std::int32_t strideY = grid.counts.x, strideZ = grid.counts.x * grid.counts.y;
    const std::int32_t first = std::int32_t(base.x) + strideY * std::int32_t(base.y) + strideZ * std::int32_t(base.z);
    const CageQuery cage{{first, first + 1, first + strideY, first + strideY + 1, first + strideZ, first + strideZ + 1,
                          first + strideZ + strideY, first + strideZ + strideY + 1},
                         {bias.x - dx, bias.y - dy, bias.z - dz}};

    const Real trilinear = wide::trilinearFactor(kCornerX, alpha.x) * wide::trilinearFactor(kCornerY, alpha.y) *
                           wide::trilinearFactor(kCornerZ, alpha.z);
    const Real share([&](auto lane) { return view.backfaceShare[cage.probes[lane]]; });
    const Real weight = wide::crushWeight(wide::backfaceWeight(cosToProbe, rules) * guard(view, cage)) * trilinear *
                        wide::outsideWeight(share, rules);
    const float weightSum = wide::stdx::reduce(weight);

    const Footprint footprint = irradianceFootprint(view, query.normal);
    CageAnswer answer{cage, glm::ivec3(base), alpha, {}, weight, 0.0f, 0.0f};
    for (int lane = 0; lane < wide::kLanes; ++lane) {
        answer.roots[std::size_t(lane)] = storedRoot(view, cage.probes[std::size_t(lane)], footprint);
        answer.root += float(weight[lane]) * answer.roots[std::size_t(lane)];
    }
    if (rules == kernels::kRulesPaper || weightSum >= kernels::kDoubtful) {
        answer.root /= weightSum;
        if (rules == kernels::kRulesMeasured) {
            answer.ahead = wide::stdx::reduce(weight * ahead) / weightSum;
            answer.root = atSurface(view, query, answer, footprint, guard);
        }
        const Texel& r = answer.root;
        return glm::vec3(r[0] * r[0], r[1] * r[1], r[2] * r[2]) * kernels::kPi;
    }
    if (view.fallbacks) view.fallbacks->fetch_add(1, std::memory_order_relaxed);
    return kernels::completedByNeighbours({answer.root[0], answer.root[1], answer.root[2]}, weightSum,
                                          queryNeighbours(view, query, bias, answer.base));
}

template <class Guard, int rules>
void queryAll(const FieldView& view, std::span<const FieldQuery> queries, std::span<glm::vec3> out) {
    const Guard guard;
    for (std::size_t i = 0; i < queries.size(); ++i) out[i] = queryOne<Guard, rules>(view, queries[i], guard);
}

// By the view's guard.
template <int rules>
void queryBy(const FieldView& view, std::span<const FieldQuery> queries, std::span<glm::vec3> out) {
    switch (view.desc->guard) {
        case LeakGuard::none:
            return queryAll<NoGuard, rules>(view, queries, out);
        case LeakGuard::moments:
            return queryAll<MomentsGuard<rules>, rules>(view, queries, out);
    }
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
    if (view.desc->rules == FieldRules::paper) return queryBy<kernels::kRulesPaper>(view, queries, out);
    return queryBy<kernels::kRulesMeasured>(view, queries, out);
}

glm::vec3 probeIrradiance(const FieldView& view, int probe, glm::vec3 normal) {
    const int size = view.desc->irradianceTexels;
    const Footprint footprint = irradianceFootprint(view, normal);
    const std::size_t texels = std::size_t(probe) * std::size_t(size * size);
    return decoded(storedIrradiance(view.irradiance + 3 * texels, footprint));
}

glm::vec2 probeMoments(const FieldView& view, int probe, glm::vec3 direction) {
    return momentsAt(view, probe, footprintOf(*view.visibilityTaps, view.desc->visibilityTexels, direction));
}

}  // namespace probegi

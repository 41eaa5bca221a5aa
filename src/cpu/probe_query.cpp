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
    const CageQuery& cage;
    const std::array<Texel, 8>& roots;  // of the probes
    const Real& weight;                 // of the probes
    glm::ivec3 base;                    // lowest probe
    glm::vec3 alpha;                    // of the point in the cage
    float ahead;                        // weighted mean of the probes' distance to the surface's plane, metres
};

// The cage's answer `root` at the surface itself (kernels/surface_gradient.h), from the probes beyond the cage's front.
template <class Guard>
[[gnu::always_inline]] inline Texel atSurface(const FieldView& view, const FieldQuery& query, const CageAnswer& answer,
                                              const Texel& root, const Footprint& footprint, const Guard& guard) {
    const GridDesc& grid = view.desc->grid;
    const int axis = kernels::dominantAxis(query.normal);
    const bool up = query.normal[axis] > 0.0f;
    const int beyond = answer.base[axis] + (up ? 2 : -1);
    const float trust = kernels::axisTrust(query.normal);
    if (beyond < 0 || beyond >= grid.counts[axis] || trust <= 0.0f || answer.ahead <= 0.0f) return root;

    const std::array<std::int32_t, 3> strides{1, grid.counts.x, grid.counts.x * grid.counts.y};
    const std::int32_t step = up ? strides[std::size_t(axis)] : -strides[std::size_t(axis)];
    // The cage's lanes in front.
    const std::size_t bit = std::size_t(1) << axis, first = up ? bit : 0;
    const std::size_t u = axis == 0 ? 2 : 1, v = axis == 2 ? 2 : 4;
    const std::array<std::size_t, 4> lanes{first, first + u, first + v, first + u + v};
    FourProbes front;
    alignas(32) std::array<float, wide::kLanes> weights{}, shares{};
    for (std::size_t i = 0; i < 4; ++i) {
        front[i] = answer.cage.probes[lanes[i]];
        weights[i] = answer.weight[lanes[i]];
        shares[i] = view.backfaceShare[front[i] + step];
    }
    const AxisTexels& towards = axisTexels(*view.visibilityTaps, view.desc->visibilityTexels, axis, up);
    // The pair's weight is that of the probe in front, without the share that the point's depth gives to its layer.
    const float alongAxis = 1.0f / kernels::trilinearFactor(up ? 1.0f : 0.0f, answer.alpha[axis]);
    const Real pair = Real(weights.data(), element_aligned) * alongAxis *
                      wide::outsideWeight(Real(shares.data(), element_aligned), kernels::kRulesMeasured) *
                      guard.between(view, front, towards, grid.spacing[axis]);
    Texel rise = 0.0f;
    for (std::size_t i = 0; i < 4; ++i)
        rise += float(pair[i]) * (storedRoot(view, front[i] + step, footprint) - answer.roots[lanes[i]]);

    alignas(32) std::array<float, wide::kLanes> roots{}, rises{};
    root.copy_to(roots.data(), element_aligned);
    rise.copy_to(rises.data(), element_aligned);
    wide::rootAtSurface(Real(roots.data(), element_aligned), Real(rises.data(), element_aligned),
                        wide::stdx::reduce(pair),
                        kernels::cellsAhead(answer.ahead, grid.spacing[axis], query.normal[axis]), trust)
        .copy_to(roots.data(), element_aligned);
    return Texel(roots.data(), element_aligned);
}

// Steps 1 to 3 of section 2.2 for the eight probes around a point, then their weighted sum.
template <class Guard, int rules>
glm::vec3 queryOne(const FieldView& view, FieldQuery query, const Guard& guard) {
    const GridDesc& grid = view.desc->grid;
    const float biasScale = view.desc->selfShadowBias;
    query.toViewer = kernels::viewerOf(query.toViewer, query.normal);
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
    std::array<Texel, 8> roots;
    Texel root = 0.0f;
    for (int lane = 0; lane < wide::kLanes; ++lane) {
        roots[std::size_t(lane)] = storedRoot(view, cage.probes[std::size_t(lane)], footprint);
        root += float(weight[lane]) * roots[std::size_t(lane)];
    }
    if (rules == kernels::kRulesPaper || weightSum >= kernels::kDoubtful) {
        root /= weightSum;
        if (rules == kernels::kRulesMeasured) {
            const float distance = wide::stdx::reduce(weight * ahead) / weightSum;
            root = atSurface(view, query, {cage, roots, weight, glm::ivec3(base), alpha, distance}, root, footprint,
                             guard);
        }
        return glm::vec3(root[0] * root[0], root[1] * root[1], root[2] * root[2]) * kernels::kPi;
    }
    if (view.fallbacks) view.fallbacks->fetch_add(1, std::memory_order_relaxed);
    return kernels::completedByNeighbours({root[0], root[1], root[2]}, weightSum,
                                          queryNeighbours(view, query, bias, glm::ivec3(base)));
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

#include "cpu/probe_query.h"

#include <algorithm>
#include <bit>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

#include "cpu/leak_guards.h"
#include "kernels/irradiance_decoding.h"
#include "kernels/octahedral_texel.h"
#include "kernels/probe_cage.h"
#include "kernels/probe_neighbours.h"
#include "kernels/probe_texel.h"

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

// A bilinear footprint of one map that all probes share: four texel offsets and their weights.
struct Footprint {
    std::array<std::uint32_t, 4> offset;
    std::array<float, 4> weight;
};

Footprint footprintOf(const TapTable& table, int size, glm::vec3 direction) {
    const glm::vec2 texel = kernels::octTexelPosition(kernels::octEncode(direction), size);
    const glm::vec2 corner = glm::clamp(glm::floor(texel), glm::vec2(-1.0f), glm::vec2(float(size - 1)));
    const glm::vec2 f = texel - corner;
    const auto& taps = table[std::size_t((int(corner.y) + 1) * (size + 1) + int(corner.x) + 1)];
    return {{taps[0], taps[1], taps[2], taps[3]}, {(1 - f.x) * (1 - f.y), f.x * (1 - f.y), (1 - f.x) * f.y, f.x * f.y}};
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

// The answer where the probes of the cage do not know (kernels/probe_neighbours.h); `local` is the point in the grid.
// Black only where all probes of the block stand in walls.
glm::vec3 queryNeighbours(const FieldView& view, const FieldQuery& query, glm::vec3 bias, glm::vec3 local) {
    const GridDesc& grid = view.desc->grid;
    const glm::ivec3 lowest = kernels::searchLowest(local, grid.counts);
    const glm::ivec3 highest = kernels::searchHighest(local, grid.counts);
    const Footprint footprint = irradianceFootprint(view, query.normal);
    const std::size_t halvesPerProbe = 3 * std::size_t(view.desc->irradianceTexels * view.desc->irradianceTexels);
    glm::vec3 sum(0.0f);
    float weightSum = 0;
    for (int z = lowest.z; z <= highest.z; ++z)
        for (int y = lowest.y; y <= highest.y; ++y)
            for (int x = lowest.x; x <= highest.x; ++x) {
                const int probe = kernels::probeNumber({x, y, z}, grid.counts);
                const float outside = kernels::outsideWeight(view.backfaceShare[probe]);
                if (outside <= 0.0f) continue;
                const glm::vec3 toProbe = kernels::probePlace({x, y, z}, grid.origin, grid.spacing) - query.position;
                const float visible = neighbourVisibility(view, probe, bias - toProbe);
                const float weight = kernels::neighbourWeight(outside, toProbe, query.normal, visible, view.minSpacing);
                sum += weight *
                       decoded(storedIrradiance(view.irradiance + halvesPerProbe * std::size_t(probe), footprint));
                weightSum += weight;
            }
    return weightSum > 0 ? sum / weightSum : glm::vec3(0.0f);
}

// Steps 1 to 3 of section 2.2 for the eight probes around a point, then their weighted sum.
template <class Guard>
glm::vec3 queryOne(const FieldView& view, FieldQuery query, const Guard& guard) {
    const GridDesc& grid = view.desc->grid;
    query.position = kernels::clampToGrid(query.position, grid.origin, grid.spacing, grid.counts);
    const glm::vec3 bias =
        kernels::selfShadowBias(query.normal, query.toViewer, view.minSpacing, view.desc->selfShadowBias);
    // The cage and the trilinear weights belong to a point a little off the surface: on a wall that runs through a
    // layer of probes the answer would otherwise lean on that layer alone.
    const glm::vec3 local =
        kernels::gridCoordinates(query.position + kernels::kCageBias * bias, grid.origin, view.inverseSpacing);
    const glm::vec3 base = kernels::cageBase(local, grid.counts);
    const glm::vec3 alpha = kernels::cageAlpha(local, base);
    const glm::vec3 fromBase = query.position - (grid.origin + base * grid.spacing);

    // From the point to each probe.
    const Real dx = kCornerX * grid.spacing.x - fromBase.x;
    const Real dy = kCornerY * grid.spacing.y - fromBase.y;
    const Real dz = kCornerZ * grid.spacing.z - fromBase.z;
    const Real length = wide::sqrt(dx * dx + dy * dy + dz * dz);
    const Real cosToProbe =
        wide::cosineToProbe(dx * query.normal.x + dy * query.normal.y + dz * query.normal.z, length, view.minSpacing);

    const std::int32_t strideY = grid.counts.x, strideZ = grid.counts.x * grid.counts.y;
    const std::int32_t first = std::int32_t(base.x) + strideY * std::int32_t(base.y) + strideZ * std::int32_t(base.z);
    const CageQuery cage{{first, first + 1, first + strideY, first + strideY + 1, first + strideZ, first + strideZ + 1,
                          first + strideZ + strideY, first + strideZ + strideY + 1},
                         {bias.x - dx, bias.y - dy, bias.z - dz}};

    const Real trilinear = wide::trilinearFactor(kCornerX, alpha.x) * wide::trilinearFactor(kCornerY, alpha.y) *
                           wide::trilinearFactor(kCornerZ, alpha.z);
    const Real share([&](auto lane) { return view.backfaceShare[cage.probes[lane]]; });
    const Real weight = wide::crushWeight(wide::backfaceWeight(cosToProbe) * guard(view, cage)) * trilinear *
                        wide::outsideWeight(share);
    const float weightSum = wide::stdx::reduce(weight);

    const int size = view.desc->irradianceTexels;
    const Footprint footprint = irradianceFootprint(view, query.normal);
    Texel sum = 0.0f;
    for (int lane = 0; lane < wide::kLanes; ++lane) {
        const std::size_t texels = std::size_t(cage.probes[std::size_t(lane)]) * std::size_t(size * size);
        const Texel stored = storedIrradiance(view.irradiance + 3 * texels, footprint);
        // kernels::decodeToBlendSpace, four channels abreast.
        sum += float(weight[lane]) * (stored * stored * wide::stdx::sqrt(stored));
    }
    if (weightSum >= kernels::kDoubtful) {
        sum /= weightSum;
        return glm::vec3(sum[0] * sum[0], sum[1] * sum[1], sum[2] * sum[2]) * kernels::kPi;
    }
    if (view.fallbacks) view.fallbacks->fetch_add(1, std::memory_order_relaxed);
    return kernels::completedByNeighbours({sum[0], sum[1], sum[2]}, weightSum,
                                          queryNeighbours(view, query, bias, local));
}

template <class Guard>
void queryAll(const FieldView& view, std::span<const FieldQuery> queries, std::span<glm::vec3> out) {
    const Guard guard;
    for (std::size_t i = 0; i < queries.size(); ++i) out[i] = queryOne(view, queries[i], guard);
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
    switch (view.desc->guard) {
        case LeakGuard::none:
            return queryAll<NoGuard>(view, queries, out);
        case LeakGuard::moments:
            return queryAll<MomentsGuard>(view, queries, out);
    }
}

glm::vec3 probeIrradiance(const FieldView& view, int probe, glm::vec3 normal) {
    const int size = view.desc->irradianceTexels;
    const Footprint footprint = irradianceFootprint(view, normal);
    const std::size_t texels = std::size_t(probe) * std::size_t(size * size);
    return decoded(storedIrradiance(view.irradiance + 3 * texels, footprint));
}

glm::vec2 probeMoments(const FieldView& view, int probe, glm::vec3 direction) {
    const int size = view.desc->visibilityTexels;
    const Footprint f = footprintOf(*view.visibilityTaps, size, direction);
    const std::uint32_t* map = view.visibility + std::size_t(probe) * std::size_t(size * size);
    glm::vec2 moments(0.0f);
    for (int tap = 0; tap < 4; ++tap) {
        const std::uint32_t packed = map[f.offset[tap]];
        moments += f.weight[tap] * kernels::unpackMoments(packed);
    }
    return moments;
}

}  // namespace probegi

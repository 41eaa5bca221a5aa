// The eight probes around a point, for as many points abreast as the processor's vectors hold: Highway compiles this
// file once for each instruction set. What differs from point to point in kind (the maps' texels, three channels in a
// row) is read point by point.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cpu/query_lanes.cpp"  // NOLINT
#include <hwy/foreach_target.h>                   // IWYU pragma: keep

#include <hwy/highway.h>

#include <algorithm>
#include <array>

#include "cpu/query_lanes.h"
#include "kernels/lookup/probe_neighbours.h"
#include "kernels/probe/storage.h"

#include "cpu/footprint-inl.h"
#include "cpu/lanes-inl.h"
#include "cpu/leak_guards-inl.h"

HWY_BEFORE_NAMESPACE();
namespace probegi::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
namespace lanes = kernels::HWY_NAMESPACE;
using lanes::Int;
using lanes::kLanes;
using lanes::Mask;
using lanes::Real;
using lanes::Real3;

using Reals = std::array<float, kLanes>;        // one number of each point
using Ints = std::array<std::int32_t, kLanes>;  // the same

// A block of points, and what is known of each.
struct alignas(64) Block {
    std::array<Reals, 3> position, normal, toViewer;
    std::array<Ints, 4> offset;       // the normal's footprint: halves from the beginning of a probe's map
    std::array<Reals, 4> tapWeight;   // and its weights, times kHalfRebase
    std::array<Ints, 8> probe;        // the cage's
    std::array<Reals, 8> weight;      // and their weights
    std::array<Ints, 4> front;        // corners of the cage in front of the surface
    std::array<Reals, 4> pair;        // weight of each with the probe beyond it
    Ints step;                        // from a probe in front to the one beyond, in probe numbers
    std::array<Reals, 3> root, rise;  // weighted sums, for kernels/lookup/surface_gradient.h
};

// One texel's three channels (and whatever follows).
constexpr hn::FixedTag<float, 4> kTexel;
using Texel = hn::Vec<decltype(kTexel)>;

// kernels::unpackHalf, four abreast, but for the factor kHalfRebase, which the weights of the footprint bring: a power
// of two changes no rounding.
HWY_INLINE Texel loadTexel(const std::uint16_t* halves) {
    constexpr hn::FixedTag<std::uint16_t, 4> kHalves;
    constexpr hn::FixedTag<std::uint32_t, 4> kBits;
    return hn::BitCast(kTexel, hn::ShiftLeft<13>(hn::PromoteTo(kBits, hn::LoadU(kHalves, halves))));
}

// The footprint of one point's normal in the irradiance maps.
struct Footprint4 {
    std::array<std::int32_t, 4> offset;
    std::array<Texel, 4> weight;
};

// What one probe stores at a footprint, in the space of kernels::decodeToBlendSpace.
HWY_INLINE Texel storedRoot(const std::uint16_t* map, const Footprint4& f) {
    const Texel top =
        hn::MulAdd(f.weight[1], loadTexel(map + f.offset[1]), hn::Mul(f.weight[0], loadTexel(map + f.offset[0])));
    const Texel bottom =
        hn::MulAdd(f.weight[3], loadTexel(map + f.offset[3]), hn::Mul(f.weight[2], loadTexel(map + f.offset[2])));
    const Texel s = hn::Add(top, bottom);
    return hn::Mul(hn::Mul(s, s), hn::Sqrt(s));
}

// Past the last query its neighbour is repeated.
HWY_INLINE void transpose(std::span<const FieldQuery> queries, Block& block) {
    for (std::size_t i = 0; i < kLanes; ++i) {
        const FieldQuery& q = queries[std::min(i, queries.size() - 1)];
        for (int c = 0; c < 3; ++c) {
            block.position[std::size_t(c)][i] = q.position[c];
            block.normal[std::size_t(c)][i] = q.normal[c];
            block.toViewer[std::size_t(c)][i] = q.toViewer[c];
        }
    }
}

HWY_INLINE Real3 load(const std::array<Reals, 3>& v) {
    return {lanes::load(v[0].data()), lanes::load(v[1].data()), lanes::load(v[2].data())};
}

HWY_INLINE void findFootprints(const FieldView& view, const Real3& normal, Block& block) {
    const LaneFootprint f = footprintOf(*view.irradianceTaps, view.desc->irradianceTexels, normal);
    for (std::size_t tap = 0; tap < 4; ++tap) lanes::store(f.tap[tap] * Int(3), block.offset[tap].data());
    const Real y1 = f.fy * kernels::kHalfRebase, y0 = Real(kernels::kHalfRebase) - y1;
    lanes::store(y0 - f.fx * y0, block.tapWeight[0].data());
    lanes::store(f.fx * y0, block.tapWeight[1].data());
    lanes::store(y1 - f.fx * y1, block.tapWeight[2].data());
    lanes::store(f.fx * y1, block.tapWeight[3].data());
}

// What the way back to the surface needs of a block's cages.
struct Cages {
    Int first;          // lowest probe
    Real3 base, alpha;  // its place, and the points' in the cage
    Real weightSum;     // of the eight probes
    Real ahead;         // weighted mean of their distance to the surface's plane, metres
};

// Steps 1 to 3 of section 2.2 for the eight probes around each point.
template <int rules, class Guard>
HWY_INLINE Cages weighProbes(const FieldView& view, const Guard& guard, const Real3& normal, Block& block) {
    const kernels::Volume& grid = view.volumes[0];
    const float biasScale = view.settings->selfShadowBias;
    const Real3 toViewer = lanes::viewerOf(load(block.toViewer), normal);
    const Real3 position = lanes::clampToGrid(load(block.position), grid.origin, grid.spacing, grid.counts);
    const Real3 bias = lanes::visibilityBias(normal, toViewer, grid.minSpacing, biasScale, rules);
    // The cage and the trilinear weights belong to a point a little off the surface: on a wall that runs through a
    // layer of probes the answer would otherwise lean on that layer alone.
    const Real3 local =
        lanes::gridCoordinates(position + lanes::cageBias(normal, toViewer, grid.minSpacing, biasScale, rules),
                               grid.origin, grid.inverseSpacing);
    const Real3 base = lanes::cageBase(local, grid.counts);
    const Real3 alpha = lanes::cageAlpha(local, base);
    const Real3 toBase = base * grid.spacing - (position - grid.origin);
    const std::int32_t strideY = grid.counts.x, strideZ = grid.counts.x * grid.counts.y;
    const Int first = lanes::toInt(base.x) + lanes::toInt(base.y) * Int(strideY) + lanes::toInt(base.z) * Int(strideZ);

    Real weightSum = 0.0f, ahead = 0.0f;
    for (int corner = 0; corner < 8; ++corner) {
        const int x = corner & 1, y = corner >> 1 & 1, z = corner >> 2;
        const Real3 d = toBase + Real3(glm::vec3(x, y, z) * grid.spacing);
        const Real length = lanes::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
        const Real product = d.x * normal.x + d.y * normal.y + d.z * normal.z;
        const Real facing = lanes::backfaceWeight(lanes::cosineToProbe(product, length, grid.minSpacing), rules);
        const Int probe = first + Int(x + y * strideY + z * strideZ);
        const Real trilinear = lanes::trilinearFactor(float(x), alpha.x) * lanes::trilinearFactor(float(y), alpha.y) *
                               lanes::trilinearFactor(float(z), alpha.z);
        const Real weight = lanes::crushWeight(facing * guard.seen(probe, bias - d)) * trilinear *
                            lanes::outsideWeight(lanes::gather(view.backfaceShare, probe), rules);
        weightSum = weightSum + weight;
        ahead = ahead + weight * product;
        lanes::store(probe, block.probe[std::size_t(corner)].data());
        lanes::store(weight, block.weight[std::size_t(corner)].data());
    }
    return {first, base, alpha, weightSum, ahead / weightSum};
}

// How light changes along the normal (kernels/lookup/surface_gradient.h).
struct Gradients {
    Real pairWeight;  // sum over the pairs
    Real cells;       // by which the light was read in front of the surface
    Real trust;       // 0 where nothing is known of the layer beyond
};

HWY_INLINE Real component(const Int& axis, const Real3& v) {
    return lanes::select(axis == Int(0), v.x, lanes::select(axis == Int(1), v.y, v.z));
}

template <class Guard>
HWY_INLINE Gradients weighPairs(const FieldView& view, const Guard& guard, const Real3& normal, const Cages& cages,
                                Block& block) {
    const kernels::Volume& grid = view.volumes[0];
    const Int axis = lanes::dominantAxis(normal);
    const Mask alongX = axis == Int(0), alongZ = axis == Int(2);
    const Real onAxis = component(axis, normal);
    const Mask up = onAxis > 0.0f;
    const Real beyond = component(axis, cages.base) + lanes::select(up, Real(2.0f), Real(-1.0f));
    const Mask known = beyond >= 0.0f && beyond < component(axis, Real3(glm::vec3(grid.counts))) && cages.ahead > 0.0f;
    const Real trust = lanes::select(known, lanes::axisTrust(normal), Real(0.0f));
    lanes::store(Int(0), block.step.data());
    if (!lanes::anyOf(trust > 0.0f)) return {0.0f, 0.0f, 0.0f};

    const std::int32_t strideY = grid.counts.x, strideZ = grid.counts.x * grid.counts.y;
    const Int stride = lanes::select(alongX, Int(1), lanes::select(alongZ, Int(strideZ), Int(strideY)));
    const Int bit = lanes::select(alongX, Int(1), lanes::select(alongZ, Int(4), Int(2)));
    // The two other axes, in bits of a corner and in probe numbers.
    const Int uBit = lanes::select(alongX, Int(2), Int(1)), vBit = lanes::select(alongZ, Int(2), Int(4));
    const Int uStride = lanes::select(alongX, Int(strideY), Int(1));
    const Int vStride = lanes::select(alongZ, Int(strideY), Int(strideZ));
    const Int step = lanes::select(known, lanes::select(up, stride, Int(0) - stride), Int(0));
    const Int frontCorner = lanes::select(up, bit, Int(0));
    const Int frontProbe = cages.first + lanes::select(up, stride, Int(0));
    const auto along = guard.along(axis + axis + lanes::select(up, Int(1), Int(0)));
    const Real spacing = component(axis, Real3(grid.spacing));
    // The pair's weight is that of the probe in front, without the share that the point's depth gives to its layer.
    const Real depth = component(axis, cages.alpha);
    const Real alongAxis = Real(1.0f) / lanes::trilinearFactor(1.0f, lanes::select(up, depth, Real(1.0f) - depth));
    const Int lane = Int(hn::Iota(lanes::kInts, 0));
    lanes::store(step, block.step.data());

    Real pairWeight = 0.0f;
    for (std::size_t i = 0; i < 4; ++i) {
        Int corner = frontCorner, probe = frontProbe;
        if (i & 1) corner = corner + uBit, probe = probe + uStride;
        if (i & 2) corner = corner + vBit, probe = probe + vStride;
        const Real weight = lanes::gather(block.weight[0].data(), corner * Int(kLanes) + lane);
        const Real outside =
            lanes::outsideWeight(lanes::gather(view.backfaceShare, probe + step), kernels::kRulesMeasured);
        const Real pair = weight * alongAxis * outside * guard.between(probe, along, spacing);
        pairWeight = pairWeight + pair;
        lanes::store(corner, block.front[i].data());
        lanes::store(pair, block.pair[i].data());
    }
    return {pairWeight, lanes::cellsAhead(cages.ahead, spacing, onAxis), trust};
}

// Weighted sums of what the probes of one point's cage store, and of what those beyond have more.
HWY_INLINE void gatherLight(const FieldView& view, std::size_t i, bool beyond, Block& block) {
    const std::size_t halvesPerProbe = 3 * std::size_t(view.desc->irradianceTexels * view.desc->irradianceTexels);
    Footprint4 f;
    for (std::size_t tap = 0; tap < 4; ++tap) {
        f.offset[tap] = block.offset[tap][i];
        f.weight[tap] = hn::Set(kTexel, block.tapWeight[tap][i]);
    }
    std::array<Texel, 8> roots;
    Texel root = hn::Zero(kTexel);
    for (std::size_t corner = 0; corner < 8; ++corner) {
        roots[corner] = storedRoot(view.irradiance + std::size_t(block.probe[corner][i]) * halvesPerProbe, f);
        root = hn::MulAdd(hn::Set(kTexel, block.weight[corner][i]), roots[corner], root);
    }
    alignas(16) std::array<float, 4> sum;
    hn::Store(root, kTexel, sum.data());
    for (std::size_t c = 0; c < 3; ++c) block.root[c][i] = sum[c];
    if (!beyond) return;

    Texel rise = hn::Zero(kTexel);
    for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t corner = std::size_t(block.front[k][i]);
        const std::size_t probe = std::size_t(block.probe[corner][i] + block.step[i]);
        const Texel more = hn::Sub(storedRoot(view.irradiance + probe * halvesPerProbe, f), roots[corner]);
        rise = hn::MulAdd(hn::Set(kTexel, block.pair[k][i]), more, rise);
    }
    hn::Store(rise, kTexel, sum.data());
    for (std::size_t c = 0; c < 3; ++c) block.rise[c][i] = sum[c];
}

template <int rules, class Guard>
HWY_INLINE void answer(const FieldView& view, const Guard& guard, std::span<const FieldQuery> queries, Block& block,
                       CageAnswer* out) {
    transpose(queries, block);
    const Real3 normal = load(block.normal);
    findFootprints(view, normal, block);
    const Cages cages = weighProbes<rules>(view, guard, normal, block);
    Gradients gradients{0.0f, 0.0f, 0.0f};
    if constexpr (rules == kernels::kRulesMeasured) gradients = weighPairs(view, guard, normal, cages, block);
    alignas(64) Reals weightSum, known;
    lanes::store(cages.weightSum, weightSum.data());
    lanes::store(gradients.trust * gradients.pairWeight, known.data());
    for (std::size_t i = 0; i < queries.size(); ++i) gatherLight(view, i, known[i] > 0.0f, block);

    const Real inverse = Real(1.0f) / cages.weightSum;
    for (std::size_t c = 0; c < 3; ++c) {
        Real root = lanes::load(block.root[c].data()) * inverse;
        if constexpr (rules == kernels::kRulesMeasured)
            root = lanes::rootAtSurface(root, lanes::load(block.rise[c].data()), gradients.pairWeight, gradients.cells,
                                        gradients.trust);
        lanes::store(root * root * kernels::kPi, block.rise[c].data());
    }
    for (std::size_t i = 0; i < queries.size(); ++i) {
        out[i].irradiance = {block.rise[0][i], block.rise[1][i], block.rise[2][i]};
        out[i].root = {block.root[0][i], block.root[1][i], block.root[2][i]};
        out[i].weightSum = weightSum[i];
    }
}

template <int rules, class Guard>
void answerAll(const FieldView& view, std::span<const FieldQuery> queries, CageAnswer* out) {
    const Guard guard(view);
    Block block{};
    for (std::size_t begin = 0; begin < queries.size(); begin += kLanes)
        answer<rules>(view, guard, queries.subspan(begin, std::min(kLanes, queries.size() - begin)), block,
                      out + begin);
}

template <int rules>
void answerBy(const FieldView& view, std::span<const FieldQuery> queries, CageAnswer* out) {
    switch (view.settings->guard) {
        case LeakGuard::none:
            return answerAll<rules, NoGuard>(view, queries, out);
        case LeakGuard::moments:
            return answerAll<rules, MomentsGuard<rules>>(view, queries, out);
    }
}

}  // namespace

void answerFromCages(const FieldView& view, std::span<const FieldQuery> queries, CageAnswer* out) {
    if (view.desc->rules == FieldRules::paper) return answerBy<kernels::kRulesPaper>(view, queries, out);
    return answerBy<kernels::kRulesMeasured>(view, queries, out);
}

std::string_view instructionSetHere() {
    return hwy::TargetName(HWY_TARGET);
}

}  // namespace probegi::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace probegi {

HWY_EXPORT(answerFromCages);
HWY_EXPORT(instructionSetHere);

void answerFromCages(const FieldView& view, std::span<const FieldQuery> queries, CageAnswer* out) {
    HWY_DYNAMIC_DISPATCH(answerFromCages)(view, queries, out);
}

std::string_view instructionSet() noexcept {
    return HWY_DYNAMIC_DISPATCH(instructionSetHere)();
}

}  // namespace probegi
#endif

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
#include "field/guard_number.h"
#include "kernels/probe/storage.h"

#include "cpu/footprint-inl.h"
#include "cpu/lane_access-inl.h"
#include "cpu/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace probegi::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
namespace lanes = kernels::HWY_NAMESPACE;
using lanes::CageWeights;
using lanes::Int;
using lanes::kLanes;
using lanes::Real;
using lanes::Real3;

using Reals = std::array<float, kLanes>;        // one number of each point
using Ints = std::array<std::int32_t, kLanes>;  // the same

// A block of points, and what is known of each.
struct alignas(64) Block {
    std::array<Reals, 3> position, normal, toViewer;
    std::array<Ints, 4> offset;       // the normal's footprint: halves from the beginning of a probe's map
    std::array<Reals, 4> tapWeight;   // and its weights, times kHalfRebase
    std::array<Reals, 3> root, rise;  // weighted sums
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
    const LaneFootprint f = footprintOf(*view.irradianceTaps, view.irradianceTexels, normal);
    for (std::size_t tap = 0; tap < 4; ++tap) lanes::store(f.tap[tap] * Int(3), block.offset[tap].data());
    const Real y1 = f.fy * kernels::kHalfRebase, y0 = Real(kernels::kHalfRebase) - y1;
    lanes::store(y0 - f.fx * y0, block.tapWeight[0].data());
    lanes::store(f.fx * y0, block.tapWeight[1].data());
    lanes::store(y1 - f.fx * y1, block.tapWeight[2].data());
    lanes::store(f.fx * y1, block.tapWeight[3].data());
}

// Weighted sums of what the probes of one point's cage store, and of what those beyond have more.
HWY_INLINE void gatherLight(const FieldView& view, const CageWeights& w, std::size_t i, bool beyond, Block& block) {
    const std::size_t halvesPerProbe = 3 * std::size_t(view.irradianceTexels * view.irradianceTexels);
    Footprint4 f;
    for (std::size_t tap = 0; tap < 4; ++tap) {
        f.offset[tap] = block.offset[tap][i];
        f.weight[tap] = hn::Set(kTexel, block.tapWeight[tap][i]);
    }
    std::array<Texel, 8> roots;
    Texel root = hn::Zero(kTexel);
    for (std::size_t corner = 0; corner < 8; ++corner) {
        roots[corner] = storedRoot(view.irradiance + std::size_t(lanes::laneOf(w.slot[corner], i)) * halvesPerProbe, f);
        root = hn::MulAdd(hn::Set(kTexel, lanes::laneOf(w.weight[corner], i)), roots[corner], root);
    }
    alignas(16) std::array<float, 4> sum;
    hn::Store(root, kTexel, sum.data());
    for (std::size_t c = 0; c < 3; ++c) block.root[c][i] = sum[c];
    if (!beyond) return;

    const std::int32_t step = lanes::laneOf(w.step, i);
    Texel rise = hn::Zero(kTexel);
    for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t corner = std::size_t(lanes::laneOf(w.front[k], i));
        const std::size_t beyondIt = std::size_t(lanes::laneOf(w.slot[corner], i) + step);
        const Texel more = hn::Sub(storedRoot(view.irradiance + beyondIt * halvesPerProbe, f), roots[corner]);
        rise = hn::MulAdd(hn::Set(kTexel, lanes::laneOf(w.pair[k], i)), more, rise);
    }
    hn::Store(rise, kTexel, sum.data());
    for (std::size_t c = 0; c < 3; ++c) block.rise[c][i] = sum[c];
}

template <class Access>
HWY_INLINE void answer(const FieldView& view, const Access& access, const kernels::Volume& volume,
                       std::span<const FieldQuery> queries, Block& block, CageAnswer* out) {
    transpose(queries, block);
    const Real3 normal = load(block.normal);
    findFootprints(view, normal, block);
    const lanes::Cage cage = lanes::cageAround(volume, load(block.position), normal, load(block.toViewer),
                                               access.selfShadowBias, access.rules);
    const CageWeights w = lanes::weighCage(access, volume, cage);
    alignas(64) Reals weightSum, known;
    lanes::store(w.weightSum, weightSum.data());
    lanes::store(w.trust * w.pairSum, known.data());
    for (std::size_t i = 0; i < queries.size(); ++i) gatherLight(view, w, i, known[i] > 0.0f, block);

    const Real inverse = Real(1.0f) / w.weightSum;
    for (std::size_t c = 0; c < 3; ++c) {
        const Real root = lanes::load(block.root[c].data()), rise = lanes::load(block.rise[c].data());
        lanes::store(lanes::irradianceAtSurface(w, root, rise, inverse, access.rules), block.rise[c].data());
    }
    for (std::size_t i = 0; i < queries.size(); ++i) {
        out[i].irradiance = {block.rise[0][i], block.rise[1][i], block.rise[2][i]};
        out[i].root = {block.root[0][i], block.root[1][i], block.root[2][i]};
        out[i].weightSum = weightSum[i];
    }
}

template <bool turned, class Access>
void answerAll(const FieldView& view, kernels::Volume volume, std::span<const FieldQuery> queries, CageAnswer* out) {
    volume.turned = turned ? 1 : 0;
    const Access access(view);
    Block block{};
    for (std::size_t begin = 0; begin < queries.size(); begin += kLanes)
        answer(view, access, volume, queries.subspan(begin, std::min(kLanes, queries.size() - begin)), block,
               out + begin);
}

template <int rules, bool turned>
void answerBy(const FieldView& view, const kernels::Volume& volume, std::span<const FieldQuery> queries,
              CageAnswer* out) {
    switch (guardNumber(view.guard)) {
#define GUARD(number, point, seen, between, origin, farther) \
    case number:                                             \
        return answerAll<turned, LaneAccess<rules, number>>(view, volume, queries, out);
        PROBEGI_GUARDS(GUARD)
#undef GUARD
    }
    // As in shaders: a number that is not in the list guards nothing.
    answerAll<turned, LaneAccess<rules, guardNumber(LeakGuard::none)>>(view, volume, queries, out);
}

template <int rules>
void answerTurned(const FieldView& view, const kernels::Volume& volume, std::span<const FieldQuery> queries,
                  CageAnswer* out) {
    if (volume.turned != 0) return answerBy<rules, true>(view, volume, queries, out);
    return answerBy<rules, false>(view, volume, queries, out);
}

}  // namespace

void answerFromCages(const FieldView& view, const kernels::Volume& volume, std::span<const FieldQuery> queries,
                     CageAnswer* out) {
    if (view.rules == FieldRules::paper) return answerTurned<kernels::kRulesPaper>(view, volume, queries, out);
    return answerTurned<kernels::kRulesMeasured>(view, volume, queries, out);
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

void answerFromCages(const FieldView& view, const kernels::Volume& volume, std::span<const FieldQuery> queries,
                     CageAnswer* out) {
    HWY_DYNAMIC_DISPATCH(answerFromCages)(view, volume, queries, out);
}

std::string_view instructionSet() noexcept {
    return HWY_DYNAMIC_DISPATCH(instructionSetHere)();
}

}  // namespace probegi
#endif

// Exact hits of boxes, as many rays abreast as the processor's vectors hold: Highway compiles this file once for each
// instruction set. Rays of a packet with one direction (those that an update traces side by side) first drop all boxes
// that none of them can meet.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cpu/sdf_lanes.cpp"  // NOLINT
#include <hwy/foreach_target.h>                 // IWYU pragma: keep
//
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "cpu/sdf_lanes.h"
#include "kernels/sdf/union_hit.h"
#include "probegi/sdf.h"

HWY_BEFORE_NAMESPACE();
namespace probegi::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

constexpr hn::ScalableTag<float> kFloats;
constexpr hn::RebindToSigned<decltype(kFloats)> kInts;
constexpr std::size_t kLanes = HWY_LANES(float);
using Floats = hn::Vec<decltype(kFloats)>;
using Ints = hn::Vec<decltype(kInts)>;
using Lanes = hn::Mask<decltype(kFloats)>;  // a set of them
using Box = SdfLanes::Box;

/// Coordinates beyond this are not finite enough for squares; rays that have such hit nothing.
constexpr float kLargest = 1.8e18f;

HWY_INLINE Floats all(float value) {
    return hn::Set(kFloats, value);
}

struct Floats3 {
    Floats x, y, z;
};

HWY_INLINE Floats dot(const glm::vec3& a, const Floats3& b) {
    return hn::MulAdd(all(a.z), b.z, hn::MulAdd(all(a.y), b.y, hn::Mul(all(a.x), b.x)));
}

/// Rays in lanes.
struct Packet {
    Floats3 origin, direction, inverse;
    Floats near, far;  // far < near: hits nothing
};

/// Distances at which lanes enter and leave a box.
struct Spans {
    Floats entry, exit;
};

/// Reciprocal of a direction's component, as kernels::bvhInverse.
HWY_INLINE Floats inverseOf(Floats component, Floats largest) {
    const Floats tiny = hn::CopySign(hn::Mul(largest, all(1e-18f)), component);
    const Floats used = hn::IfThenElse(hn::Gt(hn::Abs(component), hn::Abs(tiny)), component, tiny);
    return hn::Div(all(1.0f), used);
}

HWY_INLINE Floats3 inverseOf(const Floats3& d) {
    const Floats largest = hn::Max(hn::Abs(d.x), hn::Max(hn::Abs(d.y), hn::Abs(d.z)));
    return {inverseOf(d.x, largest), inverseOf(d.y, largest), inverseOf(d.z, largest)};
}

HWY_INLINE Lanes usable(const Packet& p) {
    const Floats3 o = p.origin, d = p.direction;
    const Floats farthest = hn::Max(hn::Abs(o.x), hn::Max(hn::Abs(o.y), hn::Abs(o.z)));
    const Floats longest = hn::Max(hn::Abs(d.x), hn::Max(hn::Abs(d.y), hn::Abs(d.z)));
    // A sum has what the maximum may lose: NaN.
    const Floats sum = hn::Add(hn::Add(hn::Abs(o.x), hn::Add(hn::Abs(o.y), hn::Abs(o.z))),
                               hn::Add(hn::Abs(d.x), hn::Add(hn::Abs(d.y), hn::Abs(d.z))));
    const Lanes sizes = hn::And(hn::Le(farthest, all(kLargest)), hn::Le(longest, all(kLargest)));
    const Lanes numbers = hn::And(hn::Le(sum, all(8 * kLargest)), hn::Gt(longest, all(0.0f)));
    return hn::And(hn::And(sizes, numbers), hn::Le(p.near, p.far));
}

/// The first rays of `rays`, which are at least one; lanes without a ray repeat the last.
HWY_INLINE Packet load(std::span<const Ray> rays) {
    alignas(64) float values[8][kLanes];
    for (std::size_t i = 0; i < kLanes; ++i) {
        const Ray& ray = rays[std::min(i, rays.size() - 1)];
        values[0][i] = ray.origin.x;
        values[1][i] = ray.origin.y;
        values[2][i] = ray.origin.z;
        values[3][i] = std::max(0.0f, ray.near);
        values[4][i] = ray.direction.x;
        values[5][i] = ray.direction.y;
        values[6][i] = ray.direction.z;
        values[7][i] = ray.far;
    }
    const auto row = [&](int number) HWY_ATTR { return hn::Load(kFloats, values[number]); };
    Packet p;
    p.origin = {row(0), row(1), row(2)};
    p.direction = {row(4), row(5), row(6)};
    p.inverse = inverseOf(p.direction);
    p.near = row(3);
    p.far = row(7);
    const Lanes use = usable(p);
    p.far = hn::IfThenElse(use, hn::Min(p.far, all(kernels::kSdfFar)), all(-1.0f));
    // What is not a number must not spoil the bounds of the others' origins.
    p.origin = {hn::IfThenElseZero(use, p.origin.x), hn::IfThenElseZero(use, p.origin.y),
                hn::IfThenElseZero(use, p.origin.z)};
    return p;
}

HWY_INLINE Spans slabs(const Floats3& middle, const Floats3& inverse, glm::vec3 halfSize) {
    const Floats rx = hn::Abs(inverse.x), ry = hn::Abs(inverse.y), rz = hn::Abs(inverse.z);
    const Floats hx = all(halfSize.x), hy = all(halfSize.y), hz = all(halfSize.z);
    Spans s;
    s.entry = hn::Max(hn::NegMulAdd(hx, rx, middle.x),
                      hn::Max(hn::NegMulAdd(hy, ry, middle.y), hn::NegMulAdd(hz, rz, middle.z)));
    s.exit = hn::Min(hn::MulAdd(hx, rx, middle.x), hn::Min(hn::MulAdd(hy, ry, middle.y), hn::MulAdd(hz, rz, middle.z)));
    return s;
}

HWY_INLINE Spans spansOfAligned(const Packet& p, const Box& box) {
    return slabs({hn::Mul(hn::Sub(all(box.centre.x), p.origin.x), p.inverse.x),
                  hn::Mul(hn::Sub(all(box.centre.y), p.origin.y), p.inverse.y),
                  hn::Mul(hn::Sub(all(box.centre.z), p.origin.z), p.inverse.z)},
                 p.inverse, box.halfSize);
}

/// 1 / x for |x| from 1e-18 on, to two units in the last place: one step of Newton's method doubles the digits.
HWY_INLINE Floats reciprocal(Floats x) {
    const Floats used = hn::CopySign(hn::Max(hn::Abs(x), all(1e-18f)), x);
    const Floats guess = hn::ApproximateReciprocal(used);
    return hn::Mul(guess, hn::NegMulAdd(used, guess, all(2.0f)));
}

HWY_INLINE Spans spansOfTurned(const Packet& p, const Box& box) {
    const Floats3 to = {hn::Sub(all(box.centre.x), p.origin.x), hn::Sub(all(box.centre.y), p.origin.y),
                        hn::Sub(all(box.centre.z), p.origin.z)};
    const Floats3 inverse = {reciprocal(dot(box.axes[0], p.direction)), reciprocal(dot(box.axes[1], p.direction)),
                             reciprocal(dot(box.axes[2], p.direction))};
    return slabs({hn::Mul(dot(box.axes[0], to), inverse.x), hn::Mul(dot(box.axes[1], to), inverse.y),
                  hn::Mul(dot(box.axes[2], to), inverse.z)},
                 inverse, box.halfSize);
}

/// Lane i as bit i.
HWY_INLINE std::uint32_t bitsOf(Lanes lanes) {
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(kFloats, lanes, bytes);
    return (std::uint32_t(bytes[0]) | std::uint32_t(bytes[1]) << 8) & ((std::uint32_t(1) << kLanes) - 1);
}

/// Of the shape in the box, for the lanes that meet the box before `far`; the others miss it, whatever rounding says.
/// The loop over all lanes, which the compiler makes vectors of, is faster than one over those that meet.
HWY_NOINLINE Spans spansOfOther(const Packet& p, const SdfLanes& scene, const Box& box, Spans around, Floats far) {
    const Lanes meet = hn::And(hn::Le(hn::Max(around.entry, p.near), around.exit), hn::Le(around.entry, far));
    const Spans none{all(kernels::kSdfFar), all(-kernels::kSdfFar)};
    if (hn::AllFalse(kFloats, meet)) return none;
    alignas(64) float o[3][kLanes], d[3][kLanes], entry[kLanes], exit[kLanes];
    hn::Store(p.origin.x, kFloats, o[0]);
    hn::Store(p.origin.y, kFloats, o[1]);
    hn::Store(p.origin.z, kFloats, o[2]);
    hn::Store(p.direction.x, kFloats, d[0]);
    hn::Store(p.direction.y, kFloats, d[1]);
    hn::Store(p.direction.z, kFloats, d[2]);
    const kernels::SdfSolid& solid = scene.solid(box.solid);
    for (std::size_t i = 0; i < kLanes; ++i) {
        const kernels::SdfSpan span =
            kernels::sdfRaySpan(solid, {o[0][i], o[1][i], o[2][i]}, {d[0][i], d[1][i], d[2][i]});
        entry[i] = span.entry;
        exit[i] = span.exit;
    }
    return {hn::IfThenElse(meet, hn::Load(kFloats, entry), none.entry),
            hn::IfThenElse(meet, hn::Load(kFloats, exit), none.exit)};
}

/// Which boxes a packet may meet: a bit for each.
struct Candidates {
    static constexpr std::size_t kWords = (std::size_t(kMaxSdfPrimitives) + 63) / 64;
    std::uint64_t bits[kWords];
    bool chosen = false;  // else all of them
};

/// Whether all lanes have the first one's direction.
HWY_INLINE bool oneDirection(const Packet& p) {
    const auto same = [](Floats v) HWY_ATTR { return hn::Eq(v, all(hn::GetLane(v))); };
    return hn::AllTrue(kFloats, hn::And(same(p.direction.x), hn::And(same(p.direction.y), same(p.direction.z))));
}

/// Smallest and largest of the lanes.
struct Range {
    float lower, upper;
    float middle() const { return 0.5f * (lower + upper); }
    /// Half its width, and more than rounding could move what begins within.
    float reach() const { return 0.5f * (upper - lower) + 1e-5f * (std::abs(lower) + std::abs(upper)) + 1e-5f; }
};

HWY_INLINE Range rangeOf(Floats v) {
    return {hn::GetLane(hn::MinOfLanes(kFloats, v)), hn::GetLane(hn::MaxOfLanes(kFloats, v))};
}

/// A packet of one direction meets a box only if the ray from the middle of its origins meets the box grown by half
/// their extents: boxes in lanes.
HWY_INLINE void choose(const Packet& p, const SdfLanes& scene, Candidates& candidates) {
    candidates.chosen = oneDirection(p);
    if (!candidates.chosen) return;
    const Range x = rangeOf(p.origin.x), y = rangeOf(p.origin.y), z = rangeOf(p.origin.z);
    const float far = hn::GetLane(hn::MaxOfLanes(kFloats, p.far));
    const float ix = hn::GetLane(p.inverse.x), iy = hn::GetLane(p.inverse.y), iz = hn::GetLane(p.inverse.z);
    const SdfLanes::AroundAll& a = scene.around();
    std::fill_n(candidates.bits, (scene.boxes().size() + 63) / 64, std::uint64_t(0));
    for (std::size_t i = 0; i < a.centre[0].size(); i += kLanes) {
        const auto slab = [&](std::size_t axis, const Range& range, float inverse, Floats& entry,
                              Floats& exit) HWY_ATTR {
            const Floats middle =
                hn::Mul(hn::Sub(hn::LoadU(kFloats, a.centre[axis].data() + i), all(range.middle())), all(inverse));
            const Floats half = hn::Add(hn::LoadU(kFloats, a.halfSize[axis].data() + i), all(range.reach()));
            entry = hn::NegMulAdd(half, all(std::abs(inverse)), middle);
            exit = hn::MulAdd(half, all(std::abs(inverse)), middle);
        };
        Floats ex, ey, ez, lx, ly, lz;
        slab(0, x, ix, ex, lx);
        slab(1, y, iy, ey, ly);
        slab(2, z, iz, ez, lz);
        const Floats entry = hn::Max(hn::Max(ex, ey), hn::Max(ez, hn::Zero(kFloats)));
        const Floats exit = hn::Min(hn::Min(lx, ly), hn::Min(lz, all(far)));
        // Lengths of directions that are not quite unit, and reciprocals, are rounded.
        const Lanes meets = hn::Le(entry, hn::MulAdd(hn::Abs(exit), all(1e-5f), exit));
        candidates.bits[i / 64] |= std::uint64_t(bitsOf(meets)) << (i % 64);
    }
}

/// Calls visit(box, spans) for all candidates, or all boxes, in their order, until it returns true. `far()` is how far
/// spans matter.
template <class Far, class Visit>
HWY_INLINE void visitBoxes(const Packet& p, const SdfLanes& scene, const Candidates& candidates, const Far& far,
                           const Visit& visit) {
    const std::span<const Box> boxes = scene.boxes();
    const auto turned = [&](const Box& box) HWY_ATTR {
        const Spans around = spansOfTurned(p, box);
        return visit(box, box.exact != 0 ? around : spansOfOther(p, scene, box, around, far()));
    };
    if (candidates.chosen) {
        for (std::size_t word = 0; word < (boxes.size() + 63) / 64; ++word) {
            for (std::uint64_t bits = candidates.bits[word]; bits != 0; bits &= bits - 1) {
                const std::size_t number = 64 * word + std::size_t(std::countr_zero(bits));
                const Box& box = boxes[number];
                if (number < scene.aligned() ? visit(box, spansOfAligned(p, box)) : turned(box)) return;
            }
        }
        return;
    }
    for (const Box& box : boxes.first(scene.aligned()))
        if (visit(box, spansOfAligned(p, box))) return;
    for (const Box& box : boxes.subspan(scene.aligned()))
        if (turned(box)) return;
}

/// What lanes found.
struct Found {
    Floats distance;
    Ints solid;  // -1: nothing

    HWY_INLINE Lanes any() const { return hn::RebindMask(kFloats, hn::Gt(solid, hn::Set(kInts, -1))); }
};

/// What a search begins with that ends at the rays' far ends: the next number after them, so that a hit there is
/// nearer.
HWY_INLINE Found nothing(const Packet& p) {
    const Floats beyond = hn::BitCast(kFloats, hn::Add(hn::BitCast(kInts, p.far), hn::Set(kInts, 1)));
    return {hn::IfThenElse(hn::Lt(p.far, all(0.0f)), all(-1.0f), beyond), hn::Set(kInts, -1)};
}

/// Takes what `which` found.
HWY_INLINE void take(Found& found, Lanes which, Floats distance, const Box& box) {
    found.distance = hn::IfThenElse(which, distance, found.distance);
    found.solid = hn::IfThenElse(hn::RebindMask(kInts, which), hn::Set(kInts, box.solid), found.solid);
}

/// The first point of a solid on each lane's way, which is `near` where it begins inside or on the surface.
HWY_INLINE Found firstTouched(const Packet& p, const SdfLanes& scene, const Candidates& candidates) {
    Found found = nothing(p);
    visitBoxes(
        p, scene, candidates, [&]() HWY_ATTR { return found.distance; },
        [&](const Box& box, const Spans& s) HWY_ATTR {
            const Floats first = hn::Max(s.entry, p.near);
            const Lanes hit = hn::And(hn::Le(first, s.exit), hn::Lt(first, found.distance));
            take(found, hit, first, box);
            return false;
        });
    return found;
}

/// Goes from `near` on through solids (kernels::sdfLeave). Lanes that do not begin inside keep -1.
HWY_INLINE Found left(const Packet& p, const SdfLanes& scene, const Candidates& candidates) {
    Found found{p.near, hn::Set(kInts, -1)};
    Floats seam = all(0.0f);
    Lanes inside = hn::Le(p.near, p.far);  // at first, all that are usable may be
    for (bool on = true; on;) {
        on = false;
        visitBoxes(
            p, scene, candidates, []() HWY_ATTR { return all(std::numeric_limits<float>::max()); },
            [&](const Box& box, const Spans& s) HWY_ATTR {
                const Lanes further = hn::And(
                    inside, hn::And(hn::Lt(s.entry, hn::Add(found.distance, seam)), hn::Gt(s.exit, found.distance)));
                take(found, further, s.exit, box);
                on = on || !hn::AllFalse(kFloats, further);
                return false;
            });
        inside = found.any();
        seam = all(kernels::kSdfSeam);
    }
    const Lanes endless = hn::Or(hn::Gt(found.distance, p.far), hn::Ge(found.distance, all(kernels::kSdfFar)));
    found.distance = hn::IfThenElse(hn::And(inside, endless), all(kernels::kSdfFar), found.distance);
    return found;
}

/// The entries at or beyond `near`.
HWY_INLINE Found firstEntered(const Packet& p, const SdfLanes& scene, const Candidates& candidates) {
    Found found = nothing(p);
    visitBoxes(
        p, scene, candidates, [&]() HWY_ATTR { return found.distance; },
        [&](const Box& box, const Spans& s) HWY_ATTR {
            const Lanes hit =
                hn::And(hn::And(hn::Le(s.entry, s.exit), hn::Ge(s.entry, p.near)), hn::Lt(s.entry, found.distance));
            take(found, hit, s.entry, box);
            return false;
        });
    return found;
}

HWY_INLINE Found either(Lanes which, const Found& ifTrue, const Found& ifFalse) {
    return {hn::IfThenElse(which, ifTrue.distance, ifFalse.distance),
            hn::IfThenElse(hn::RebindMask(kInts, which), ifTrue.solid, ifFalse.solid)};
}

/// Hits, and which of them are from within.
struct Hits {
    Found found;
    Lanes within;
};

/// For lanes that touch a solid where they begin: inside, or just on its surface.
HWY_NOINLINE Hits hitsFromSurfaces(const Packet& p, const SdfLanes& scene, const Candidates& candidates) {
    const Found away = left(p, scene, candidates);
    const Lanes inside = away.any();
    Hits hits{either(inside, away, firstEntered(p, scene, candidates)), inside};
    const Lanes endless = hn::And(inside, hn::Ge(hits.found.distance, all(kernels::kSdfFar)));
    hits.found.solid = hn::IfThenElse(hn::RebindMask(kInts, endless), hn::Set(kInts, -1), hits.found.solid);
    return hits;
}

HWY_INLINE Hits hitsOf(const Packet& p, const SdfLanes& scene, Candidates& candidates) {
    choose(p, scene, candidates);
    const Found touched = firstTouched(p, scene, candidates);
    const Lanes hit = touched.any();
    if (hn::AllFalse(kFloats, hn::And(hit, hn::Le(touched.distance, p.near)))) return {touched, hn::Lt(p.near, p.near)};
    return hitsFromSurfaces(p, scene, candidates);
}

/// Lanes that enter a solid, or begin inside and leave them all, between near and far. What lanes find does not depend
/// on each other: one that begins inside may stop at the next entry.
HWY_INLINE Lanes blocked(const Packet& p, const SdfLanes& scene, Candidates& candidates) {
    choose(p, scene, candidates);
    const Lanes unusable = hn::Lt(p.far, p.near);
    Lanes done = unusable, touches = hn::Lt(p.near, p.near);
    visitBoxes(
        p, scene, candidates, [&]() HWY_ATTR { return p.far; },
        [&](const Box&, const Spans& s) HWY_ATTR {
            const Lanes meets = hn::And(hn::Le(s.entry, hn::Min(s.exit, p.far)), hn::Ge(s.exit, p.near));
            const Lanes enters = hn::Ge(s.entry, p.near);
            done = hn::Or(done, hn::And(meets, enters));
            touches = hn::Or(touches, hn::AndNot(enters, meets));
            return hn::AllTrue(kFloats, done);
        });
    const Lanes entered = hn::AndNot(unusable, done);
    if (hn::AllFalse(kFloats, hn::AndNot(done, touches))) return entered;
    return hn::Or(entered, hn::And(touches, hitsFromSurfaces(p, scene, candidates).found.any()));
}

HWY_INLINE void store(const Hits& hits, std::span<Hit> out) {
    alignas(64) float distance[kLanes];
    alignas(64) std::int32_t solid[kLanes], side[kLanes];
    hn::Store(hits.found.distance, kFloats, distance);
    hn::Store(hits.found.solid, kInts, solid);
    hn::Store(hn::IfThenElse(hn::RebindMask(kInts, hits.within), hn::Set(kInts, kernels::kSdfFromWithin),
                             hn::Set(kInts, kernels::kSdfFront)),
              kInts, side);
    for (std::size_t i = 0; i < out.size(); ++i) {
        if (solid[i] < 0) {
            out[i] = Hit{};
        } else {
            out[i] = Hit{distance[i], solid[i], side[i], -1, {0.0f, 0.0f}};
        }
    }
}

}  // namespace

void closestHitsHere(const SdfLanes& scene, std::span<const Ray> rays, std::span<Hit> hits) {
    Candidates candidates;
    for (std::size_t i = 0; i < rays.size(); i += kLanes) {
        const std::size_t count = std::min(kLanes, rays.size() - i);
        store(hitsOf(load(rays.subspan(i, count)), scene, candidates), hits.subspan(i, count));
    }
}

void occludedHere(const SdfLanes& scene, std::span<const Ray> rays, std::span<std::uint8_t> out) {
    Candidates candidates;
    for (std::size_t i = 0; i < rays.size(); i += kLanes) {
        const std::size_t count = std::min(kLanes, rays.size() - i);
        const Lanes found = blocked(load(rays.subspan(i, count)), scene, candidates);
        alignas(64) std::int32_t values[kLanes];
        hn::Store(hn::IfThenElseZero(hn::RebindMask(kInts, found), hn::Set(kInts, 1)), kInts, values);
        for (std::size_t k = 0; k < count; ++k) out[i + k] = std::uint8_t(values[k]);
    }
}

}  // namespace probegi::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace probegi {

HWY_EXPORT(closestHitsHere);
HWY_EXPORT(occludedHere);

void sdfClosestHits(const SdfLanes& lanes, std::span<const Ray> rays, std::span<Hit> hits) {
    HWY_DYNAMIC_DISPATCH(closestHitsHere)(lanes, rays, hits);
}

void sdfOccluded(const SdfLanes& lanes, std::span<const Ray> rays, std::span<std::uint8_t> blocked) {
    HWY_DYNAMIC_DISPATCH(occludedHere)(lanes, rays, blocked);
}

}  // namespace probegi
#endif

// How the look-up's kernels read a field for several points abreast, for the instruction set at hand: see
// cpu/lanes-inl.h.
#if defined(PROBEGI_CPU_LANE_ACCESS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PROBEGI_CPU_LANE_ACCESS_INL_H
#undef PROBEGI_CPU_LANE_ACCESS_INL_H
#else
#define PROBEGI_CPU_LANE_ACCESS_INL_H
#endif

#include "cpu/field_view.h"
#include "cpu/footprint-inl.h"
#include "cpu/footprint.h"
#include "cpu/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace probegi::HWY_NAMESPACE {

/// The Access of kernels/lookup/access.h. Rules and guard are template arguments, so that a query costs what they do
/// and nothing more; for the same reason whoever knows that a volume is not turned says so to the compiler.
template <int kRules, int kGuard>
class LaneAccess {
    using Real = kernels::HWY_NAMESPACE::Real;
    using Real3 = kernels::HWY_NAMESPACE::Real3;
    using Int = kernels::HWY_NAMESPACE::Int;
    using Bool = kernels::HWY_NAMESPACE::Bool;

public:
    using MapPoint = LaneFootprint;
    static constexpr int rules = kRules;
    static constexpr int guard = kGuard;
    float selfShadowBias;
    int maskTexels, maskPacked;
    int blockers;

    explicit LaneAccess(const FieldView& view)
        : selfShadowBias(view.selfShadowBias),
          maskTexels(view.maskTexels),
          maskPacked(view.maskPacked ? 1 : 0),
          blockers(int(view.blockers.size())),
          m_blockers(view.blockers.data()),
          m_masks(reinterpret_cast<const std::int32_t*>(view.maskWords)),
          m_backfaceShare(view.backfaceShare),
          m_placements(reinterpret_cast<const std::int32_t*>(view.placements)),
          m_size(view.visibilityTexels),
          m_half(std::uint32_t(std::uint64_t(view.slots) * std::uint32_t(m_size * m_size) / 2)),
          m_middle(reinterpret_cast<const std::int32_t*>(view.visibility + m_half)),
          m_taps(*view.visibilityTaps) {
        for (int side = 0; side < 6; ++side) {
            const AxisTexels& texels = axisTexels(*view.visibilityTaps, m_size, side / 2, side % 2 == 1);
            for (int tap = 0; tap < 4; ++tap) m_axisTexels[tap][side] = texels[std::size_t(tap)];
        }
    }

    HWY_INLINE friend Real storedBackfaceShare(const LaneAccess& a, const Int& slot) {
        return kernels::HWY_NAMESPACE::gather(a.m_backfaceShare, slot);
    }
    HWY_INLINE friend Int storedPlacement(const LaneAccess& a, const Int& slot) {
        return kernels::HWY_NAMESPACE::gather(a.m_placements, slot);
    }
    HWY_INLINE friend Real givenVisibility(const LaneAccess&, int) { return 1.0f; }

    HWY_INLINE friend Int maskWord(const LaneAccess& a, const Int& number) {
        return kernels::HWY_NAMESPACE::gather(a.m_masks, number);
    }

    HWY_INLINE friend const kernels::SdfBlocker& blockerAt(const LaneAccess& a, int number) {
        return a.m_blockers[number];
    }

    HWY_INLINE friend MapPoint visibilityPoint(const LaneAccess& a, const Real3& direction) {
        return footprintOf(a.m_taps, a.m_size, direction);
    }
    HWY_INLINE friend void storedMoments(const LaneAccess& a, const Int& slot, const MapPoint& at, Real& mean,
                                         Real& meanSquare) {
        namespace lanes = kernels::HWY_NAMESPACE;
        const Int map = a.mapOf(slot);
        const Int t0 = lanes::gather(a.m_middle, map + at.tap[0]);
        const Int t1 = lanes::gather(a.m_middle, map + at.tap[1]);
        const Int t2 = lanes::gather(a.m_middle, map + at.tap[2]);
        const Int t3 = lanes::gather(a.m_middle, map + at.tap[3]);
        mean = bilinear(lowHalves(t0), lowHalves(t1), lowHalves(t2), lowHalves(t3), at.fx, at.fy);
        meanSquare = bilinear(highHalves(t0), highHalves(t1), highHalves(t2), highHalves(t3), at.fx, at.fy);
    }

    /// The axes of a volume that is not turned lie on corners of texels: four texels with equal weights.
    HWY_INLINE friend MapPoint axisPoint(const LaneAccess& a, const kernels::Volume& v, const Int& axis,
                                         const Bool& up) {
        namespace lanes = kernels::HWY_NAMESPACE;
        if (v.turned != 0) return visibilityPoint(a, lanes::axisDirection(v, axis, up));
        const Int side = axis + axis + lanes::select(up, Int(1), Int(0));
        return {{lanes::gather(a.m_axisTexels[0].data(), side), lanes::gather(a.m_axisTexels[1].data(), side),
                 lanes::gather(a.m_axisTexels[2].data(), side), lanes::gather(a.m_axisTexels[3].data(), side)},
                0.5f,
                0.5f};
    }
    HWY_INLINE friend void momentsOnAxis(const LaneAccess& a, const kernels::Volume& v, const Int& slot,
                                         const MapPoint& at, Real& mean, Real& meanSquare) {
        namespace lanes = kernels::HWY_NAMESPACE;
        if (v.turned != 0) return storedMoments(a, slot, at, mean, meanSquare);
        const Int map = a.mapOf(slot);
        // Sums of integers will do.
        Int sum = 0, sumOfSquares = 0;
        for (const Int& tap : at.tap) {
            const Int packed = lanes::gather(a.m_middle, map + tap);
            sum = sum + lanes::lowHalf(packed);
            sumOfSquares = sumOfSquares + lanes::highHalf(packed);
        }
        const Real scale = 0.25f / 65535.0f;
        mean = lanes::toReal(sum) * scale;
        meanSquare = lanes::toReal(sumOfSquares) * scale;
    }

private:
    // Where a slot's map begins, counted from the middle of all maps: so 32 bits with a sign reach 2^32 texels.
    HWY_INLINE Int mapOf(const Int& slot) const { return slot * Int(m_size * m_size) - Int(std::int32_t(m_half)); }

    HWY_INLINE static Real lowHalves(const Int& packed) {
        return kernels::HWY_NAMESPACE::toReal(kernels::HWY_NAMESPACE::lowHalf(packed));
    }
    HWY_INLINE static Real highHalves(const Int& packed) {
        return kernels::HWY_NAMESPACE::toReal(kernels::HWY_NAMESPACE::highHalf(packed));
    }
    HWY_INLINE static Real bilinear(const Real& v0, const Real& v1, const Real& v2, const Real& v3, const Real& fx,
                                    const Real& fy) {
        const Real top = v0 + fx * (v1 - v0);
        const Real bottom = v2 + fx * (v3 - v2);
        return (top + fy * (bottom - top)) * (1.0f / 65535.0f);
    }

    const kernels::SdfBlocker* m_blockers;
    const std::int32_t* m_masks;
    const float* m_backfaceShare;
    const std::int32_t* m_placements;
    int m_size;  // texels a side
    std::uint32_t m_half;
    const std::int32_t* m_middle;
    const TapTable& m_taps;
    std::array<std::array<std::int32_t, 6>, 4> m_axisTexels;  // [tap][side]
};

}  // namespace probegi::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif

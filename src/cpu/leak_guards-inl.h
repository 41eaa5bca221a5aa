// Leak guards of the query, for the instruction set at hand: see cpu/lanes-inl.h.
#if defined(PROBEGI_CPU_LEAK_GUARDS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PROBEGI_CPU_LEAK_GUARDS_INL_H
#undef PROBEGI_CPU_LEAK_GUARDS_INL_H
#else
#define PROBEGI_CPU_LEAK_GUARDS_INL_H
#endif

#include "cpu/footprint-inl.h"
#include "cpu/footprint.h"
#include "cpu/lanes-inl.h"
#include "cpu/probe_query.h"

HWY_BEFORE_NAMESPACE();
namespace probegi::HWY_NAMESPACE {

/// A leak guard is made of a view of the field and has two functions, for several points abreast:
///     Real seen(const Int& probe, const Real3& fromProbe) const
/// says, 0..1, how far each point may use a probe; `fromProbe` leads from the probe to the point with the self-shadow
/// bias, in metres; and
///     Real between(const Int& probe, const Along& along, const Real& distance) const
/// how far a probe sees another one that stands `distance` metres away along an axis, up or down it, as
///     Along along(const Int& side) const
/// has it: side is 2 * axis + (up ? 1 : 0). A guard is a template argument of the query, so that it costs what it does
/// and nothing more.

/// The leaking baseline: every probe is as good as its place.
class NoGuard {
public:
    explicit NoGuard(const FieldView&) {}

    HWY_INLINE kernels::HWY_NAMESPACE::Real seen(const kernels::HWY_NAMESPACE::Int&,
                                                 const kernels::HWY_NAMESPACE::Real3&) const {
        return 1.0f;
    }
    struct Along {};
    HWY_INLINE Along along(const kernels::HWY_NAMESPACE::Int&) const { return {}; }
    HWY_INLINE kernels::HWY_NAMESPACE::Real between(const kernels::HWY_NAMESPACE::Int&, const Along&,
                                                    const kernels::HWY_NAMESPACE::Real&) const {
        return 1.0f;
    }
};

/// Chebyshev test on the probes' distance moments (sections 2.2 and 4.1), by one of kernels::kRules.
template <int rules>
class MomentsGuard {
    using Real = kernels::HWY_NAMESPACE::Real;
    using Real3 = kernels::HWY_NAMESPACE::Real3;
    using Int = kernels::HWY_NAMESPACE::Int;

public:
    explicit MomentsGuard(const FieldView& view)
        : m_size(view.desc->visibilityTexels),
          m_half(std::uint32_t(std::uint64_t(probeCount(*view.desc)) * std::uint32_t(m_size * m_size) / 2)),
          m_middle(reinterpret_cast<const std::int32_t*>(view.visibility + m_half)),
          m_taps(*view.visibilityTaps),
          m_inverseMaxDistance(view.volumes[0].inverseMaxDistance) {
        for (int side = 0; side < 6; ++side) {
            const AxisTexels& texels = axisTexels(*view.visibilityTaps, m_size, side / 2, side % 2 == 1);
            for (int tap = 0; tap < 4; ++tap) m_axisTexels[tap][side] = texels[std::size_t(tap)];
        }
    }

    HWY_INLINE Real seen(const Int& probe, const Real3& d) const {
        namespace lanes = kernels::HWY_NAMESPACE;
        const LaneFootprint f = footprintOf(m_taps, m_size, d);
        const Int map = mapOf(probe);
        const Int t0 = lanes::gather(m_middle, map + f.tap[0]);
        const Int t1 = lanes::gather(m_middle, map + f.tap[1]);
        const Int t2 = lanes::gather(m_middle, map + f.tap[2]);
        const Int t3 = lanes::gather(m_middle, map + f.tap[3]);
        const Real mean = bilinear(lowHalves(t0), lowHalves(t1), lowHalves(t2), lowHalves(t3), f.fx, f.fy);
        const Real meanSquare = bilinear(highHalves(t0), highHalves(t1), highHalves(t2), highHalves(t3), f.fx, f.fy);
        const Real distance = lanes::sqrt(d.x * d.x + d.y * d.y + d.z * d.z) * m_inverseMaxDistance;
        return lanes::chebyshevWeight(mean, meanSquare, distance, rules);
    }

    /// The four texels around an axis.
    struct Along {
        Int tap[4];
    };
    HWY_INLINE Along along(const Int& side) const {
        namespace lanes = kernels::HWY_NAMESPACE;
        return {{lanes::gather(m_axisTexels[0].data(), side), lanes::gather(m_axisTexels[1].data(), side),
                 lanes::gather(m_axisTexels[2].data(), side), lanes::gather(m_axisTexels[3].data(), side)}};
    }

    HWY_INLINE Real between(const Int& probe, const Along& along, const Real& distance) const {
        namespace lanes = kernels::HWY_NAMESPACE;
        const Int map = mapOf(probe);
        // Four equal weights: sums of integers will do.
        Int mean = 0, meanSquare = 0;
        for (const Int& tap : along.tap) {
            const Int packed = lanes::gather(m_middle, map + tap);
            mean = mean + lanes::lowHalf(packed);
            meanSquare = meanSquare + lanes::highHalf(packed);
        }
        const Real scale = 0.25f / 65535.0f;
        return lanes::chebyshevWeight(lanes::toReal(mean) * scale, lanes::toReal(meanSquare) * scale,
                                      distance * m_inverseMaxDistance, rules);
    }

private:
    // Where a probe's map begins, counted from the middle of all maps: so 32 bits with a sign reach 2^32 texels.
    HWY_INLINE Int mapOf(const Int& probe) const { return probe * Int(m_size * m_size) - Int(std::int32_t(m_half)); }

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

    int m_size;  // texels a side
    std::uint32_t m_half;
    const std::int32_t* m_middle;
    const TapTable& m_taps;
    float m_inverseMaxDistance;
    std::array<std::array<std::int32_t, 6>, 4> m_axisTexels;  // [tap][side]
};

}  // namespace probegi::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif

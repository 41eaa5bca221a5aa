// Kernels of the query a second time, several points abreast: the same text in another namespace, where Real and Int
// are vectors of the processor. Highway compiles what includes this once for each instruction set and chooses at run
// time, so that one binary is fast on every processor; docs/performance.md has what it was measured against. The guard
// is Highway's: the file is read again for each instruction set.
#if defined(PROBEGI_CPU_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PROBEGI_CPU_LANES_INL_H
#undef PROBEGI_CPU_LANES_INL_H
#else
#define PROBEGI_CPU_LANES_INL_H
#endif

#include <hwy/highway.h>

#include <cstring>

#include "kernels/lookup/cage_weights.h"
#include "kernels/probe/octahedral.h"

HWY_BEFORE_NAMESPACE();
namespace probegi::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

inline constexpr hn::ScalableTag<float> kReals;
inline constexpr hn::RebindToSigned<hn::ScalableTag<float>> kInts;
/// Points abreast, and the most of them that any instruction set here has.
inline constexpr std::size_t kLanes = HWY_LANES(float);

using RealVector = hn::Vec<decltype(kReals)>;
using IntVector = hn::Vec<decltype(kInts)>;

struct Mask {  // kernels' Bool
    hn::Mask<decltype(kReals)> lanes;

    HWY_INLINE friend Mask operator&&(const Mask& a, const Mask& b) { return {hn::And(a.lanes, b.lanes)}; }
};

using Bool = Mask;

struct Real {
    RealVector lanes;

    Real() = default;
    HWY_INLINE Real(float value) : lanes(hn::Set(kReals, value)) {}
    HWY_INLINE explicit Real(RealVector v) : lanes(v) {}

    HWY_INLINE friend Real operator+(const Real& a, const Real& b) { return Real(hn::Add(a.lanes, b.lanes)); }
    HWY_INLINE friend Real operator-(const Real& a, const Real& b) { return Real(hn::Sub(a.lanes, b.lanes)); }
    HWY_INLINE friend Real operator*(const Real& a, const Real& b) { return Real(hn::Mul(a.lanes, b.lanes)); }
    HWY_INLINE friend Real operator/(const Real& a, const Real& b) { return Real(hn::Div(a.lanes, b.lanes)); }
    HWY_INLINE friend Mask operator<(const Real& a, const Real& b) { return {hn::Lt(a.lanes, b.lanes)}; }
    HWY_INLINE friend Mask operator>(const Real& a, const Real& b) { return {hn::Gt(a.lanes, b.lanes)}; }
    HWY_INLINE friend Mask operator>=(const Real& a, const Real& b) { return {hn::Ge(a.lanes, b.lanes)}; }
};

struct Int {
    IntVector lanes;

    Int() = default;
    HWY_INLINE Int(std::int32_t value) : lanes(hn::Set(kInts, value)) {}
    HWY_INLINE explicit Int(IntVector v) : lanes(v) {}

    HWY_INLINE friend Int operator+(const Int& a, const Int& b) { return Int(hn::Add(a.lanes, b.lanes)); }
    HWY_INLINE friend Int operator-(const Int& a, const Int& b) { return Int(hn::Sub(a.lanes, b.lanes)); }
    HWY_INLINE friend Int operator*(const Int& a, const Int& b) { return Int(hn::Mul(a.lanes, b.lanes)); }
    HWY_INLINE friend Int operator&(const Int& a, const Int& b) { return Int(hn::And(a.lanes, b.lanes)); }
    HWY_INLINE friend Mask operator==(const Int& a, const Int& b) {
        return {hn::RebindMask(kReals, hn::Eq(a.lanes, b.lanes))};
    }
    HWY_INLINE friend Mask operator<(const Int& a, const Int& b) {
        return {hn::RebindMask(kReals, hn::Lt(a.lanes, b.lanes))};
    }
};

struct Real2 {
    Real x, y;

    HWY_INLINE Real2(const Real& x_, const Real& y_) : x(x_), y(y_) {}
};

struct Real3 {
    Real x, y, z;

    Real3() = default;
    HWY_INLINE Real3(const Real& x_, const Real& y_, const Real& z_) : x(x_), y(y_), z(z_) {}
    HWY_INLINE explicit Real3(vec3 v) : x(v.x), y(v.y), z(v.z) {}

    HWY_INLINE friend Real3 operator+(const Real3& a, const Real3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    HWY_INLINE friend Real3 operator-(const Real3& a, const Real3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    HWY_INLINE friend Real3 operator-(const Real3& a, vec3 b) { return a - Real3(b); }
    HWY_INLINE friend Real3 operator*(const Real3& a, vec3 b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
    HWY_INLINE friend Real3 operator*(const Real3& a, float b) { return {a.x * b, a.y * b, a.z * b}; }
    HWY_INLINE friend Real3 operator/(const Real3& a, const Real& b) { return {a.x / b, a.y / b, a.z / b}; }
};

HWY_INLINE Real select(const Mask& condition, const Real& ifTrue, const Real& ifFalse) {
    return Real(hn::IfThenElse(condition.lanes, ifTrue.lanes, ifFalse.lanes));
}
HWY_INLINE Int select(const Mask& condition, const Int& ifTrue, const Int& ifFalse) {
    return Int(hn::IfThenElse(hn::RebindMask(kInts, condition.lanes), ifTrue.lanes, ifFalse.lanes));
}
HWY_INLINE bool anyOf(const Mask& condition) {
    return !hn::AllFalse(kReals, condition.lanes);
}

HWY_INLINE Real signNotZero(const Real& x) {
    return select(x < 0.0f, Real(-1.0f), Real(1.0f));
}
HWY_INLINE Real abs(const Real& x) {
    return Real(hn::Abs(x.lanes));
}
HWY_INLINE Real sqrt(const Real& x) {
    return Real(hn::Sqrt(x.lanes));
}
HWY_INLINE Real floor(const Real& x) {
    return Real(hn::Floor(x.lanes));
}
HWY_INLINE Real max(const Real& a, const Real& b) {
    return Real(hn::Max(a.lanes, b.lanes));
}
HWY_INLINE Real min(const Real& a, const Real& b) {
    return Real(hn::Min(a.lanes, b.lanes));
}
HWY_INLINE Real3 abs(const Real3& v) {
    return {abs(v.x), abs(v.y), abs(v.z)};
}
HWY_INLINE Real3 max(const Real3& v, vec3 low) {
    return {max(v.x, low.x), max(v.y, low.y), max(v.z, low.z)};
}
HWY_INLINE Real dot(const Real3& a, const Real3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
HWY_INLINE Real length(const Real3& v) {
    return sqrt(dot(v, v));
}
HWY_INLINE Real3 floor(const Real3& v) {
    return {floor(v.x), floor(v.y), floor(v.z)};
}
HWY_INLINE Real3 clamp(const Real3& v, vec3 low, vec3 high) {
    return {min(max(v.x, low.x), high.x), min(max(v.y, low.y), high.y), min(max(v.z, low.z), high.z)};
}

/// The whole number that x is, |x| < 2^31.
HWY_INLINE Int toInt(const Real& x) {
    return Int(hn::ConvertTo(kInts, x.lanes));
}
HWY_INLINE Real toReal(const Int& x) {
    return Real(hn::ConvertTo(kReals, x.lanes));
}
HWY_INLINE Int signedByte(const Int& word, int byte) {
    return Int(hn::ShiftRight<24>(hn::ShiftLeftSame(word.lanes, 24 - 8 * byte)));
}
HWY_INLINE Int shiftedRight(const Int& word, const Int& bits) {
    constexpr hn::RebindToUnsigned<decltype(kInts)> kBits;
    return Int(hn::BitCast(kInts, hn::Shr(hn::BitCast(kBits, word.lanes), hn::BitCast(kBits, bits.lanes))));
}
/// Of 32 unsigned bits.
HWY_INLINE Int lowHalf(const Int& bits) {
    return bits & Int(0xffff);
}
HWY_INLINE Int highHalf(const Int& bits) {
    constexpr hn::RebindToUnsigned<decltype(kInts)> kBits;
    return Int(hn::BitCast(kInts, hn::ShiftRight<16>(hn::BitCast(kBits, bits.lanes))));
}

/// kLanes values one after the other, at any address.
HWY_INLINE Real load(const float* from) {
    return Real(hn::LoadU(kReals, from));
}
HWY_INLINE void store(const Real& x, float* to) {
    hn::StoreU(x.lanes, kReals, to);
}
HWY_INLINE void store(const Int& x, std::int32_t* to) {
    hn::StoreU(x.lanes, kInts, to);
}
/// One lane's value.
HWY_INLINE float laneOf(const Real& x, std::size_t lane) {
    float value;
    std::memcpy(&value, reinterpret_cast<const char*>(&x) + lane * sizeof(value), sizeof(value));
    return value;
}
HWY_INLINE std::int32_t laneOf(const Int& x, std::size_t lane) {
    std::int32_t value;
    std::memcpy(&value, reinterpret_cast<const char*>(&x) + lane * sizeof(value), sizeof(value));
    return value;
}
/// The values at base[index] of each lane.
HWY_INLINE Int gather(const std::int32_t* base, const Int& index) {
#if HWY_TARGET == HWY_AVX2
    // One by one, since AMD's processors take longer for the instruction: docs/performance.md.
    alignas(sizeof(Int)) std::int32_t at[kLanes];
    hn::Store(index.lanes, kInts, at);
    return Int(IntVector{_mm256_setr_epi32(base[at[0]], base[at[1]], base[at[2]], base[at[3]], base[at[4]], base[at[5]],
                                           base[at[6]], base[at[7]])});
#else
    return Int(hn::GatherIndex(kInts, base, index.lanes));
#endif
}
HWY_INLINE Real gather(const float* base, const Int& index) {
#if HWY_TARGET == HWY_AVX2
    return Real(hn::BitCast(kReals, gather(reinterpret_cast<const std::int32_t*>(base), index).lanes));
#else
    return Real(hn::GatherIndex(kReals, base, index.lanes));
#endif
}

// Of a kernel's numbers that are no lanes.
using kernels::abs;
using kernels::clamp;
using kernels::floor;
using kernels::max;
using kernels::min;
using kernels::select;

}  // namespace probegi::kernels::HWY_NAMESPACE

// The second reading: guards undone, the namespace exchanged.
#undef KERNELS_BEGIN
#undef KERNELS_END
#undef KERNEL_FN
#define KERNELS_BEGIN namespace probegi::kernels::HWY_NAMESPACE {
#define KERNELS_END }
#define KERNEL_FN HWY_INLINE
#undef PROBEGI_KERNELS_ACCESS_H
#undef PROBEGI_KERNELS_CAGE_H
#undef PROBEGI_KERNELS_CAGE_WEIGHTS_H
#undef PROBEGI_KERNELS_GUARDS_H
#undef PROBEGI_KERNELS_LIST_H
#undef PROBEGI_KERNELS_OCTAHEDRAL_H
#undef PROBEGI_KERNELS_PROBE_CAGE_H
#undef PROBEGI_KERNELS_PROBE_OFFSET_H
#undef PROBEGI_KERNELS_PROBE_QUERY_H
#undef PROBEGI_KERNELS_SDF_CLEARANCE_H
#undef PROBEGI_KERNELS_SDF_DISTANCE_H
#undef PROBEGI_KERNELS_SDF_WAY_OUT_H
#undef PROBEGI_KERNELS_SURFACE_GRADIENT_H
#undef PROBEGI_KERNELS_VOLUME_FRAME_H
#define KERNELS_IN_LANES  // for the headers of kernels/guards, whose names only list.h knows
#include "kernels/lookup/cage_weights.h"
#include "kernels/probe/octahedral.h"
#undef KERNELS_IN_LANES
#undef KERNELS_BEGIN
#undef KERNELS_END
#undef KERNEL_FN
#define KERNELS_BEGIN namespace probegi::kernels {
#define KERNELS_END }
#define KERNEL_FN inline
HWY_AFTER_NAMESPACE();

#endif

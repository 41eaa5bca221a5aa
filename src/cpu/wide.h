#pragma once

#include <experimental/simd>

#include "kernels/octahedral.h"
#include "kernels/probe_query.h"
#include "kernels/surface_gradient.h"

// The kernels of the query a second time, eight probes abreast: the same text in another namespace where Real is eight
// floats. std::experimental::simd with a fixed size was chosen: it comes with the compiler, has no minimum instruction
// set, and docs/performance.md has the measurement.
namespace probegi::kernels::wide {

namespace stdx = std::experimental;

inline constexpr int kLanes = 8;
using Real = stdx::fixed_size_simd<float, kLanes>;
using Mask = Real::mask_type;

struct Real2 {
    Real x, y;
    Real2(const Real& x_, const Real& y_) : x(x_), y(y_) {}
};

struct Real3 {
    Real x, y, z;
    Real3(const Real& x_, const Real& y_, const Real& z_) : x(x_), y(y_), z(z_) {}
};

inline Real select(const Mask& condition, const Real& ifTrue, const Real& ifFalse) {
#ifdef __clang__
    // Compiled by clang 14 for AVX-512, where() of libstdc++ 12 assigns nothing.
    return Real([&](auto lane) { return condition[lane] ? ifTrue[lane] : ifFalse[lane]; });
#else
    Real result = ifFalse;
    stdx::where(condition, result) = ifTrue;
    return result;
#endif
}

inline Real signNotZero(const Real& x) {
    return select(x < 0.0f, Real(-1.0f), Real(1.0f));
}

inline Real abs(const Real& x) {
    return stdx::abs(x);
}
inline Real sqrt(const Real& x) {
    return stdx::sqrt(x);
}
inline Real max(const Real& a, const Real& b) {
    return stdx::max(a, b);
}
inline Real min(const Real& a, const Real& b) {
    return stdx::min(a, b);
}
// Of a kernel's numbers that are no lanes.
using kernels::abs;
using kernels::max;
using kernels::min;

}  // namespace probegi::kernels::wide

// The second reading: guards undone, the namespace exchanged.
#undef KERNELS_BEGIN
#undef KERNELS_END
#define KERNELS_BEGIN namespace probegi::kernels::wide {
#define KERNELS_END }
#undef PROBEGI_KERNELS_OCTAHEDRAL_H
#undef PROBEGI_KERNELS_PROBE_QUERY_H
#undef PROBEGI_KERNELS_SURFACE_GRADIENT_H
#include "kernels/octahedral.h"
#include "kernels/probe_query.h"
#include "kernels/surface_gradient.h"
#undef KERNELS_BEGIN
#undef KERNELS_END
#define KERNELS_BEGIN namespace probegi::kernels {
#define KERNELS_END }

// What makes one text both GLSL 4.60 and C++20. Every kernel header includes this first and keeps to the common subset:
// free functions, `f` on literals, no swizzles, no default arguments, no overloading on constness, OUT()/INOUT() for
// results, IN() for structs that C++ passes by reference, no buffers. PRECISE before a variable's type forbids to fuse
// what goes into it (C++ fuses only for processors with FMA, where -ffp-contract=off forbids it). A header's text
// stands between KERNELS_BEGIN and KERNELS_END and is guarded by macros (GLSL has no `#pragma once`).
#ifndef PROBEGI_KERNELS_LANGUAGE_H
#define PROBEGI_KERNELS_LANGUAGE_H

#ifdef __cplusplus

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#define KERNELS_BEGIN namespace probegi::kernels {
#define KERNELS_END }
#define KERNEL_FN inline
#define KERNEL_CONST inline constexpr
#define PRECISE
#define IN(T) const T&
#define OUT(T) T&
#define INOUT(T) T&
// Before a loop of a few rounds whose numbers are indices.
#if defined(__clang__)
#define UNROLL _Pragma("unroll")
#elif defined(__GNUC__)
#define UNROLL _Pragma("GCC unroll 8")
#else
#define UNROLL
#endif

namespace probegi::kernels {

using uint = std::uint32_t;
using glm::ivec2;
using glm::ivec3;
using glm::mat3;
using glm::mat4x3;
using glm::uvec2;
using glm::uvec3;
using glm::vec2;
using glm::vec3;
using glm::vec4;

using glm::abs;
using glm::clamp;
using glm::cross;
using glm::dot;
using glm::exp2;
using glm::floor;
using glm::fract;
using glm::inversesqrt;
using glm::length;
using glm::log2;
using glm::max;
using glm::min;
using glm::mix;
using glm::normalize;
using glm::pow;
using glm::reflect;
using glm::sqrt;
using std::abs;  // of scalars: glm's is a branch
using std::acos;
using std::atan;
using std::cos;
using std::exp;
using std::sin;
using std::tan;

inline float atan(float y, float x) {
    return std::atan2(y, x);
}
inline uint floatBitsToUint(float x) {
    return std::bit_cast<uint>(x);
}
inline float uintBitsToFloat(uint x) {
    return std::bit_cast<float>(x);
}
inline int bitCount(uint x) {
    return std::popcount(x);
}
inline int findLSB(uint x) {
    return x == 0u ? -1 : std::countr_zero(x);
}
inline int findMSB(uint x) {
    return 31 - std::countl_zero(x);
}

}  // namespace probegi::kernels

#else  // GLSL

#define KERNELS_BEGIN
#define KERNELS_END
#define KERNEL_FN
#define KERNEL_CONST const
#define PRECISE precise
#define IN(T) T
#define OUT(T) out T
#define INOUT(T) inout T
#define UNROLL

#endif

KERNELS_BEGIN

KERNEL_CONST float kPi = 3.14159265358979f;

KERNELS_END

#endif

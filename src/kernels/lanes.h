// Types of kernels that process several points at once. In GLSL and plain C++, Real is float, Int is int and select()
// is the conditional operator. src/cpu/lanes-inl.h includes the same headers again in another namespace, where they are
// SIMD vectors. So these kernels must not branch on Real.
#ifndef PROBEGI_KERNELS_LANES_H
#define PROBEGI_KERNELS_LANES_H

#include "kernels/language.h"

#ifndef __cplusplus
#define Real float
#define Int int
#define Real2 vec2
#define Real3 vec3
#endif

KERNELS_BEGIN

#ifdef __cplusplus
using Real = float;
using Int = int;
using Real2 = vec2;
using Real3 = vec3;
#endif

KERNEL_FN float select(bool condition, float ifTrue, float ifFalse) {
    return condition ? ifTrue : ifFalse;
}
KERNEL_FN int select(bool condition, int ifTrue, int ifFalse) {
    return condition ? ifTrue : ifFalse;
}

// Sign, but never 0 (unlike GLSL's sign(0)).
KERNEL_FN float signNotZero(float x) {
    return x < 0.0f ? -1.0f : 1.0f;
}

KERNELS_END

#endif

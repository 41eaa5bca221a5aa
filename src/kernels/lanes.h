// The types of kernels that answer several points abreast. In GLSL and plain C++, Real is float, Int is int, Bool is
// bool and select() is the conditional operator. src/cpu/lanes-inl.h includes the same headers a second time in another
// namespace, where they hold as many values as the processor's vectors. So these kernels have no branches on Real.
#ifndef PROBEGI_KERNELS_LANES_H
#define PROBEGI_KERNELS_LANES_H

#include "kernels/language.h"

#ifndef __cplusplus
#define Real float
#define Int int
#define Bool bool
#define Real2 vec2
#define Real3 vec3
#endif

KERNELS_BEGIN

#ifdef __cplusplus
using Real = float;
using Int = int;
using Bool = bool;
using Real2 = vec2;
using Real3 = vec3;
#endif

KERNEL_FN float select(bool condition, float ifTrue, float ifFalse) {
    return condition ? ifTrue : ifFalse;
}
KERNEL_FN int select(bool condition, int ifTrue, int ifFalse) {
    return condition ? ifTrue : ifFalse;
}

KERNEL_FN bool anyOf(bool condition) {
    return condition;
}

// The whole number that x is.
KERNEL_FN int toInt(float x) {
    return int(x);
}

KERNEL_FN float toReal(int x) {
    return float(x);
}

// A word without a sign, 0 <= bits < 32.
KERNEL_FN int shiftedRight(int word, int bits) {
    return int(uint(word) >> uint(bits));
}

// One of a word's four bytes, 0 the lowest, as a number with a sign.
KERNEL_FN int signedByte(int word, int byte) {
    return int(uint(word) << uint(24 - 8 * byte)) >> 24;
}

// Sign that is never 0 (GLSL's sign(0) is).
KERNEL_FN float signNotZero(float x) {
    return x < 0.0f ? -1.0f : 1.0f;
}

KERNELS_END

#endif

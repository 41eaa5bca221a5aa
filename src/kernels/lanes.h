// The scalar type of kernels that run several probes abreast. In GLSL, and in plain C++, Real is float and select() is
// the conditional operator. src/cpu/wide.h includes the same headers a second time in another namespace where Real is
// eight floats: the eight probes around a point. So these kernels have no branches on Real.
#ifndef PROBEGI_KERNELS_LANES_H
#define PROBEGI_KERNELS_LANES_H

#include "kernels/language.h"

#ifndef __cplusplus
#define Real float
#define Real2 vec2
#define Real3 vec3
#endif

KERNELS_BEGIN

#ifdef __cplusplus
using Real = float;
using Real2 = vec2;
using Real3 = vec3;
#endif

KERNEL_FN float select(bool condition, float ifTrue, float ifFalse) {
    return condition ? ifTrue : ifFalse;
}

// Sign that is never 0 (GLSL's sign(0) is).
KERNEL_FN float signNotZero(float x) {
    return x < 0.0f ? -1.0f : 1.0f;
}

KERNELS_END

#endif

// ProbeSides (kernels/probe/solid_probe.h) in a buffer.
#ifndef PROBEGI_SIDES_GLSL
#define PROBEGI_SIDES_GLSL

#include "common.glsl"

#include "kernels/probe/solid_probe.h"

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Sides {
    ProbeSides at[];
};

#endif

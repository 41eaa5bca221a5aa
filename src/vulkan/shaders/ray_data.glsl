// RayDatum and FixedRayDatum in buffers.
#ifndef PROBEGI_RAY_DATA_GLSL
#define PROBEGI_RAY_DATA_GLSL

#include "common.glsl"

#include "probegi/shared/field_data.h"

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer RayData {
    RayDatum at[];
};

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FixedRays {
    FixedRayDatum at[];
};

#endif

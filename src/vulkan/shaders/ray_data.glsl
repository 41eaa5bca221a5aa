// probegi::RayDatum in a buffer.
#ifndef PROBEGI_RAY_DATA_GLSL
#define PROBEGI_RAY_DATA_GLSL

#include "common.glsl"

struct RayDatum {
    vec3 radiance;
    float distance;
};
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer RayData {
    RayDatum at[];
};

// probegi::FixedRayDatum in a buffer.
struct FixedRayDatum {
    float direct;
    float bounced;
    float distance;
};
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FixedRays {
    FixedRayDatum at[];
};

#endif

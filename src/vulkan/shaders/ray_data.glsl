// RayDatum, PackedRayDatum and FixedRayDatum in buffers.
#ifndef PROBEGI_RAY_DATA_GLSL
#define PROBEGI_RAY_DATA_GLSL

#include "common.glsl"

#include "kernels/probe/packed_ray.h"
#include "probegi/shared/field_data.h"

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer RayData {
    RayDatum at[];
};

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer PackedRays {
    PackedRayDatum at[];
};

// Datum `index` of a buffer of either format.
RayDatum rayDatumAt(uvec2 address, bool packed, uint index) {
    if (!packed) return RayData(address).at[index];
    const PackedRayDatum d = PackedRays(address).at[index];
    return RayDatum(unpackRayRadiance(d.radiance, d.distance), d.distance);
}

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FixedRays {
    FixedRayDatum at[];
};

#endif

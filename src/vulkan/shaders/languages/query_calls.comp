// Calls every function of query.glsl, so that a translation of this shader into another language has all of them
// (cmake/query_languages.cmake, which takes the entry point and this buffer out of it again).
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "query.glsl"

layout(local_size_x = 1) in;
layout(set = PROBEGI_SET, binding = PROBEGI_BINDING + 4, scalar) buffer ProbegiCalls {
    vec3 a[8];
}
probegiCalls;

void main() {
    const vec3 point = probegiCalls.a[0], direction = probegiCalls.a[1];
    const int index = int(point.x);
    probegiCalls.a[0] = probegiIrradiance(point, direction, probegiCalls.a[2]);
    probegiCalls.a[1] = vec3(probegiCoverage(point), float(probegiVolumeAt(point)), float(probegiProbeCount()));
    probegiCalls.a[2] = probegiProbePosition(index);
    probegiCalls.a[3] = vec3(probegiMoments(index, direction), 0.0);
    probegiCalls.a[4] = probegiRayDirection(index);
    probegiCalls.a[5] = probegiFixedRayDirection(index);
    probegiCalls.a[6] = vec3(float(probegiRayCount()), float(probegiFixedRayCount()), 0.0);
    probegiCalls.a[7] = uintBitsToFloat(uvec3(probegiPackRay(point, direction.x), 0u));
}

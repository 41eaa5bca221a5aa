// The engine's own ray data: the results of all probe rays as probegi::PackedRayDatum. Hits are lit by last frame's
// field, so each update adds a bounce.
#include "probegi/query.glsl"
#include "rooms.glsl"

layout(local_size_x = 64) in;

layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer RayData {
    uvec2 of[];
};
layout(push_constant, scalar) uniform Push {
    Frame frame;
    RayData rayData;
};

uvec2 traceRay(vec3 origin, vec3 direction) {
    const BoxHit hit = traceBoxes(frame, origin, direction);
    if (hit.box < 0) return probegiPackRay(frame.skyRadiance, kMiss);
    if (hit.inside) return probegiPackRay(vec3(0.0), -hit.distance);
    const vec3 position = origin + hit.distance * direction;
    const vec3 irradiance = sunlight(frame, position, hit.normal) + probegiIrradiance(position, hit.normal, -direction);
    return probegiPackRay(frame.boxes[hit.box].albedo / 3.14159265 * irradiance, hit.distance);
}

// [rays]
void main() {
    const int index = int(gl_GlobalInvocationID.x), rays = probegiRayCount(), probe = index / rays;
    if (probe >= probegiProbeCount()) return;
    rayData.of[index] = traceRay(probegiProbePosition(probe), probegiRayDirection(index % rays));
}
// [/rays]

// The engine's own ray data: the results of all probe rays as probegi::RayDatum. Hits are lit by last frame's field, so
// each update adds a bounce.
#include "probegi/query.glsl"
#include "rooms.glsl"

layout(local_size_x = 64) in;

struct RayDatum {
    vec3 radiance;
    float distance;
};
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Directions {
    vec3 of[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer RayData {
    RayDatum of[];
};
layout(push_constant, scalar) uniform Push {
    Frame frame;
    Directions directions;
    RayData rayData;
    int rays;  // per probe
};

RayDatum traceRay(vec3 origin, vec3 direction) {
    const BoxHit hit = traceBoxes(frame, origin, direction);
    if (hit.box < 0) return RayDatum(frame.skyRadiance, kMiss);
    if (hit.inside) return RayDatum(vec3(0.0), -hit.distance);
    const vec3 position = origin + hit.distance * direction;
    const vec3 irradiance = sunlight(frame, position, hit.normal) + probegiIrradiance(position, hit.normal, -direction);
    return RayDatum(frame.boxes[hit.box].albedo / 3.14159265 * irradiance, hit.distance);
}

// [rays]
void main() {
    const int index = int(gl_GlobalInvocationID.x), probe = index / rays;
    if (probe >= probegiProbeCount()) return;
    rayData.of[index] = traceRay(probegiProbePosition(probe), directions.of[index % rays]);
}
// [/rays]

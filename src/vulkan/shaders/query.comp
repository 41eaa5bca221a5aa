// Irradiance at points: probegi::FieldQuery in, vec3 out.
#include "volume.glsl"

#include "kernels/abi/gpu_passes.h"

layout(push_constant, scalar) uniform Push {
    QueryPush push;
};

struct FieldQuery {
    vec3 position;
    vec3 normal;
    vec3 toViewer;
};
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Queries {
    FieldQuery at[];
};

void main() {
    const uint index = globalIndex();
    if (index >= push.count) return;
    const FieldQuery q = Queries(push.queries).at[index];
    Vec3s(push.irradiance).at[index] = probegiIrradiance(q.position, q.normal, q.toViewer);
}

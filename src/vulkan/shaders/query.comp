// Irradiance at points: FieldQuery in, vec3 out.
#include "volume.glsl"

#include "kernels/abi/gpu_passes.h"
#include "probegi/shared/field_data.h"

layout(push_constant, scalar) uniform Push {
    QueryPush push;
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

// An engine's own shader with the installed include: irradiance at points, with a set and bindings of its choice. A
// question without a normal asks for the coverage; one whose toViewer.x or .y is 2 + i for the direction of a ray.
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#define PROBEGI_SET 1
#define PROBEGI_BINDING 3
#include "probegi/query.glsl"

layout(local_size_x = 32) in;

struct Question {
    vec3 position, normal, toViewer;
};
layout(set = 0, binding = 0, scalar) readonly buffer Questions {
    Question questions[];
};
layout(set = 0, binding = 1, scalar) buffer Answers {
    vec3 answers[];
};
layout(push_constant) uniform Push {
    uint count;
};

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    const Question q = questions[i];
    if (q.toViewer.x >= 2)
        answers[i] = probegiRayDirection(int(q.toViewer.x) - 2);
    else if (q.toViewer.y >= 2)
        answers[i] = probegiFixedRayDirection(int(q.toViewer.y) - 2);
    else
        answers[i] = q.normal == vec3(0) ? vec3(probegiCoverage(q.position), float(probegiVolumeAt(q.position)), 0)
                                         : probegiIrradiance(q.position, q.normal, q.toViewer);
}

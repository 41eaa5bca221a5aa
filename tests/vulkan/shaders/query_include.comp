// An engine's own shader with the installed include: irradiance at points, with a set and bindings of its choice. A
// question without a normal asks for the coverage.
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
    answers[i] = questions[i].normal == vec3(0)
                     ? vec3(probegiCoverage(questions[i].position), float(probegiVolumeAt(questions[i].position)), 0)
                     : probegiIrradiance(questions[i].position, questions[i].normal, questions[i].toViewer);
}

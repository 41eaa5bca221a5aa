// main() of a query pass with the push constants and buffers of src/vulkan/shaders/query.comp. The including shader
// defines queryIrradiance().
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

vec3 queryIrradiance(FieldQuery q);

void main() {
    const uint index = globalIndex();
    if (index >= push.count) return;
    Vec3s(push.irradiance).at[index] = queryIrradiance(Queries(push.queries).at[index]);
}

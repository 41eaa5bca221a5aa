// Boxes without vertex buffers: 36 vertices per instance, computed from the corners.
#include "rooms.glsl"

layout(push_constant, scalar) uniform Push {
    Frame frame;
};
layout(location = 0) out vec3 position;
layout(location = 1) flat out vec3 normal;
layout(location = 2) flat out vec3 albedo;

const ivec2 kQuad[6] = ivec2[](ivec2(0, 0), ivec2(1, 0), ivec2(1, 1), ivec2(0, 0), ivec2(1, 1), ivec2(0, 1));

void main() {
    const Box box = frame.boxes[gl_InstanceIndex];
    const int face = gl_VertexIndex / 6, axis = face / 2, back = face % 2;
    const ivec2 corner = kQuad[gl_VertexIndex % 6];
    vec3 at = vec3(0.0);
    at[axis] = float(1 - back);
    at[(axis + 1 + back) % 3] = float(corner.x);
    at[(axis + 2 - back) % 3] = float(corner.y);
    normal = vec3(0.0);
    normal[axis] = float(1 - 2 * back);
    albedo = box.albedo;
    position = mix(box.lower, box.upper, at);
    gl_Position = frame.worldToClip * vec4(position, 1.0);
}

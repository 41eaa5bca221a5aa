layout(location = 0) in vec3 position;
layout(location = 1) flat in vec3 normal;
layout(location = 2) flat in vec3 albedo;
layout(location = 0) out vec4 outPosition;  // w: 1 if there is a surface
layout(location = 1) out vec4 outNormal;
layout(location = 2) out vec4 outAlbedo;

void main() {
    outPosition = vec4(position, 1.0);
    outNormal = vec4(normal, 0.0);
    outAlbedo = vec4(albedo, 0.0);
}

// Deferred shading: the sun with shadows, and the probes. The picture is twice as wide as the G-buffer; its left half
// is without the probes.
#extension GL_EXT_samplerless_texture_functions : require

#define PROBEGI_SET 1
#define PROBEGI_BINDING 0
#include "probegi/query.glsl"
#include "rooms.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform texture2D positions;
layout(set = 0, binding = 1) uniform texture2D normals;
layout(set = 0, binding = 2) uniform texture2D albedos;
layout(set = 0, binding = 3, rgba32f) writeonly uniform image2D picture;
layout(push_constant, scalar) uniform Push {
    Frame frame;
};

void main() {
    const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy), size = textureSize(positions, 0);
    if (pixel.x >= 2 * size.x || pixel.y >= size.y) return;
    const bool withProbes = pixel.x >= size.x;
    const ivec2 at = ivec2(pixel.x % size.x, pixel.y);
    const vec4 position = texelFetch(positions, at, 0);
    vec3 radiance = frame.skyRadiance;
    if (position.w > 0.0) {
        const vec3 normal = texelFetch(normals, at, 0).xyz;
        const vec3 albedo = texelFetch(albedos, at, 0).rgb;
        // No direction to the viewer: this camera looks in through a wall, towards which the look-up would bias points.
        const vec3 toViewer = vec3(0.0);
        // [query]
        vec3 irradiance = sunlight(frame, position.xyz, normal);
        if (withProbes) irradiance += probegiIrradiance(position.xyz, normal, toViewer);
        radiance = albedo / 3.14159265 * irradiance;
        // [/query]
    }
    imageStore(picture, pixel, vec4(radiance, 1.0));
}

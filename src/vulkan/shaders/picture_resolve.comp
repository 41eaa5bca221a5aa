// Means over the samples of each pixel: the layers of probegi::Picture, one after the other, in its order.
#include "picture.glsl"

layout(push_constant, scalar) uniform Push {
    PicturePush push;
};

void main() {
    const uint pixel = globalIndex();
    const uint pixels = uint(push.width) * uint(push.rows);
    if (pixel >= pixels) return;
    const uint perPixel = uint(push.samplesPerAxis * push.samplesPerAxis);
    vec3 sky = vec3(0.0);
    vec3 direct = vec3(0.0);
    vec3 indirect = vec3(0.0);
    vec3 irradiance = vec3(0.0);
    vec3 albedo = vec3(0.0);
    vec3 normal = vec3(0.0);
    float depth = 0.0;
    for (uint i = pixel * perPixel; i < (pixel + 1) * perPixel; ++i) {
        const GpuSample s = Samples(push.samples).at[i];
        if (s.kind == kSampleSky) {
            sky += s.direct;
            continue;
        }
        direct += s.direct;
        indirect += s.albedo * s.indirect * (1.0 / kPi);
        irradiance += s.indirect;
        albedo += s.albedo;
        normal += s.shadingNormal;
        depth += s.distance;
    }
    const float weight = 1.0 / float(perPixel);
    Vec3s layers = Vec3s(push.layers);
    layers.at[pixel] = weight * (direct + indirect + sky);
    layers.at[pixels + pixel] = weight * direct;
    layers.at[2 * pixels + pixel] = weight * indirect;
    layers.at[3 * pixels + pixel] = weight * irradiance;
    layers.at[4 * pixels + pixel] = weight * albedo;
    layers.at[5 * pixels + pixel] = weight * normal;
    layers.at[6 * pixels + pixel] = vec3(weight * depth);
}

// Samples to the layers of probegi::Picture, which lie one after the other, in its order: `glossy` comes last, if at
// all.
#include "picture_glossy.glsl"

#include "kernels/screen/pixel_layers.h"

layout(push_constant, scalar) uniform Push {
    PicturePush push;
};

PixelLayers load(uint pixel, uint pixels) {
    Vec3s layers = Vec3s(push.layers);
    PixelLayers sums;
    sums.color = layers.at[pixel];
    sums.direct = layers.at[pixels + pixel];
    sums.indirect = layers.at[2 * pixels + pixel];
    sums.irradiance = layers.at[3 * pixels + pixel];
    sums.albedo = layers.at[4 * pixels + pixel];
    sums.normal = layers.at[5 * pixels + pixel];
    sums.depth = layers.at[6 * pixels + pixel].x;
    sums.glossy = vec3(0.0);
    if ((push.flags & kPictureGlossy) != 0) sums.glossy = layers.at[7 * pixels + pixel];
    return sums;
}

void store(PixelLayers sums, uint pixel, uint pixels) {
    Vec3s layers = Vec3s(push.layers);
    layers.at[pixel] = sums.color;
    layers.at[pixels + pixel] = sums.direct;
    layers.at[2 * pixels + pixel] = sums.indirect;
    layers.at[3 * pixels + pixel] = sums.irradiance;
    layers.at[4 * pixels + pixel] = sums.albedo;
    layers.at[5 * pixels + pixel] = sums.normal;
    layers.at[6 * pixels + pixel] = vec3(sums.depth);
    if ((push.flags & kPictureGlossy) != 0) layers.at[7 * pixels + pixel] = sums.glossy;
}

void main() {
    const uint pixel = globalIndex();
    const uint pixels = uint(push.width) * uint(push.rows);
    if (pixel >= pixels) return;
    PixelLayers sums = emptyLayers();
    if (push.firstPlane > 0) sums = load(pixel, pixels);
    const uint planes = uint(push.planes);
    for (uint i = pixel * planes; i < (pixel + 1) * planes; ++i) {
        const ScreenSample s = Samples(push.samples).at[i];
        if (s.kind == kSampleSky)
            addSky(sums, s.direct);
        else if ((push.flags & kPictureGlossy) != 0)
            addGlossySurface(sums, s.direct, s.irradiance,
                             diffuseRadiance(materialOf(s), -dot(s.viewDirection, s.shadingNormal), s.irradiance),
                             glossyLobes(push).at[i], s.albedo, s.shadingNormal, s.distance);
        else
            addSurface(sums, s.direct, s.irradiance, s.albedo, s.shadingNormal, s.distance);
    }
    const int perPixel = push.samplesPerAxis * push.samplesPerAxis;
    if (push.firstPlane + push.planes == perPixel) sums = meanLayers(sums, perPixel);
    store(sums, pixel, pixels);
}

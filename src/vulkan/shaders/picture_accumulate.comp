// Samples to the layers of probegi::Picture, which lie one after the other, in its order; `glossy`, `contact` and
// `openness` only where the picture has them.
#include "picture_glossy.glsl"

#include "kernels/screen/contact_light.h"
#include "kernels/screen/pixel_layers.h"

layout(push_constant, scalar) uniform Push {
    PicturePush push;
};

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer ContactBlocks {
    ContactBlock at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer ContactFounds {
    ContactFound at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Vec4s {
    vec4 at[];
};

bool hasGlossy() {
    return (push.flags & kPictureGlossy) != 0;
}
bool hasContact() {
    return (push.flags & kPictureContact) != 0;
}
// Number of the first layer of contact light.
uint contactLayer() {
    return hasGlossy() ? 8u : 7u;
}

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
    sums.glossy = hasGlossy() ? layers.at[7 * pixels + pixel] : vec3(0.0);
    sums.contact = hasContact() ? layers.at[contactLayer() * pixels + pixel] : vec3(0.0);
    sums.openness = hasContact() ? layers.at[(contactLayer() + 1u) * pixels + pixel].x : 0.0;
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
    if (hasGlossy()) layers.at[7 * pixels + pixel] = sums.glossy;
    if (!hasContact()) return;
    layers.at[contactLayer() * pixels + pixel] = sums.contact;
    layers.at[(contactLayer() + 1u) * pixels + pixel] = vec3(sums.openness);
}

// With contact light there is one plane in a frame.
void addContactOf(inout PixelLayers sums, uint pixel) {
    const ContactBlock block = ContactBlocks(push.contact).at[0];
    addContactLayers(sums, ContactFounds(block.found).at[pixel].light, Vec4s(block.kept).at[pixel].w);
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
        else if (hasGlossy())
            addGlossySurface(sums, s.direct, s.irradiance,
                             diffuseRadiance(materialOf(s), -dot(s.viewDirection, s.shadingNormal), s.irradiance),
                             glossyLobes(push).at[i], s.albedo, s.shadingNormal, s.distance);
        else
            addSurface(sums, s.direct, s.irradiance, s.albedo, s.shadingNormal, s.distance);
        if (hasContact() && s.kind != kSampleSky) addContactOf(sums, i);
    }
    const int perPixel = push.samplesPerAxis * push.samplesPerAxis;
    if (push.firstPlane + push.planes == perPixel) sums = meanLayers(sums, perPixel);
    store(sums, pixel, pixels);
}

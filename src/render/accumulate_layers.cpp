#include "kernels/screen/pixel_layers.h"
#include "render/frame_pass.h"

namespace probegi {

namespace {

kernels::PixelLayers load(const Picture& picture, std::size_t pixel) {
    return {picture.color.pixels[pixel],
            picture.direct.pixels[pixel],
            picture.indirect.pixels[pixel],
            picture.irradiance.pixels[pixel],
            picture.albedo.pixels[pixel],
            picture.normal.pixels[pixel],
            picture.glossy.pixels.empty() ? glm::vec3(0.0f) : picture.glossy.pixels[pixel],
            picture.contact.pixels.empty() ? glm::vec3(0.0f) : picture.contact.pixels[pixel],
            picture.depth.pixels[pixel].x,
            picture.openness.pixels.empty() ? 0.0f : picture.openness.pixels[pixel].x};
}

void store(const kernels::PixelLayers& layers, Picture& picture, std::size_t pixel) {
    picture.color.pixels[pixel] = layers.color;
    picture.direct.pixels[pixel] = layers.direct;
    picture.indirect.pixels[pixel] = layers.indirect;
    picture.irradiance.pixels[pixel] = layers.irradiance;
    picture.albedo.pixels[pixel] = layers.albedo;
    picture.normal.pixels[pixel] = layers.normal;
    picture.depth.pixels[pixel] = glm::vec3(layers.depth);
    if (!picture.glossy.pixels.empty()) picture.glossy.pixels[pixel] = layers.glossy;
    if (picture.contact.pixels.empty()) return;
    picture.contact.pixels[pixel] = layers.contact;
    picture.openness.pixels[pixel] = glm::vec3(layers.openness);
}

// `glossy`: light of the glossy lobe; null: the picture has none.
void add(const ScreenSample& sample, const glm::vec3* glossy, kernels::PixelLayers& sums) {
    if (sample.kind == kSampleSky)
        kernels::addSky(sums, sample.direct);
    else if (glossy)
        kernels::addGlossySurface(
            sums, sample.direct, sample.irradiance,
            kernels::diffuseRadiance(materialOf(sample), -glm::dot(sample.viewDirection, sample.shadingNormal),
                                     sample.irradiance),
            *glossy, sample.albedo, sample.shadingNormal, sample.distance);
    else
        kernels::addSurface(sums, sample.direct, sample.irradiance, sample.albedo, sample.shadingNormal,
                            sample.distance);
}

}  // namespace

Result<void> accumulateLayers(PictureTask& task, const PixelRect& part, Frame& frame) {
    const int planes = planeCount(task.desc);
    forEachPixel(part, [&](int x, int y) {
        const std::size_t pixel = std::size_t(y) * std::size_t(task.desc.width) + std::size_t(x);
        kernels::PixelLayers sums = frame.firstPlane() == 0 ? kernels::emptyLayers() : load(task.layers, pixel);
        for (int plane = frame.firstPlane(); plane < frame.endPlane(); ++plane) {
            const ScreenSample& sample = frame.at(x, y, plane);
            add(sample, frame.glossy ? &frame.glossy->lobe(x, y) : nullptr, sums);
            if (frame.contact && sample.kind != kSampleSky)
                kernels::addContactLayers(sums, frame.contact->found(x, y).light, frame.contact->kept(x, y).w);
        }
        store(frame.endPlane() == planes ? kernels::meanLayers(sums, planes) : sums, task.layers, pixel);
    });
    return {};
}

}  // namespace probegi

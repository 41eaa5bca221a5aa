#include "kernels/screen/glossy_blur.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "render/frame_pass.h"

namespace probegi {

namespace {

kernels::GlossyGuide guideOf(const ScreenSample& sample) {
    return {sample.position, sample.geometricNormal, sample.shadingNormal, sample.roughness, sample.distance};
}

// One plane of a frame, as the blur sees it.
struct Blocks {
    Frame& frame;
    GlossyFrame& glossy;
    float pixelAngle;

    Blocks(const PictureTask& task, Frame& of)
        : frame(of), glossy(*of.glossy), pixelAngle(kernels::pinholeSpread(task.camera, 1)) {}

    const ScreenSample& shown(const kernels::GlossySample& sample) const {
        return frame.at(glossy.pixelX(sample.pixel), glossy.pixelY(sample.pixel), frame.firstPlane());
    }
    kernels::GlossyGuide guide(const kernels::GlossySample& sample) const { return guideOf(shown(sample)); }
};

// Of the rays around a block, as far as they stand for its own.
float meanReach(const Blocks& blocks, int column, int row) {
    const kernels::GlossyGuide centre = blocks.guide(blocks.glossy.sample(column, row));
    float sum = 0.0f, weights = 0.0f;
    for (int j = -kernels::kGlossyReachTaps; j <= kernels::kGlossyReachTaps; ++j)
        for (int i = -kernels::kGlossyReachTaps; i <= kernels::kGlossyReachTaps; ++i) {
            if (!blocks.glossy.contains(column + i, row + j)) continue;
            const kernels::GlossySample& tap = blocks.glossy.sample(column + i, row + j);
            if (tap.pixel < 0) continue;
            const float weight = kernels::guideWeight(centre, blocks.guide(tap), 2.0f * std::sqrt(float(i * i + j * j)),
                                                      blocks.pixelAngle);
            sum += weight * tap.reach;
            weights += weight;
        }
    return weights > 0.0f ? sum / weights : 0.0f;
}

// The weighted mean of (2 kGlossyTaps + 1)^2 blocks, `step` apart.
glm::vec3 blurred(const Blocks& blocks, int column, int row, float step, float radius,
                  glm::vec3 kernels::GlossySample::*value) {
    const kernels::GlossySample& own = blocks.glossy.sample(column, row);
    const kernels::GlossyGuide centre = blocks.guide(own);
    kernels::GlossyMean mean = kernels::glossyMean(own.*value, 1.0f);
    for (int j = -kernels::kGlossyTaps; j <= kernels::kGlossyTaps; ++j)
        for (int i = -kernels::kGlossyTaps; i <= kernels::kGlossyTaps; ++i) {
            const int x = kernels::glossyOffset(i, step), y = kernels::glossyOffset(j, step);
            const float distance = std::sqrt(float(x * x + y * y));
            if ((x == 0 && y == 0) || distance >= radius || !blocks.glossy.contains(column + x, row + y)) continue;
            const kernels::GlossySample& tap = blocks.glossy.sample(column + x, row + y);
            if (tap.pixel < 0) continue;
            const float weight = kernels::guideWeight(centre, blocks.guide(tap), 2.0f * distance, blocks.pixelAngle);
            kernels::addTap(mean, tap.*value, weight * kernels::glossyFalloff(distance, radius));
        }
    return kernels::meanOf(mean);
}

// Light around the glossy lobe of a sample, from the rays of its own and the adjacent blocks.
glm::vec3 upsampled(const Blocks& blocks, int x, int y, const ScreenSample& sample) {
    const PixelRect& rect = blocks.frame.rect();
    const kernels::GlossyGuide centre = guideOf(sample);
    const int column = (x - rect.x) / 2, row = (y - rect.y) / 2;
    kernels::GlossyMean mean = kernels::glossyMean(blocks.glossy.sample(column, row).radiance, 0.0f);
    for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i) {
            if (!blocks.glossy.contains(column + i, row + j)) continue;
            const kernels::GlossySample& tap = blocks.glossy.sample(column + i, row + j);
            if (tap.pixel < 0) continue;
            const float tent = kernels::glossyTent(float(blocks.glossy.pixelX(tap.pixel) - x),
                                                   float(blocks.glossy.pixelY(tap.pixel) - y));
            if (tent <= 0.0f) continue;
            const float guide = kernels::guideWeight(centre, blocks.guide(tap), 2.0f, blocks.pixelAngle);
            kernels::addTap(mean, tap.radiance, tent * (guide + kernels::kGlossyLeastGuide));
        }
    return kernels::meanOf(mean);
}

}  // namespace

Result<void> collectGlossy(PictureTask& task, const PixelRect& part, Frame& frame) {
    const Blocks blocks(task, frame);
    forEachPixel(blocks.glossy.blocksOf(part), [&](int column, int row) {
        kernels::GlossySample& sample = blocks.glossy.sample(column, row);
        if (sample.pixel < 0) return;
        const ScreenSample& hit = blocks.glossy.hits.at(column, row, 0);
        sample.radiance = kernels::hitRadiance(materialOf(hit), -glm::dot(hit.viewDirection, hit.shadingNormal),
                                               hit.direct, hit.irradiance, sample.radiance);
        sample.radius = kernels::glossyBlurRadius(blocks.shown(sample).roughness, meanReach(blocks, column, row),
                                                  blocks.pixelAngle);
    });
    return {};
}

Result<void> blurGlossy(PictureTask& task, const PixelRect& part, Frame& frame) {
    const Blocks blocks(task, frame);
    forEachPixel(blocks.glossy.blocksOf(part), [&](int column, int row) {
        kernels::GlossySample& sample = blocks.glossy.sample(column, row);
        if (sample.pixel < 0) return;
        const float reach = std::min(sample.radius, float(kernels::kGlossyTaps) + 1.0f);
        sample.blurred = blurred(blocks, column, row, 1.0f, reach, &kernels::GlossySample::radiance);
    });
    return {};
}

Result<void> spreadGlossy(PictureTask& task, const PixelRect& part, Frame& frame) {
    const Blocks blocks(task, frame);
    forEachPixel(blocks.glossy.blocksOf(part), [&](int column, int row) {
        kernels::GlossySample& sample = blocks.glossy.sample(column, row);
        if (sample.pixel < 0) return;
        const float radius = sample.radius, step = kernels::glossyStep(radius);
        sample.radiance = sample.blurred;
        if (step <= 0.0f) return;
        const glm::vec3 wide = blurred(blocks, column, row, step, radius + step, &kernels::GlossySample::blurred);
        sample.radiance += kernels::glossyWideShare(radius) * (wide - sample.blurred);
    });
    return {};
}

Result<void> shadeGlossy(PictureTask& task, const PixelRect& part, Frame& frame) {
    const Blocks blocks(task, frame);
    forEachPixel(part, [&](int x, int y) {
        const ScreenSample& sample = frame.at(x, y, frame.firstPlane());
        glm::vec3& lobe = blocks.glossy.lobe(x, y);
        if (sample.kind != kSampleSurface) return;
        const float rays = kernels::glossyRayShare(sample.roughness);
        glm::vec3 mean = lobe;
        if (rays > 0.0f) mean += rays * (upsampled(blocks, x, y, sample) - mean);
        lobe = kernels::glossyRadiance(materialOf(sample), -glm::dot(sample.viewDirection, sample.shadingNormal), mean);
    });
    return {};
}

}  // namespace probegi

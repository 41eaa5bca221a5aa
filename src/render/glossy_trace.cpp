#include <vector>

#include "geometry/lighting.h"
#include "render/frame_pass.h"
#include "render/show_sample.h"
#include "scene/sky_radiance.h"

namespace probegi {

namespace {

struct Scratch {
    std::vector<glm::ivec2> blocks;
    std::vector<Ray> rays;
    std::vector<Hit> hits;
    std::vector<Surface> surfaces;
};

// The pixel of a block whose ray it is; -1: none.
int pixelWithRay(Frame& frame, int column, int row) {
    const PixelRect& rect = frame.rect();
    for (int attempt = 0; attempt < 4; ++attempt) {
        const int candidate = kernels::glossyCandidate(frame.firstPlane(), attempt);
        const int x = 2 * column + candidate % 2, y = 2 * row + candidate / 2;
        if (x >= rect.width || y >= rect.height) continue;
        const ScreenSample& sample = frame.at(rect.x + x, rect.y + y, frame.firstPlane());
        if (sample.kind == kSampleSurface && kernels::glossyRayShare(sample.roughness) > 0.0f)
            return frame.glossy->pixel(rect.x + x, rect.y + y);
    }
    return -1;
}

void collectRays(const PictureTask& task, const PixelRect& blocks, Frame& frame, Scratch& scratch) {
    GlossyFrame& glossy = *frame.glossy;
    scratch.blocks.clear();
    scratch.rays.clear();
    forEachPixel(blocks, [&](int column, int row) {
        kernels::GlossySample& sample = glossy.sample(column, row);
        sample.radiance = sample.blurred = glm::vec3(0.0f);
        sample.reach = 1.0f;  // of the sky
        sample.radius = 0.0f;
        sample.pixel = pixelWithRay(frame, column, row);
        ScreenSample& hit = glossy.hits.at(column, row, 0);
        hit.viewDirection = {0, 0, -1};
        hit.irradiance = glm::vec3(0.0f);
        showSky(hit, glm::vec3(0.0f));
        if (sample.pixel < 0) return;
        const ScreenSample& from =
            frame.at(glossy.pixelX(sample.pixel), glossy.pixelY(sample.pixel), frame.firstPlane());
        hit.viewDirection =
            kernels::glossyDirection(from.shadingNormal, from.geometricNormal, from.viewDirection, from.roughness,
                                     kernels::glossyPattern(column, row, frame.firstPlane()));
        scratch.blocks.push_back({column, row});
        scratch.rays.push_back(
            {kernels::offsetOrigin(from.position, from.geometricNormal, task.sceneMagnitude), 0.0f, hit.viewDirection});
    });
}

}  // namespace

Result<void> traceGlossy(PictureTask& task, const PixelRect& part, Frame& frame) {
    thread_local Scratch scratch;
    GlossyFrame& glossy = *frame.glossy;
    forEachPixel(part, [&](int x, int y) { glossy.lobe(x, y) = glm::vec3(0.0f); });
    collectRays(task, glossy.blocksOf(part), frame, scratch);
    scratch.hits.resize(scratch.rays.size());
    scratch.surfaces.resize(scratch.rays.size());
    if (auto hit = task.tracer.closestHits(scratch.rays, scratch.hits); !hit) return hit;
    // Of a block: the texture's detail that one ray can show.
    const float spread = 2.0f * kernels::pinholeSpread(task.camera, 1);
    if (auto found = task.tracer.filteredSurfaces(scratch.rays, scratch.hits, spread, scratch.surfaces); !found)
        return found;
    for (std::size_t i = 0; i < scratch.rays.size(); ++i) {
        const glm::ivec2 block = scratch.blocks[i];
        ScreenSample& hit = glossy.hits.at(block.x, block.y, 0);
        if (scratch.hits[i].valid()) {
            showSurface(hit, scratch.hits[i].distance, scratch.surfaces[i]);
            kernels::GlossySample& sample = glossy.sample(block.x, block.y);
            const ScreenSample& from =
                frame.at(glossy.pixelX(sample.pixel), glossy.pixelY(sample.pixel), frame.firstPlane());
            sample.reach = kernels::glossyReach(scratch.hits[i].distance, from.distance);
        } else {
            hit.direct = skyRadiance(task.lighting.sky, hit.viewDirection);
        }
    }
    return {};
}

}  // namespace probegi

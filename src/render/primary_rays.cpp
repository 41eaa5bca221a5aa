#include <vector>

#include "render/frame_pass.h"
#include "render/show_sample.h"
#include "scene/sky_radiance.h"

namespace probegi {

namespace {

struct Scratch {
    std::vector<Ray> rays;
    std::vector<Hit> hits;
    std::vector<Surface> surfaces;
};

}  // namespace

Result<void> castPrimary(PictureTask& task, const PixelRect& part, Frame& frame) {
    thread_local Scratch scratch;
    // No structured binding: lambdas capture none with clang 14.
    auto& rays = scratch.rays;
    auto& hits = scratch.hits;
    auto& surfaces = scratch.surfaces;
    const int side = task.desc.samplesPerAxis;
    rays.clear();
    forEachPixel(part, [&](int x, int y) {
        for (int plane = frame.firstPlane(); plane < frame.endPlane(); ++plane)
            rays.push_back({task.camera.origin, 0.0f, kernels::subSampleDirection(task.camera, x, y, plane, side)});
    });
    hits.resize(rays.size());
    surfaces.resize(rays.size());
    if (auto hit = task.tracer.closestHits(rays, hits); !hit) return hit;
    const float spread = kernels::pinholeSpread(task.camera, side);
    if (auto found = task.tracer.filteredSurfaces(rays, hits, spread, surfaces); !found) return found;
    std::size_t i = 0;
    forEachSample(part, frame, [&](ScreenSample& sample) {
        sample.viewDirection = rays[i].direction;
        sample.irradiance = glm::vec3(0.0f);
        if (hits[i].valid())
            showSurface(sample, hits[i].distance, surfaces[i]);
        else
            showSky(sample, skyRadiance(task.lighting.sky, sample.viewDirection));
        ++i;
    });
    return {};
}

}  // namespace probegi

#include <vector>

#include "render/frame_pass.h"
#include "scene/sky_radiance.h"

namespace probegi {

namespace {

struct Scratch {
    std::vector<Ray> rays;
    std::vector<Hit> hits;
    std::vector<Surface> surfaces;
};

// Member by member: what is made elsewhere and copied costs a picture 3 % of its time.
void showSky(ScreenSample& sample, glm::vec3 radiance) {
    sample.position = glm::vec3(0.0f);
    sample.kind = kSampleSky;
    sample.distance = 0.0f;
    sample.geometricNormal = sample.shadingNormal = glm::vec3(0, 1, 0);
    sample.metallic = 0.0f;
    sample.roughness = 1.0f;
    sample.albedo = glm::vec3(0.0f);
    sample.direct = radiance;
}

void showSurface(ScreenSample& sample, float distance, const Surface& surface) {
    sample.position = surface.position;
    sample.kind = surface.backface ? kSampleBackface : kSampleSurface;
    sample.distance = distance;
    sample.geometricNormal = surface.geometricNormal;
    sample.metallic = surface.metallic;
    sample.shadingNormal = surface.shadingNormal;
    sample.roughness = surface.roughness;
    sample.albedo = surface.albedo;
    sample.direct = surface.emission;
}

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

#include <glm/geometric.hpp>
#include <vector>

#include "geometry/lighting.h"
#include "kernels/shade/bsdf.h"
#include "render/frame_pass.h"

namespace probegi {

namespace {

struct Candidate {
    ScreenSample* sample;
    glm::vec3 irradiance;  // at normal incidence
};

// One entry per shadow ray of the current light.
struct Scratch {
    std::vector<Candidate> candidates;
    std::vector<Ray> shadowRays;
    std::vector<std::uint8_t> blocked;
};

// Radiance per unit of irradiance at normal incidence: the material and the cosine.
glm::vec3 reflect(const ScreenSample& surface, glm::vec3 toLight, bool diffuseOnly) {
    const glm::mat3 frame = kernels::orthonormalBasis(surface.shadingNormal);
    const kernels::Bsdf bsdf = kernels::makeBsdf(surface.albedo, surface.metallic, surface.roughness, diffuseOnly);
    return kernels::evalBsdf(bsdf, kernels::toLocal(frame, -surface.viewDirection), kernels::toLocal(frame, toLight));
}

// Surfaces that the light reaches if unoccluded.
void collectCandidates(const PlacedLight& light, float sceneMagnitude, const PixelRect& part, Frame& frame,
                       Scratch& scratch) {
    scratch.candidates.clear();
    scratch.shadowRays.clear();
    forEachSample(part, frame, [&](ScreenSample& surface) {
        if (surface.kind != kSampleSurface) return;
        const kernels::LightSample sample = sampleLight(light, surface.position);
        if (!kernels::reachesSurface(sample, surface.geometricNormal, surface.shadingNormal)) return;
        scratch.candidates.push_back({&surface, sample.irradianceAtNormal});
        scratch.shadowRays.push_back(shadowRay(surface.position, surface.geometricNormal, sample, sceneMagnitude));
    });
    scratch.blocked.resize(scratch.shadowRays.size());
}

}  // namespace

Result<void> shadeDirect(PictureTask& task, const PixelRect& part, Frame& frame) {
    thread_local Scratch scratch;
    for (const PlacedLight& light : task.lighting.lights) {
        collectCandidates(light, task.sceneMagnitude, part, frame, scratch);
        if (auto traced = task.tracer.occluded(scratch.shadowRays, scratch.blocked); !traced) return traced;
        for (std::size_t i = 0; i < scratch.candidates.size(); ++i) {
            if (scratch.blocked[i]) continue;
            const auto& [sample, irradiance] = scratch.candidates[i];
            sample->direct += irradiance * reflect(*sample, scratch.shadowRays[i].direction, task.desc.diffuseOnly);
        }
    }
    return {};
}

}  // namespace probegi

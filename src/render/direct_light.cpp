#include "render/direct_light.h"

#include <glm/geometric.hpp>

#include "geometry/lighting.h"
#include "kernels/shade/bsdf.h"

namespace probegi {

namespace {

// Radiance per unit of irradiance at normal incidence: the material and the cosine.
glm::vec3 reflect(const Surface& surface, glm::vec3 toViewer, glm::vec3 toLight, bool diffuseOnly) {
    const glm::mat3 frame = kernels::orthonormalBasis(surface.shadingNormal);
    const kernels::Bsdf bsdf = kernels::makeBsdf(surface.albedo, surface.metallic, surface.roughness, diffuseOnly);
    return kernels::evalBsdf(bsdf, kernels::toLocal(frame, toViewer), kernels::toLocal(frame, toLight));
}

// Surfaces that the light reaches if unoccluded.
void collectCandidates(const PlacedLight& light, float sceneMagnitude, TileSamples& samples) {
    samples.candidates.clear();
    samples.shadowRays.clear();
    for (std::size_t entry = 0; entry < samples.seen.size(); ++entry) {
        const Surface& surface = samples.surfaces[samples.seen[entry]];
        if (surface.backface) continue;
        const kernels::LightSample sample = sampleLight(light, surface.position);
        if (!kernels::reachesSurface(sample, surface.geometricNormal, surface.shadingNormal)) continue;
        samples.candidates.push_back({std::uint32_t(entry), sample.irradianceAtNormal});
        samples.shadowRays.push_back(shadowRay(surface.position, surface.geometricNormal, sample, sceneMagnitude));
    }
    samples.blocked.resize(samples.shadowRays.size());
}

}  // namespace

Result<void> shadeDirect(const Tracer& tracer, const Lighting& lighting, float sceneMagnitude, bool diffuseOnly,
                         TileSamples& samples) {
    samples.direct.clear();
    for (const std::uint32_t index : samples.seen) samples.direct.push_back(samples.surfaces[index].emission);
    for (const PlacedLight& light : lighting.lights) {
        collectCandidates(light, sceneMagnitude, samples);
        if (auto traced = tracer.occluded(samples.shadowRays, samples.blocked); !traced) return traced;
        for (std::size_t i = 0; i < samples.candidates.size(); ++i) {
            if (samples.blocked[i]) continue;
            const auto& candidate = samples.candidates[i];
            const std::uint32_t index = samples.seen[candidate.entry];
            samples.direct[candidate.entry] +=
                candidate.irradiance * reflect(samples.surfaces[index], -samples.rays[index].direction,
                                               samples.shadowRays[i].direction, diffuseOnly);
        }
    }
    return {};
}

}  // namespace probegi

// Next-event estimation: the half of PathBatch that samples lights.
#include <algorithm>
#include <glm/geometric.hpp>

#include "geometry/lighting.h"
#include "kernels/screen/colour.h"
#include "reference/path_batch.h"

namespace probegi {

using kernels::anyPositive;

void PathBatch::sampleLights(Path& path, const Vertex& vertex) {
    if (!(m_fromPoints && path.reflections == 0)) samplePunctualLights(path, vertex);
    if (m_settings.strategy == Strategy::bsdfOnly) return;
    if (!m_transport.emitters.empty()) sampleEmitters(path, vertex);
    if (samplesSky(path)) sampleSky(path, vertex);
}

void PathBatch::samplePunctualLights(Path& path, const Vertex& vertex) {
    const auto& lights = m_transport.lights;
    if (lights.size() <= kFewLights) {
        for (const PlacedLight& light : lights) queuePunctual(path, vertex, sampleLight(light, vertex.position), 1.0f);
        return;
    }
    // Choose one of many by its unshadowed contribution: two passes instead of a list.
    const auto contribution = [&](const PlacedLight& light) {
        const kernels::LightSample s = sampleLight(light, vertex.position);
        if (!kernels::reachesSurface(s, vertex.geometricNormal, vertex.frame[2])) return 0.0f;
        const glm::vec3 local = kernels::toLocal(vertex.frame, s.toLight);
        return kernels::luminance(s.irradianceAtNormal * kernels::evalBsdf(vertex.bsdf, vertex.toPrevious, local));
    };
    float total = 0;
    for (const PlacedLight& light : lights) total += contribution(light);
    if (!(total > 0)) return;
    float left = path.random.next() * total;
    for (const PlacedLight& light : lights) {
        const float share = contribution(light);
        left -= share;
        if (left >= 0 || share <= 0) continue;
        queuePunctual(path, vertex, sampleLight(light, vertex.position), total / share);
        return;
    }
}

void PathBatch::queuePunctual(const Path& path, const Vertex& vertex, const kernels::LightSample& light, float weight) {
    if (!kernels::reachesSurface(light, vertex.geometricNormal, vertex.frame[2])) return;
    const Response r = response(path, vertex, kernels::toLocal(vertex.frame, light.toLight));
    const bool first = path.reflections == 0;
    Pending pending{.result = path.result, .layer = first ? Layer::direct : Layer::indirect};
    pending.color = r.color * light.irradianceAtNormal * weight;
    // On the first surface, punctual light is not part of a field's E.
    if (!first) pending.irradiance = r.irradiance * light.irradianceAtNormal * weight;
    if (!anyPositive(pending.color) && !anyPositive(pending.irradiance)) return;
    m_shadows.push_back(pending);
    m_shadowRays.push_back(shadowRay(vertex.position, vertex.geometricNormal, light, m_transport.magnitude));
}

void PathBatch::sampleEmitters(Path& path, const Vertex& vertex) {
    const EmitterSampler& emitters = m_transport.emitters;
    const EmitterSample sample = emitters.sample(path.random);
    const glm::vec3 origin = kernels::offsetOrigin(vertex.position, vertex.geometricNormal, m_transport.magnitude);
    const glm::vec3 apart = sample.position - origin;
    const float squared = glm::dot(apart, apart);
    if (!(squared > 0)) return;
    const float distance = std::sqrt(squared);
    const glm::vec3 direction = apart / distance;
    const float facing = -glm::dot(sample.normal, direction);
    if (facing == 0 || (facing < 0 && !emitters.doubleSided(sample.material))) return;
    if (glm::dot(vertex.geometricNormal, direction) <= 0) return;

    const glm::vec3 local = kernels::toLocal(vertex.frame, direction);
    const float pdfLight = emitters.pdfArea(sample.material) * squared / std::abs(facing);
    const float pdfBsdf = pdfScatter(vertex, local, direction);
    const float weight = lightSampleWeight(pdfLight, pdfBsdf) / pdfLight;
    const Response r = response(path, vertex, local);
    Pending pending{.result = path.result, .material = sample.material, .distance = distance};
    pending.color = r.color * weight;
    pending.irradiance = r.irradiance * weight;
    if (!anyPositive(pending.color) && !anyPositive(pending.irradiance)) return;
    if (!emitters.uniform(sample.material)) {
        m_lookUps.push_back(pending);
        m_lookUpRays.push_back({origin, 0.0f, direction});
        return;
    }
    const glm::vec3 emission = emitters.emission(sample.material);
    pending.color *= emission;
    pending.irradiance *= emission;
    m_shadows.push_back(pending);
    // The ray ends above the emitter's surface, by the offset at which a ray leaving it would start.
    const float end = distance - kernels::rayOffset(sample.position, m_transport.magnitude) / std::abs(facing);
    m_shadowRays.push_back({origin, 0.0f, direction, std::max(end, 0.5f * distance)});
}

void PathBatch::sampleSky(Path& path, const Vertex& vertex) {
    const glm::vec3 direction = m_transport.sky.sample(vertex.frame[2], path.random);
    if (glm::dot(vertex.geometricNormal, direction) <= 0) return;
    const float pdfLight = m_transport.sky.pdf(vertex.frame[2], direction);
    if (!(pdfLight > 0)) return;
    const glm::vec3 local = kernels::toLocal(vertex.frame, direction);
    const float pdfBsdf = pdfScatter(vertex, local, direction);
    const glm::vec3 radiance = m_transport.sky.radiance(direction) * (lightSampleWeight(pdfLight, pdfBsdf) / pdfLight);
    const Response r = response(path, vertex, local);
    Pending pending{.result = path.result};
    pending.color = r.color * radiance;
    pending.irradiance = r.irradiance * radiance;
    if (!anyPositive(pending.color) && !anyPositive(pending.irradiance)) return;
    m_shadows.push_back(pending);
    const glm::vec3 origin = kernels::offsetOrigin(vertex.position, vertex.geometricNormal, m_transport.magnitude);
    m_shadowRays.push_back({origin, 0.0f, direction});
}

Result<void> PathBatch::resolveShadows() {
    if (m_shadows.empty()) return {};
    m_blocked.resize(m_shadows.size());
    if (auto traced = m_transport.tracer->occluded(m_shadowRays, m_blocked); !traced) return traced;
    for (std::size_t i = 0; i < m_shadows.size(); ++i) {
        const Pending& p = m_shadows[i];
        if (!m_blocked[i]) addTo(p.result, p.layer, p.color, p.irradiance);
    }
    return {};
}

/// Emitters with varying radiance (textures, alpha): the ray itself looks up the sampled point's radiance and
/// visibility.
Result<void> PathBatch::resolveLookUps() {
    if (m_lookUps.empty()) return {};
    std::vector<Hit> hits(m_lookUps.size());
    std::vector<Surface> surfaces(m_lookUps.size());
    if (auto hit = m_transport.tracer->closestHits(m_lookUpRays, hits); !hit) return hit;
    if (auto found = m_transport.tracer->surfaces(m_lookUpRays, hits, surfaces); !found) return found;
    for (std::size_t i = 0; i < m_lookUps.size(); ++i) {
        const Pending& p = m_lookUps[i];
        if (!hits[i].valid() || surfaces[i].material != p.material) continue;
        const float tolerance =
            1e-4f * p.distance + 4 * kernels::rayOffset(surfaces[i].position, m_transport.magnitude);
        if (std::abs(hits[i].distance - p.distance) > tolerance) continue;
        addTo(p.result, p.layer, p.color * surfaces[i].emission, p.irradiance * surfaces[i].emission);
    }
    return {};
}

}  // namespace probegi

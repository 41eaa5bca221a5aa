// Continuation of a path from its vertex: the half of PathBatch that samples directions.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "kernels/screen/colour.h"
#include "kernels/trace/ray_offset.h"
#include "reference/path_batch.h"

namespace probegi {

namespace {

float maxComponent(glm::vec3 v) {
    return std::max({v.x, v.y, v.z});
}

/// Survival probability of a path whose expected light ahead equals that at its first vertex. In theory, the most
/// efficient is about the root of variance over cost; between 1 and 2 efficiency hardly changes.
constexpr float kSurvivalPerWorth = 1.5f;
/// Limits the weight that a wrong guide can give a path to one over this, times that from its own directions.
constexpr float kMinSurvival = 0.1f;
/// Minimum reflectance of the first surface when its light is compared with that ahead.
constexpr float kMinReflectance = 0.04f;

}  // namespace

PathBatch::Vertex PathBatch::makeVertex(const Ray& ray, const Surface& surface, bool first) const {
    // With a shading normal facing away from the viewer, the inside of the material would be shaded.
    const bool usable = glm::dot(surface.shadingNormal, ray.direction) < -1e-4f;
    Vertex v;
    v.position = surface.position;
    v.geometricNormal = surface.geometricNormal;
    v.frame = kernels::orthonormalBasis(usable ? surface.shadingNormal : surface.geometricNormal);
    v.bsdf = kernels::makeBsdf(surface.albedo, surface.metallic, surface.roughness, m_settings.diffuseOnly);
    v.toPrevious = kernels::toLocal(v.frame, -ray.direction);
    v.toPrevious.z = std::max(v.toPrevious.z, 1e-4f);
    // The first surface's irradiance needs the whole hemisphere, however mirror-like the material.
    if (first) v.bsdf.minDiffuse = std::max(v.bsdf.minDiffuse, 0.25f);
    return v;
}

/// The guide replaces only the cosine lobe; the specular lobe samples its directions better itself.
void PathBatch::follow(const PathGuide& guide, Vertex& vertex) const {
    guide.mixtureAt(*vertex.region, vertex.position, vertex.frame[2], vertex.mixture);
    if (vertex.mixture.share > 0)
        vertex.guideShare = vertex.mixture.share * kernels::diffuseProbability(vertex.bsdf, vertex.toPrevious);
}

/// Density per steradian with which scatter() chooses a direction.
float PathBatch::pdfScatter(const Vertex& vertex, glm::vec3 local, glm::vec3 direction) const {
    const float pdf = kernels::pdfBsdf(vertex.bsdf, vertex.toPrevious, local);
    if (!(vertex.guideShare > 0) || !(local.z > 0)) return pdf;
    return (1 - vertex.guideShare) * pdf +
           vertex.guideShare * PathGuide::pdf(vertex.mixture, vertex.position, direction);
}

/// `direction` is in the vertex' frame.
PathBatch::Response PathBatch::response(const Path& path, const Vertex& vertex, glm::vec3 direction) const {
    const glm::vec3 f = kernels::evalBsdf(vertex.bsdf, vertex.toPrevious, direction);
    if (path.reflections == 0) return {m_fromPoints ? glm::vec3(0.0f) : f, glm::vec3(std::max(direction.z, 0.0f))};
    const glm::vec3 arriving = path.throughput * f;
    return {path.firstColor * arriving, path.firstIrradiance * arriving};
}

/// Approximate reflectance of a vertex.
float PathBatch::reflectance(const Vertex& vertex) {
    return kernels::luminance(vertex.bsdf.diffuse) +
           (vertex.bsdf.specular > 0 ? kernels::luminance(vertex.bsdf.f0) : 0.0f);
}

/// Lights the vertex, then scatters the path. If the guide predicts little light ahead, the path is likely to end here,
/// before further cost.
void PathBatch::turn(Path& path, Vertex& vertex) {
    float survival = 1;
    if (m_settings.guide) {
        vertex.region = &m_settings.guide->regionAt(vertex.position, vertex.frame[2]);
        if (path.reflections == 0)
            expect(path, vertex);
        else if (path.judged)
            survival = survivalOf(path, vertex);
        if (survival < 1 && !(path.random.next() < survival)) survival = 0;
        const bool lightsNeedDensity = samplesSky(path) || !m_transport.emitters.empty();
        if (survival > 0 || lightsNeedDensity) follow(*m_settings.guide, vertex);
    }
    sampleLights(path, vertex);
    if (!(survival > 0)) return;
    path.throughput /= survival;
    scatter(path, vertex);
}

/// The light that the guide predicts at the first vertex is survivalOf()'s reference level later.
void PathBatch::expect(Path& path, const Vertex& vertex) const {
    path.judged = vertex.region->expected > 0;
    path.levelIrradiance = vertex.region->expected * kernels::kPi;
    path.levelColor = vertex.region->expected * std::max(reflectance(vertex), kMinReflectance);
}

/// Adjoint-driven Russian roulette (Vorba and Krivanek 2016): expected light ahead of this vertex over that at the
/// first one. Both are root mean squares rather than means, which accounts for rare bright light as noise (Rath et al.
/// 2022).
float PathBatch::survivalOf(const Path& path, const Vertex& vertex) const {
    const float throughput = kernels::luminance(path.throughput);
    const float ahead = throughput * reflectance(vertex) * vertex.region->expected;
    const float worth = std::max(path.firstIrradiance * ahead / path.levelIrradiance,
                                 kernels::luminance(path.firstColor) * ahead / path.levelColor);
    const float least = kMinSurvival * std::max(1.0f, throughput * path.firstIrradiance / kernels::kPi);
    return std::min(std::max(kSurvivalPerWorth * worth, least), kMaxSurvival);
}

/// Continues the path in a direction sampled from the BSDF or the guide, unless it is absorbed.
void PathBatch::scatter(Path& path, const Vertex& vertex) {
    const glm::vec2 u = path.random.nextPair();
    const glm::vec2 choices = path.random.nextPair();
    glm::vec3 local, direction;
    if (choices.x < vertex.guideShare) {
        direction =
            PathGuide::sample(vertex.mixture, vertex.position, choices.x / vertex.guideShare, u, path.random.next());
        local = kernels::toLocal(vertex.frame, direction);
    } else {
        const float lobe = (choices.x - vertex.guideShare) / (1 - vertex.guideShare);
        local = kernels::sampleBsdf(vertex.bsdf, vertex.toPrevious, u, lobe);
        direction = glm::normalize(kernels::toWorld(vertex.frame, local));
    }
    if (!(local.z > 0)) return;
    if (!(glm::dot(vertex.geometricNormal, direction) > 0)) return;
    const float pdf = pdfScatter(vertex, local, direction);
    if (!(pdf > 0)) return;
    const glm::vec3 f = kernels::evalBsdf(vertex.bsdf, vertex.toPrevious, local) / pdf;
    if (path.reflections == 0) {
        path.firstColor = m_fromPoints ? glm::vec3(0.0f) : f;
        path.firstIrradiance = local.z / pdf;
    } else {
        path.throughput *= f;
    }
    path.pdf = pdf;
    path.pdfSky = samplesSky(path) ? m_transport.sky.pdf(vertex.frame[2], direction) : 0.0f;
    ++path.reflections;
    if (path.reflections > kRouletteStart && !path.judged) {
        const float survival = std::min(kMaxSurvival, maxComponent(path.throughput));
        if (!(choices.y < survival)) return;
        path.throughput /= survival;
    }
    m_nextPaths.push_back(path);
    m_nextRays.push_back(
        {kernels::offsetOrigin(vertex.position, vertex.geometricNormal, m_transport.magnitude), 0.0f, direction});
}

}  // namespace probegi

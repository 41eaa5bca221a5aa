#include "reference/path_batch.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "surface/lighting.h"

namespace probegi {

namespace {

float maxComponent(glm::vec3 v) {
    return std::max({v.x, v.y, v.z});
}

}  // namespace

PathBatch::PathBatch(const Transport& transport, const PathSettings& settings)
    : m_transport(transport), m_settings(settings) {}

void PathBatch::begin(std::size_t count) {
    m_paths.clear();
    m_rays.clear();
    m_paths.reserve(count);
    m_rays.reserve(count);
}

Result<void> PathBatch::fromCamera(std::span<const Ray> cameraRays, std::span<const Random> random,
                                   std::span<PathResult> results) {
    m_results = results;
    m_fromPoints = false;
    begin(cameraRays.size());
    for (std::size_t i = 0; i < cameraRays.size(); ++i) {
        m_paths.push_back(Path{.random = random[i], .result = std::uint32_t(i)});
        m_rays.push_back(cameraRays[i]);
    }
    return run();
}

Result<void> PathBatch::fromPoints(std::span<const FieldQuery> points, std::span<const Random> random,
                                   std::span<PathResult> results) {
    m_results = results;
    m_fromPoints = true;
    begin(points.size());
    m_shadows.clear();
    m_shadowRays.clear();
    m_lookUps.clear();
    m_lookUpRays.clear();
    for (std::size_t i = 0; i < points.size(); ++i) {
        Path path{.random = random[i], .result = std::uint32_t(i)};
        Vertex vertex;
        vertex.position = points[i].position;
        vertex.geometricNormal = points[i].normal;
        vertex.frame = kernels::orthonormalBasis(points[i].normal);
        vertex.toPrevious = glm::vec3(0, 0, 1);
        vertex.bsdf = kernels::makeBsdf(glm::vec3(1.0f), 0.0f, 1.0f, true);
        if (m_settings.guide) follow(*m_settings.guide, vertex);
        sampleLights(path, vertex);
        Ray ray;
        if (!scatter(path, vertex, ray)) continue;
        m_paths.push_back(path);
        m_rays.push_back(ray);
    }
    if (auto resolved = resolveShadows(); !resolved) return resolved;
    if (auto resolved = resolveLookUps(); !resolved) return resolved;
    return run();
}

Result<void> PathBatch::run() {
    while (!m_paths.empty()) {
        m_hits.assign(m_paths.size(), Hit{});
        m_surfaces.resize(m_paths.size());
        if (auto hit = m_transport.tracer->closestHits(m_rays, m_hits); !hit) return hit;
        if (auto found = m_transport.tracer->surfaces(m_rays, m_hits, m_surfaces); !found) return found;
        m_shadows.clear();
        m_shadowRays.clear();
        m_lookUps.clear();
        m_lookUpRays.clear();
        std::size_t alive = 0;
        for (std::size_t i = 0; i < m_paths.size(); ++i) {
            if (!shadeHit(i)) continue;
            m_paths[alive] = m_paths[i];
            m_rays[alive] = m_rays[i];
            ++alive;
        }
        m_paths.erase(m_paths.begin() + std::ptrdiff_t(alive), m_paths.end());
        m_rays.resize(alive);
        if (auto resolved = resolveShadows(); !resolved) return resolved;
        if (auto resolved = resolveLookUps(); !resolved) return resolved;
    }
    return {};
}

/// Adds what the hit (or miss) of path i gives and turns the path around. False: the path has ended.
bool PathBatch::shadeHit(std::size_t i) {
    Path& path = m_paths[i];
    Ray& ray = m_rays[i];
    if (!m_hits[i].valid()) {
        addSky(path, ray);
        return false;
    }
    const Surface& surface = m_surfaces[i];
    const bool first = path.reflections == 0;
    if (first) recordFirstSurface(path, m_hits[i], surface);
    if (surface.backface) return false;
    addEmission(path, ray, m_hits[i], surface);
    const int limit = m_settings.maxBounces > 0 ? std::min(m_settings.maxBounces, kMaxReflections) : kMaxReflections;
    if (path.reflections >= limit) return false;
    const Vertex vertex = makeVertex(ray, surface, first);
    sampleLights(path, vertex);
    return scatter(path, vertex, ray);
}

void PathBatch::recordFirstSurface(const Path& path, const Hit& hit, const Surface& surface) {
    PathResult& result = m_results[path.result];
    result.albedo = surface.albedo;
    result.normal = surface.shadingNormal;
    result.depth = hit.distance;
}

void PathBatch::addTo(std::uint32_t index, Layer layer, const glm::vec3& color, const glm::vec3& irradiance) {
    PathResult& result = m_results[index];
    (layer == Layer::direct ? result.direct : result.indirect) += color;
    result.irradiance += irradiance;
}

void PathBatch::addSky(const Path& path, const Ray& ray) {
    if (m_transport.sky.black()) return;
    const glm::vec3 radiance = m_transport.sky.radiance(ray.direction);
    if (path.reflections == 0) {
        m_results[path.result].sky = radiance;
        return;
    }
    const float weight = bsdfSampleWeight(path.pdf, path.pdfSky);
    const glm::vec3 arriving = path.throughput * radiance * weight;
    addTo(path.result, Layer::indirect, path.firstColor * arriving, path.firstIrradiance * arriving);
}

void PathBatch::addEmission(const Path& path, const Ray& ray, const Hit& hit, const Surface& surface) {
    if (maxComponent(surface.emission) <= 0) return;
    if (path.reflections == 0) {
        m_results[path.result].direct += surface.emission;
        return;
    }
    const float cosine = -glm::dot(surface.geometricNormal, ray.direction);
    const float pdfArea = m_transport.emitters.empty() ? 0.0f : m_transport.emitters.pdfArea(surface.material);
    const float pdfLight = cosine > 0 ? pdfArea * hit.distance * hit.distance / cosine : 0.0f;
    const glm::vec3 arriving = path.throughput * surface.emission * bsdfSampleWeight(path.pdf, pdfLight);
    addTo(path.result, Layer::indirect, path.firstColor * arriving, path.firstIrradiance * arriving);
}

PathBatch::Vertex PathBatch::makeVertex(const Ray& ray, const Surface& surface, bool first) const {
    // A shading normal that faces away from the viewer would show the inside of the material.
    const bool usable = glm::dot(surface.shadingNormal, ray.direction) < -1e-4f;
    Vertex v;
    v.position = surface.position;
    v.geometricNormal = surface.geometricNormal;
    v.frame = kernels::orthonormalBasis(usable ? surface.shadingNormal : surface.geometricNormal);
    v.bsdf = kernels::makeBsdf(surface.albedo, surface.metallic, surface.roughness, m_settings.diffuseOnly);
    v.toPrevious = kernels::toLocal(v.frame, -ray.direction);
    v.toPrevious.z = std::max(v.toPrevious.z, 1e-4f);
    // The irradiance of the first surface needs the whole hemisphere, however mirror-like the material is.
    if (first) v.bsdf.minDiffuse = std::max(v.bsdf.minDiffuse, 0.25f);
    if (m_settings.guide) follow(*m_settings.guide, v);
    return v;
}

/// The guide takes its share from the cosine lobe only: a coat knows better where it looks.
void PathBatch::follow(const PathGuide& guide, Vertex& vertex) const {
    guide.mixtureAt(vertex.position, vertex.frame[2], vertex.mixture);
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

/// What the rest of a path is worth. Guided, one that was led to a bright place has brought home the most of it with
/// the light that it met there: its own weight, that of the first direction included, says what is left. The root of it
/// lost less than the weight itself in builtin:house, which that ended too many paths of.
float PathBatch::survivalOf(const Path& path) const {
    const float weight = maxComponent(path.throughput);
    return m_settings.guide ? std::sqrt(path.firstIrradiance / kernels::kPi * weight) : weight;
}

/// Continues the path in a direction sampled from the BSDF. False: absorbed.
bool PathBatch::scatter(Path& path, const Vertex& vertex, Ray& ray) {
    const glm::vec2 u = path.random.nextPair();
    const glm::vec2 choices = path.random.nextPair();
    glm::vec3 local, direction;
    if (choices.x < vertex.guideShare) {
        direction = PathGuide::sample(vertex.mixture, vertex.position, choices.x / vertex.guideShare, path.random);
        local = kernels::toLocal(vertex.frame, direction);
    } else {
        const float lobe = (choices.x - vertex.guideShare) / (1 - vertex.guideShare);
        local = kernels::sampleBsdf(vertex.bsdf, vertex.toPrevious, u, lobe);
        direction = glm::normalize(kernels::toWorld(vertex.frame, local));
    }
    if (!(local.z > 0)) return false;
    if (!(glm::dot(vertex.geometricNormal, direction) > 0)) return false;
    const float pdf = pdfScatter(vertex, local, direction);
    if (!(pdf > 0)) return false;
    const glm::vec3 f = kernels::evalBsdf(vertex.bsdf, vertex.toPrevious, local) / pdf;
    if (path.reflections == 0) {
        path.firstColor = m_fromPoints ? glm::vec3(0.0f) : f;
        path.firstIrradiance = local.z / pdf;
    } else {
        path.throughput *= f;
    }
    path.pdf = pdf;
    if (!m_transport.sky.black()) path.pdfSky = m_transport.sky.pdf(vertex.frame[2], direction);
    ++path.reflections;
    if (path.reflections > (m_settings.guide ? kGuidedRouletteStart : kRouletteStart)) {
        const float survival = std::min(kMaxSurvival, survivalOf(path));
        if (!(choices.y < survival)) return false;
        path.throughput /= survival;
    }
    ray = {kernels::offsetOrigin(vertex.position, vertex.geometricNormal, m_transport.magnitude), 0.0f, direction};
    return true;
}

float PathBatch::lightSampleWeight(float pdfLight, float pdfBsdf) const {
    if (m_settings.strategy == Strategy::lightsOnly) return 1.0f;
    return kernels::powerHeuristic(pdfLight, pdfBsdf);
}

float PathBatch::bsdfSampleWeight(float pdfBsdf, float pdfLight) const {
    if (m_settings.strategy == Strategy::bsdfOnly) return 1.0f;
    if (m_settings.strategy == Strategy::lightsOnly) return pdfLight > 0 ? 0.0f : 1.0f;
    return kernels::powerHeuristic(pdfBsdf, pdfLight);
}

}  // namespace probegi

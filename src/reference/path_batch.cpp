#include "reference/path_batch.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "geometry/lighting.h"

namespace probegi {

namespace {

float maxComponent(glm::vec3 v) {
    return std::max({v.x, v.y, v.z});
}

}  // namespace

PathBatch::PathBatch(const Transport& transport, const PathSettings& settings)
    : m_transport(transport), m_settings(settings) {
    if (settings.strategy == Strategy::bsdfOnly) return;
    // A constant sky is sampled like the cosine lobe: beyond the first vertex that is not worth a separate ray if a
    // guide knows the windows.
    if (!transport.sky.black()) m_skySamples = settings.guide && transport.sky.constant() ? 1 : kMaxReflections + 1;
}

void PathBatch::begin(std::size_t count) {
    m_paths.clear();
    m_rays.clear();
    m_paths.reserve(count);
    m_rays.reserve(count);
    m_nextPaths.clear();
    m_nextRays.clear();
    m_shadows.clear();
    m_shadowRays.clear();
    m_lookUps.clear();
    m_lookUpRays.clear();
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
    for (std::size_t i = 0; i < points.size(); ++i) {
        Path path{.random = random[i], .result = std::uint32_t(i)};
        Vertex vertex;
        vertex.position = points[i].position;
        vertex.geometricNormal = points[i].normal;
        vertex.frame = kernels::orthonormalBasis(points[i].normal);
        vertex.toPrevious = glm::vec3(0, 0, 1);
        vertex.bsdf = kernels::makeBsdf(glm::vec3(1.0f), 0.0f, 1.0f, true);
        turn(path, vertex);
    }
    if (auto advanced = advance(); !advanced) return advanced;
    return run();
}

Result<void> PathBatch::run() {
    while (!m_paths.empty()) {
        m_hits.assign(m_paths.size(), Hit{});
        m_surfaces.resize(m_paths.size());
        if (auto hit = m_transport.tracer->closestHits(m_rays, m_hits); !hit) return hit;
        if (auto found = m_transport.tracer->surfaces(m_rays, m_hits, m_surfaces); !found) return found;
        for (std::size_t i = 0; i < m_paths.size(); ++i) shadeHit(i);
        if (auto advanced = advance(); !advanced) return advanced;
    }
    return {};
}

/// Resolves which light reaches the vertices, and continues with the rays that left them.
Result<void> PathBatch::advance() {
    if (auto resolved = resolveShadows(); !resolved) return resolved;
    if (auto resolved = resolveLookUps(); !resolved) return resolved;
    m_shadows.clear();
    m_shadowRays.clear();
    m_lookUps.clear();
    m_lookUpRays.clear();
    m_paths.swap(m_nextPaths);
    m_rays.swap(m_nextRays);
    m_nextPaths.clear();
    m_nextRays.clear();
    return {};
}

/// Adds the contribution of path i's hit or miss, and scatters the path.
void PathBatch::shadeHit(std::size_t i) {
    Path& path = m_paths[i];
    const Ray& ray = m_rays[i];
    if (!m_hits[i].valid()) {
        addSky(path, ray);
        return;
    }
    const Surface& surface = m_surfaces[i];
    const bool first = path.reflections == 0;
    if (first) recordFirstSurface(path, m_hits[i], surface);
    if (surface.backface) return;
    addEmission(path, ray, m_hits[i], surface);
    const int limit = m_settings.maxBounces > 0 ? std::min(m_settings.maxBounces, kMaxReflections) : kMaxReflections;
    if (path.reflections >= limit) return;
    Vertex vertex = makeVertex(ray, surface, first);
    turn(path, vertex);
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

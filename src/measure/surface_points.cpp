#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <numbers>
#include <random>

#include "measure/input_checks.h"
#include "measure/surface_sampling.h"

namespace probegi {

namespace {

constexpr int kOpenRays = 32;                   ///< that decide on which side of a surface the open lies
constexpr double kInMatter = 0.25;              ///< of the hits are backfaces: the point looks at the inside of matter
constexpr std::uint64_t kUsualSeed = 20240501;  ///< of surfacePoints()
constexpr int kAttempts = 20;                   ///< a point, at most
constexpr int kBatch = 256;                     ///< attempts whose rays are traced together
constexpr int kRaysPerPoint = 8;                ///< of visiblePoints(): most rays meet something, from the front

/// Uniform numbers in 0..1 that are the same with every standard library.
class Uniform {
public:
    explicit Uniform(std::uint64_t seed) : m_bits(std::mt19937::result_type(seed)) {}
    float operator()() { return float(m_bits() >> 8) * (1.0f / 16777216.0f); }

private:
    std::mt19937 m_bits;
};

struct Triangle {
    std::array<glm::vec3, 3> corners;
    bool doubleSided = false;
};

/// All triangles in the world, and the running sum of their areas.
struct Triangles {
    std::vector<Triangle> list;
    std::vector<double> areaSum;
};

Triangles worldTriangles(const Scene& scene, const ScenePose& pose) {
    Triangles all;
    double sum = 0;
    for (const Instance& instance : pose.instances)
        for (const Primitive& p : scene.meshes[std::size_t(instance.mesh)].primitives)
            for (std::size_t i = 0; i + 2 < p.indices.size(); i += 3) {
                Triangle t;
                for (std::size_t c = 0; c < 3; ++c)
                    t.corners[c] = glm::vec3(instance.toWorld * glm::vec4(p.positions[p.indices[i + c]], 1.0f));
                t.doubleSided = scene.materials[std::size_t(p.material)].doubleSided;
                if (glm::determinant(glm::mat3(instance.toWorld)) < 0) std::swap(t.corners[1], t.corners[2]);
                sum += 0.5 * double(glm::length(glm::cross(t.corners[1] - t.corners[0], t.corners[2] - t.corners[0])));
                all.list.push_back(t);
                all.areaSum.push_back(sum);
            }
    return all;
}

/// A direction of the hemisphere around `normal`, by the cosine.
glm::vec3 cosineDirection(glm::vec3 normal, float u, float v) {
    const float z = std::sqrt(1 - u), r = std::sqrt(u), phi = 2 * std::numbers::pi_v<float> * v;
    const glm::vec3 side =
        glm::normalize(glm::cross(normal, std::abs(normal.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0)));
    return glm::normalize(z * normal + r * (std::cos(phi) * side + std::sin(phi) * glm::cross(normal, side)));
}

/// A point of a surface that may lie in the open.
struct Candidate {
    FieldQuery query;
    double area = 0;  ///< of its surface over that of its triangle
    int attempt = 0;
    std::array<Ray, kOpenRays> rays;  ///< that decide
};

/// The next point by area. False: its triangle has no normal.
bool nextCandidate(const Triangles& all, float scale, Uniform& uniform, Candidate& out) {
    const double at = double(uniform()) * all.areaSum.back();
    const auto found = std::upper_bound(all.areaSum.begin(), all.areaSum.end(), at);
    const Triangle& t = all.list[std::min(std::size_t(found - all.areaSum.begin()), all.list.size() - 1)];
    const float u = std::sqrt(uniform()), v = uniform(), side = uniform(), a = uniform(), b = uniform();
    const glm::vec3 position = (1 - u) * t.corners[0] + u * (1 - v) * t.corners[1] + u * v * t.corners[2];
    glm::vec3 normal = glm::normalize(glm::cross(t.corners[1] - t.corners[0], t.corners[2] - t.corners[0]));
    if (t.doubleSided && side < 0.5f) normal = -normal;
    if (!std::isfinite(normal.x)) return false;
    for (Ray& ray : out.rays) {
        const float p = uniform(), q = uniform();
        ray = {};
        ray.origin = position + normal * (1e-4f * scale);
        ray.direction = cosineDirection(normal, p, q);
    }
    out.query = {position, normal, cosineDirection(normal, a, b)};
    out.area = t.doubleSided ? 2 : 1;
    return true;
}

/// Whether somebody could stand in front of the surface: most of what it sees are fronts (or sky), and something is
/// not so near that the point lies in a crack.
bool inTheOpen(std::span<const Hit> hits, std::span<const Surface> surfaces, float scale) {
    int backs = 0, far = 0;
    for (std::size_t i = 0; i < hits.size(); ++i) {
        backs += hits[i].valid() && surfaces[i].backface ? 1 : 0;
        far += hits[i].distance > 1e-2f * scale ? 1 : 0;
    }
    return backs < kInMatter * kOpenRays && far > kOpenRays / 4;
}

/// Which of the candidates lie in the open. Errors: those of the tracer.
Result<std::vector<bool>> whichAreOpen(const Tracer& tracer, std::span<const Candidate> candidates, float scale) {
    std::vector<Ray> rays;
    for (const Candidate& candidate : candidates) rays.insert(rays.end(), candidate.rays.begin(), candidate.rays.end());
    std::vector<Hit> hits(rays.size());
    std::vector<Surface> surfaces(rays.size());
    if (auto hit = tracer.closestHits(rays, hits); !hit) return hit.error();
    if (auto found = tracer.surfaces(rays, hits, surfaces); !found) return found.error();
    std::vector<bool> open;
    for (std::size_t i = 0; i < candidates.size(); ++i)
        open.push_back(inTheOpen(std::span(hits).subspan(i * kOpenRays, kOpenRays),
                                 std::span(surfaces).subspan(i * kOpenRays, kOpenRays), scale));
    return open;
}

/// sampleSurfaces(), where there is memory.
Result<std::vector<SurfaceSample>> samplesByArea(const Scene& scene, const ScenePose& pose, const Tracer& tracer,
                                                 int count, std::uint64_t seed) {
    const Triangles all = worldTriangles(scene, pose);
    std::vector<SurfaceSample> samples;
    if (all.list.empty() || !(all.areaSum.back() > 0)) return samples;
    const glm::vec3 size = pose.bounds.size();
    const float scale = std::cbrt(std::max(size.x * size.y * size.z, 1e-9f));
    Uniform uniform(seed);
    const int most = kAttempts * count;
    int attempts = 0, used = most;
    while (attempts < most && int(samples.size()) < count) {
        std::vector<Candidate> batch;
        for (int i = 0; i < kBatch && attempts < most; ++i, ++attempts) {
            Candidate candidate;
            candidate.attempt = attempts + 1;
            if (nextCandidate(all, scale, uniform, candidate)) batch.push_back(candidate);
        }
        const auto open = whichAreOpen(tracer, batch, scale);
        if (!open) return open.error();
        for (std::size_t i = 0; i < batch.size() && int(samples.size()) < count; ++i) {
            if (!(*open)[i]) continue;
            samples.push_back({batch[i].query, batch[i].area});
            used = batch[i].attempt;
        }
    }
    if (int(samples.size()) < count) used = attempts;
    for (SurfaceSample& sample : samples) sample.area *= all.areaSum.back() / used;
    return samples;
}

/// Rays from random places in all directions.
std::vector<Ray> randomRays(const Bounds& bounds, int count) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> uniform(0.0f, 1.0f);
    std::vector<Ray> rays;
    for (int i = 0; i < count; ++i) {
        const float atZ = uniform(random), atY = uniform(random), atX = uniform(random);
        const glm::vec3 origin = bounds.lower + glm::vec3(atX, atY, atZ) * bounds.size();
        const float z = 2 * uniform(random) - 1, phi = 6.2831853f * uniform(random), r = std::sqrt(1 - z * z);
        rays.push_back({origin, 0, {r * std::cos(phi), r * std::sin(phi), z}, 1e30f});
    }
    return rays;
}

}  // namespace

Result<std::vector<SurfaceSample>> sampleSurfaces(const Scene& scene, const ScenePose& pose, const Tracer& tracer,
                                                  int count, std::uint64_t seed) {
    return withinMemory("choose points on surfaces", [&] { return samplesByArea(scene, pose, tracer, count, seed); });
}

Result<std::vector<FieldQuery>> surfacePoints(const Scene& scene, const ScenePose& pose, const Tracer& tracer,
                                              int count) {
    const auto samples = sampleSurfaces(scene, pose, tracer, count, kUsualSeed);
    if (!samples) return samples.error();
    return withinMemory("choose points on surfaces", [&]() -> Result<std::vector<FieldQuery>> {
        std::vector<FieldQuery> queries;
        for (const SurfaceSample& sample : *samples) queries.push_back(sample.query);
        return queries;
    });
}

Result<std::vector<FieldQuery>> visiblePoints(const Tracer& tracer, const Bounds& bounds, int count) {
    return withinMemory("choose points on surfaces", [&]() -> Result<std::vector<FieldQuery>> {
        const std::vector<Ray> rays = randomRays(bounds, kRaysPerPoint * count);
        std::vector<Hit> hits(rays.size());
        std::vector<Surface> surfaces(rays.size());
        if (auto hit = tracer.closestHits(rays, hits); !hit) return hit.error();
        if (auto found = tracer.surfaces(rays, hits, surfaces); !found) return found.error();
        std::vector<FieldQuery> points;
        for (std::size_t i = 0; i < rays.size() && int(points.size()) < count; ++i)
            if (hits[i].valid() && !surfaces[i].backface)
                points.push_back({surfaces[i].position, surfaces[i].shadingNormal, -rays[i].direction});
        return points;
    });
}

}  // namespace probegi

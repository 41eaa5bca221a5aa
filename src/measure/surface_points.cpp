#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <numbers>
#include <random>

#include "measure/input_checks.h"
#include "probegi/measure.h"

namespace probegi {

namespace {

constexpr int kOpenRays = 32;       ///< that decide on which side of a surface the open lies
constexpr double kInMatter = 0.25;  ///< of the hits are backfaces: the point looks at the inside of matter
constexpr int kRaysPerPoint = 8;    ///< of visiblePoints(): most rays meet something, from the front

/// Uniform numbers in 0..1 that are the same with every standard library.
class Uniform {
public:
    float operator()() { return float(m_bits() >> 8) * (1.0f / 16777216.0f); }

private:
    std::mt19937 m_bits{20240501};
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

/// Whether somebody could stand in front of the surface: most of what it sees are fronts (or sky), and something is
/// not so near that the point lies in a crack.
Result<bool> inTheOpen(const Tracer& tracer, glm::vec3 position, glm::vec3 normal, float scale, Uniform& uniform) {
    std::array<Ray, kOpenRays> rays;
    for (Ray& ray : rays) {
        const float u = uniform(), v = uniform();
        ray.origin = position + normal * (1e-4f * scale);
        ray.direction = cosineDirection(normal, u, v);
    }
    std::array<Hit, kOpenRays> hits;
    std::array<Surface, kOpenRays> surfaces;
    if (auto hit = tracer.closestHits(rays, hits); !hit) return hit.error();
    if (auto found = tracer.surfaces(rays, hits, surfaces); !found) return found.error();
    int backs = 0, far = 0;
    for (std::size_t i = 0; i < hits.size(); ++i) {
        backs += hits[i].valid() && surfaces[i].backface ? 1 : 0;
        far += hits[i].distance > 1e-2f * scale ? 1 : 0;
    }
    return backs < kInMatter * kOpenRays && far > kOpenRays / 4;
}

/// surfacePoints(), where there is memory.
Result<std::vector<FieldQuery>> pointsByArea(const Scene& scene, const ScenePose& pose, const Tracer& tracer,
                                             int count) {
    const Triangles all = worldTriangles(scene, pose);
    std::vector<FieldQuery> queries;
    if (all.list.empty() || !(all.areaSum.back() > 0)) return queries;
    const glm::vec3 size = pose.bounds.size();
    const float scale = std::cbrt(std::max(size.x * size.y * size.z, 1e-9f));
    Uniform uniform;
    for (int attempt = 0; attempt < 20 * count && int(queries.size()) < count; ++attempt) {
        const double at = double(uniform()) * all.areaSum.back();
        const auto found = std::upper_bound(all.areaSum.begin(), all.areaSum.end(), at);
        const Triangle& t = all.list[std::min(std::size_t(found - all.areaSum.begin()), all.list.size() - 1)];
        const float u = std::sqrt(uniform()), v = uniform(), side = uniform(), a = uniform(), b = uniform();
        const glm::vec3 position = (1 - u) * t.corners[0] + u * (1 - v) * t.corners[1] + u * v * t.corners[2];
        glm::vec3 normal = glm::normalize(glm::cross(t.corners[1] - t.corners[0], t.corners[2] - t.corners[0]));
        if (t.doubleSided && side < 0.5f) normal = -normal;
        if (!std::isfinite(normal.x)) continue;
        const auto open = inTheOpen(tracer, position, normal, scale, uniform);
        if (!open) return open.error();
        if (*open) queries.push_back({position, normal, cosineDirection(normal, a, b)});
    }
    return queries;
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

Result<std::vector<FieldQuery>> surfacePoints(const Scene& scene, const ScenePose& pose, const Tracer& tracer,
                                              int count) {
    return withinMemory("choose points on surfaces", [&] { return pointsByArea(scene, pose, tracer, count); });
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

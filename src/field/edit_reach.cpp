#include "field/edit_reach.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "kernels/random.h"
#include "kernels/sampling.h"
#include "kernels/trace/ray_offset.h"

namespace probegi {

namespace {

constexpr float kEndless = 1e30f;
constexpr float kGap = 1e-3f;  // between a box and where its rays begin, over its diagonal

float unit(std::uint32_t& state) {
    return kernels::nextRandom(state);
}

bool isPoint(const EditSource& source) {
    return source.box.lower == source.box.upper;
}

// Uniform in the cone about the axis.
glm::vec3 coneDirection(const EditSource& source, glm::vec2 u) {
    if (source.axis == glm::vec3(0.0f)) return kernels::sampleSphere(u);
    const float cosine = 1 - u.x * (1 - source.cosCone);
    const glm::vec3 onCircle = kernels::sampleSphere({0.5f, u.y});
    const float sine = std::sqrt(std::max(0.0f, 1 - cosine * cosine));
    return kernels::toWorld(kernels::orthonormalBasis(source.axis), {sine * onCircle.x, sine * onCircle.y, cosine});
}

// From a random point of a box's faces outwards.
Ray rayFromBox(const Bounds& box, std::uint32_t& state) {
    const glm::vec3 size = box.size();
    const glm::vec3 areas(size.y * size.z, size.z * size.x, size.x * size.y);
    float choice = unit(state) * (areas.x + areas.y + areas.z);
    int axis = 0;
    while (axis < 2 && choice >= areas[axis]) choice -= areas[axis++];
    const bool up = unit(state) < 0.5f;
    const float x = unit(state), y = unit(state), z = unit(state), u = unit(state), v = unit(state);
    glm::vec3 at = box.lower + glm::vec3(x, y, z) * size;
    // Not on the face itself, which may be the object's own.
    const float gap = kGap * glm::length(size);
    at[axis] = up ? box.upper[axis] + gap : box.lower[axis] - gap;
    glm::vec3 normal(0.0f);
    normal[axis] = up ? 1.0f : -1.0f;
    Ray ray;
    ray.origin = at;
    ray.direction = kernels::toWorld(kernels::orthonormalBasis(normal), kernels::sampleCosineHemisphere({u, v}));
    return ray;
}

Ray rayFrom(const EditSource& source, std::uint32_t number) {
    std::uint32_t state = kernels::hashUint(number);
    if (!isPoint(source)) return rayFromBox(source.box, state);
    const float u = unit(state), v = unit(state);
    Ray ray;
    ray.origin = source.box.lower;
    ray.direction = coneDirection(source, {u, v});
    ray.far = source.range > 0 ? source.range : kEndless;
    return ray;
}

// How far a ray runs inside a box; 0 if it is never in it.
float wayThrough(const Bounds& box, const Ray& ray) {
    float enters = 0, leaves = ray.far;
    for (int axis = 0; axis < 3; ++axis) {
        if (ray.direction[axis] == 0) continue;
        const float a = (box.lower[axis] - ray.origin[axis]) / ray.direction[axis];
        const float b = (box.upper[axis] - ray.origin[axis]) / ray.direction[axis];
        enters = std::max(enters, std::min(a, b));
        leaves = std::min(leaves, std::max(a, b));
    }
    return leaves > enters && leaves < kEndless ? leaves : 0.0f;
}

void extend(Bounds& box, glm::vec3 point) {
    box.lower = glm::min(box.lower, point);
    box.upper = glm::max(box.upper, point);
}

// Where the light of a ray ends.
glm::vec3 endOf(const Ray& ray, const Hit& hit, const Bounds& scene) {
    return ray.origin + (hit.valid() ? hit.distance : wayThrough(scene, ray)) * ray.direction;
}

// The rays that go on from what was met, those of no hit with no length.
std::vector<Ray> bouncedRays(std::span<const Hit> hits, std::span<const Surface> surfaces, const Bounds& scene) {
    const float magnitude =
        std::max({glm::length(scene.lower), glm::length(scene.upper), std::numeric_limits<float>::min()});
    std::vector<Ray> rays(hits.size());
    for (std::size_t i = 0; i < hits.size(); ++i) {
        std::uint32_t state = kernels::hashUint(std::uint32_t(i) ^ 0x9e3779b9u);
        const float u = unit(state), v = unit(state);
        if (!hits[i].valid() || surfaces[i].backface) {
            rays[i].far = 0;
            continue;
        }
        const glm::vec3 normal = surfaces[i].geometricNormal;
        rays[i].origin = kernels::offsetOrigin(surfaces[i].position, normal, magnitude);
        rays[i].direction =
            kernels::toWorld(kernels::orthonormalBasis(normal), kernels::sampleCosineHemisphere({u, v}));
    }
    return rays;
}

}  // namespace

Result<std::vector<EditReach>> findReaches(const Tracer& tracer, const std::vector<EditSource>& sources) {
    std::vector<Ray> rays;
    rays.reserve(sources.size() * kReachRays);
    for (const EditSource& source : sources)
        for (std::uint32_t i = 0; i < kReachRays; ++i) rays.push_back(rayFrom(source, i));
    std::vector<Hit> hits(rays.size());
    std::vector<Surface> surfaces(rays.size());
    if (auto traced = tracer.closestHits(rays, hits); !traced) return traced.error();
    if (auto resolved = tracer.surfaces(rays, hits, surfaces); !resolved) return resolved.error();
    const Bounds scene = tracer.bounds();
    const std::vector<Ray> bounced = bouncedRays(hits, surfaces, scene);
    std::vector<Hit> bouncedHits(bounced.size());
    if (auto traced = tracer.closestHits(bounced, bouncedHits); !traced) return traced.error();

    std::vector<EditReach> reaches;
    for (std::size_t s = 0; s < sources.size(); ++s) {
        EditReach reach{sources[s].box};
        double sum = 0;
        int met = 0;
        for (std::size_t i = s * kReachRays; i < (s + 1) * kReachRays; ++i) {
            extend(reach.box, endOf(rays[i], hits[i], scene));
            if (!hits[i].valid()) continue;
            sum += double(hits[i].distance);
            ++met;
            if (bounced[i].far > 0) extend(reach.box, endOf(bounced[i], bouncedHits[i], scene));
        }
        reach.meanDistance = met > 0 ? float(sum / met) : 0.0f;
        reaches.push_back(reach);
    }
    return reaches;
}

}  // namespace probegi

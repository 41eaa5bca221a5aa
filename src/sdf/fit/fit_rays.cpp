#include "sdf/fit/fit_rays.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/parallel.h"
#include "kernels/random.h"
#include "kernels/sampling.h"

namespace probegi {

namespace {

constexpr std::size_t kWalkers = 4096;
constexpr int kTestRays = 32;         ///< that tell air from matter
constexpr float kMostBacks = 0.1f;    ///< share of their hits that may be backs of surfaces
constexpr float kLeastSeen = 0.4f;    ///< share of them that hit something, where one stands on ground or in a room
constexpr int kStartAttempts = 24;    ///< rounds of random starting points
constexpr int kInsideAttempts = 8;    ///< of them, in the bounds if there is any air
constexpr float kAround = 0.5f;       ///< of the scene's size, by which it is surrounded by air
constexpr std::size_t kGrain = 1024;  ///< rays per task

glm::vec3 randomPoint(const Bounds& bounds, std::uint32_t& state) {
    const float x = kernels::nextRandom(state);
    const float y = kernels::nextRandom(state);
    return bounds.lower + bounds.size() * glm::vec3(x, y, kernels::nextRandom(state));
}

Bounds widened(const Bounds& bounds) {
    const glm::vec3 margin(kAround * glm::length(bounds.size()));
    return {bounds.lower - margin, bounds.upper + margin};
}

glm::vec3 randomDirection(std::uint32_t& state) {
    const float u = kernels::nextRandom(state);
    return kernels::sampleSphere({u, kernels::nextRandom(state)});
}

/// How far a ray that meets nothing may be walked along: to the end of the bounds.
float leaves(const Bounds& bounds, const Ray& ray) {
    float end = kFitSky;
    for (int axis = 0; axis < 3; ++axis) {
        if (ray.direction[axis] == 0) continue;
        const float wall = ray.direction[axis] > 0 ? bounds.upper[axis] : bounds.lower[axis];
        end = std::min(end, (wall - ray.origin[axis]) / ray.direction[axis]);
    }
    return std::max(end, 0.0f);
}

struct Traced {
    std::vector<Hit> hits;
    std::vector<Surface> surfaces;
};

Result<Traced> trace(const Context& context, const Tracer& tracer, std::span<const Ray> rays) {
    Traced out{std::vector<Hit>(rays.size()), std::vector<Surface>(rays.size())};
    auto done = tryParallelFor(context, rays.size(), kGrain, [&](std::size_t begin, std::size_t end) -> Result<void> {
        const auto part = rays.subspan(begin, end - begin);
        const auto hits = std::span(out.hits).subspan(begin, end - begin);
        if (auto found = tracer.closestHits(part, hits); !found) return found;
        return tracer.surfaces(part, hits, std::span(out.surfaces).subspan(begin, end - begin));
    });
    if (!done) return done.error();
    return out;
}

/// Those of `points` that lie in air and from which something is seen in at least `least` of all directions.
Result<std::vector<glm::vec3>> inAir(const Context& context, const Tracer& tracer, std::span<const glm::vec3> points,
                                     float least, std::uint32_t& state) {
    std::vector<Ray> rays;
    rays.reserve(points.size() * kTestRays);
    for (const glm::vec3& p : points)
        for (int i = 0; i < kTestRays; ++i) rays.push_back({.origin = p, .direction = randomDirection(state)});
    const auto traced = trace(context, tracer, rays);
    if (!traced) return traced.error();
    std::vector<glm::vec3> air;
    for (std::size_t p = 0; p < points.size(); ++p) {
        int hits = 0, backs = 0;
        for (std::size_t i = p * kTestRays; i < (p + 1) * kTestRays; ++i) {
            hits += traced->hits[i].valid();
            backs += traced->hits[i].valid() && traced->surfaces[i].back;
        }
        if (hits > 0 && float(hits) >= least * kTestRays && float(backs) <= kMostBacks * float(hits))
            air.push_back(points[p]);
    }
    return air;
}

/// Where walks begin: half at the cameras, if these are in air, half all over the bounds.
Result<std::vector<glm::vec3>> startingPoints(const Context& context, const Tracer& tracer,
                                              std::span<const PlacedCamera> cameras, std::uint32_t& state) {
    std::vector<glm::vec3> places;
    for (const PlacedCamera& camera : cameras) places.push_back(camera.position);
    const auto good = inAir(context, tracer, places, 0, state);
    if (!good) return good.error();
    std::vector<glm::vec3> starts;
    Bounds bounds = tracer.bounds();
    for (int round = 0; round < kStartAttempts && starts.size() < kWalkers / 2; ++round) {
        // A single body fills its bounds: it is seen from around it.
        const bool around = round >= kInsideAttempts && starts.empty();
        if (around) bounds = widened(tracer.bounds());
        places.clear();
        for (std::size_t i = 0; i < kWalkers / 8; ++i) places.push_back(randomPoint(bounds, state));
        const auto air = inAir(context, tracer, places, around ? 0 : kLeastSeen, state);
        if (!air) return air.error();
        starts.insert(starts.end(), air->begin(), air->end());
    }
    starts.resize(std::min(starts.size(), kWalkers / 2));
    const std::size_t spread = starts.size();
    for (std::size_t i = 0; !good->empty() && i < std::max(spread, kWalkers / 2); ++i)
        starts.push_back((*good)[i % good->size()]);
    return starts;
}

}  // namespace

Result<FitRays> walkThrough(const Context& context, const Tracer& tracer, std::span<const PlacedCamera> cameras,
                            std::size_t count, std::uint32_t seed) {
    std::uint32_t state = kernels::hashUint(seed);
    FitRays out;
    const auto starts = startingPoints(context, tracer, cameras, state);
    if (!starts) return starts.error();
    if (starts->empty()) return out;
    Bounds bounds = tracer.bounds();
    for (const glm::vec3& start : *starts) bounds = {glm::min(bounds.lower, start), glm::max(bounds.upper, start)};
    std::vector<Ray> rays(starts->size());
    for (std::size_t i = 0; i < rays.size(); ++i) rays[i].origin = (*starts)[i];
    out.rays.reserve(count);
    out.surfaces.reserve(count);
    // A scene of backs alone gives no rays, however long one walks.
    for (std::size_t steps = 0; out.rays.size() < count && steps < 4 * count / rays.size() + 16; ++steps) {
        for (Ray& ray : rays) ray.direction = randomDirection(state);
        const auto traced = trace(context, tracer, rays);
        if (!traced) return traced.error();
        for (std::size_t i = 0; i < rays.size(); ++i) {
            Ray& ray = rays[i];
            const Hit& hit = traced->hits[i];
            const Surface& surface = traced->surfaces[i];
            if (hit.valid() && surface.back) {
                ray.origin = (*starts)[i];
                continue;
            }
            const float length = hit.valid() ? hit.distance : leaves(bounds, ray);
            if (out.rays.size() < count) {
                FitSurface seen;
                if (hit.valid()) seen = {surface.geometricNormal, surface.albedo, surface.emission, surface.material};
                const float cosine =
                    hit.valid() ? std::min(std::abs(glm::dot(surface.geometricNormal, ray.direction)), 1.0f) : 1.0f;
                out.rays.push_back({ray.origin, hit.valid() ? hit.distance : kFitSky, ray.direction, cosine});
                out.surfaces.push_back(seen);
            }
            ray.origin += ray.direction * (length * 0.98f * kernels::nextRandom(state));
        }
    }
    return out;
}

std::vector<FitRay> raysIn(const glm::mat3& frame, std::span<const FitRay> rays) {
    const glm::mat3 inverse = glm::transpose(frame);
    std::vector<FitRay> out(rays.begin(), rays.end());
    for (FitRay& ray : out) {
        ray.origin = inverse * ray.origin;
        ray.direction = inverse * ray.direction;
    }
    return out;
}

}  // namespace probegi

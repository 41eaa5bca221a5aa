#include "sdf/fit/sdf_accuracy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/parallel.h"
#include "core/sentence.h"
#include "kernels/sdf/ray_span.h"
#include "kernels/sdf/union_hit.h"
#include "sdf/fit/fit_frames.h"
#include "sdf/fit/fit_light.h"
#include "sdf/placed_primitives.h"

namespace probegi {

namespace {

constexpr std::size_t kGrain = 4096;       ///< rays per task
constexpr float kDim = 0.5f * kOpenLight;  ///< light below which a place is dim

float distanceToUnion(std::span<const kernels::SdfSolid> solids, glm::vec3 point) noexcept {
    float nearest = kernels::kSdfFar;
    for (const kernels::SdfSolid& solid : solids) nearest = std::min(nearest, kernels::sdfDistance(solid, point));
    return std::abs(nearest);
}

/// Sums over rays.
struct Sums {
    std::int64_t sky = 0, blocked = 0, surfaces = 0, leaking = 0, inside = 0, primitives = 0;
    std::int64_t dim = 0, dimSky = 0, dimBlocked = 0, dimLeaking = 0;
    double toPrimitives = 0, toScene = 0;

    void add(const Sums& other) noexcept {
        sky += other.sky, blocked += other.blocked, surfaces += other.surfaces, leaking += other.leaking;
        inside += other.inside, primitives += other.primitives;
        dim += other.dim, dimSky += other.dimSky, dimBlocked += other.dimBlocked, dimLeaking += other.dimLeaking;
        toPrimitives += other.toPrimitives, toScene += other.toScene;
    }
};

void addDim(bool sky, float distance, Sums& sums) noexcept {
    ++sums.dim;
    sums.dimSky += sky;
    sums.dimBlocked += sky && distance < kFitSky;
    sums.dimLeaking += !sky && distance >= kFitSky;
}

/// A point where a ray meets a primitive, and how far the scene may be from it at most.
struct Met {
    glm::vec3 point;
    glm::vec3 normal;
    float along;  ///< to the scene along the ray, kFitSky: not that way
};

/// Adds up how far points of primitives are from the scene: the least of the way along the ray and along the normal.
Result<void> addToScene(const Tracer& tracer, std::span<const Met> points, Sums& sums) {
    std::vector<Ray> rays;
    for (const Met& met : points)
        for (const float sign : {1.0f, -1.0f}) rays.push_back({.origin = met.point, .direction = sign * met.normal});
    std::vector<Hit> hits(rays.size());
    if (auto traced = tracer.closestHits(rays, hits); !traced) return traced;
    for (std::size_t i = 0; i < points.size(); ++i) {
        float nearest = points[i].along;
        for (std::size_t k = 2 * i; k < 2 * i + 2; ++k)
            if (hits[k].valid()) nearest = std::min(nearest, hits[k].distance);
        if (nearest >= kFitSky) continue;
        sums.toScene += double(nearest);
        ++sums.primitives;
    }
    return {};
}

Result<Sums> sumsOf(const Tracer& tracer, std::span<const FitRay> rays, std::span<const float> light,
                    std::span<const kernels::SdfSolid> solids) {
    Sums sums;
    std::vector<Met> met;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const FitRay& ray = rays[i];
        int number = -1;
        const float distance = entersUnion(solids, ray, number);
        const bool sky = ray.distance >= kFitSky;
        if (light[i] < kDim) addDim(sky, distance, sums);
        (sky ? sums.sky : sums.surfaces) += 1;
        sums.inside += distance <= 0;
        if (!sky) sums.toPrimitives += double(distanceToUnion(solids, ray.origin + ray.direction * ray.distance));
        if (distance >= kFitSky) {
            sums.leaking += !sky;
            continue;
        }
        sums.blocked += sky;
        if (distance <= 0) continue;
        const glm::vec3 point = ray.origin + ray.direction * distance;
        const float along = sky ? kFitSky : std::abs(ray.distance - distance);
        met.push_back({point, kernels::sdfSurfaceNormal(solids[std::size_t(number)], point), along});
    }
    if (auto added = addToScene(tracer, met, sums); !added) return added.error();
    return sums;
}

}  // namespace

float entersUnion(std::span<const kernels::SdfSolid> solids, const FitRay& ray, int& number) noexcept {
    kernels::SdfFound found = kernels::sdfFoundNone(kFitSky);
    for (std::size_t i = 0; i < solids.size(); ++i) {
        const kernels::SdfSpan span = kernels::sdfRaySpan(solids[i], ray.origin, ray.direction);
        if (kernels::sdfStartsInside(span, 0)) {
            number = int(i);
            return 0;
        }
        kernels::sdfEnter(found, span, 0, int(i));
    }
    number = found.solid;
    return found.solid < 0 ? kFitSky : found.distance;
}

Result<SdfAccuracy> accuracyBy(const Context& context, const Tracer& tracer, std::span<const FitRay> rays,
                               std::span<const float> light, std::span<const kernels::SdfSolid> solids) {
    std::vector<Sums> parts((rays.size() + kGrain - 1) / kGrain);
    auto done = tryParallelFor(context, rays.size(), kGrain, [&](std::size_t begin, std::size_t end) -> Result<void> {
        auto part = sumsOf(tracer, rays.subspan(begin, end - begin), light.subspan(begin, end - begin), solids);
        if (!part) return part.error();
        parts[begin / kGrain] = *part;
        return {};
    });
    if (!done) return done.error();
    Sums sums;
    for (const Sums& part : parts) sums.add(part);
    const auto share = [](auto part, std::int64_t of) { return of > 0 ? double(part) / double(of) : 0.0; };
    const auto count = std::int64_t(rays.size());
    SdfAccuracy out;
    out.rays = count;
    out.skyRays = share(sums.sky, count);
    out.toPrimitives = solids.empty() ? 0 : share(sums.toPrimitives, sums.surfaces);
    out.toScene = share(sums.toScene, sums.primitives);
    out.leaking = share(sums.leaking, count);
    out.blockedSky = share(sums.blocked, sums.sky);
    out.startInside = share(sums.inside, count);
    out.dimRays = share(sums.dim, count);
    out.dimSkyRays = share(sums.dimSky, count);
    out.dimBlockedSky = share(sums.dimBlocked, sums.dimSky);
    out.dimLeaking = share(sums.dimLeaking, sums.dimSky);
    return out;
}

Result<SdfAccuracy> measureSdf(const Context& context, const Scene& scene, const ScenePose& pose, const Tracer& tracer,
                               const SdfScene& sdf, int rays, std::uint32_t seed) {
    if (rays < 1000 || rays > 16'000'000)
        return fail(ErrorCode::invalidArgument, sentence("rays is ", rays, "; it must be 1000 to 16000000"));
    const auto placed = PlacedPrimitives::create(sdf, scene, pose);
    if (!placed) return placed.error();
    const auto walked = walkThrough(context, tracer, pose.cameras, std::size_t(rays), seed);
    if (!walked) return walked.error();
    if (walked->rays.empty()) return SdfAccuracy();
    const std::vector<float> light = lightOfStarts(walked->rays, findFrames(walked->surfaces, 1)[0]);
    return accuracyBy(context, tracer, walked->rays, light, placed->solids());
}

}  // namespace probegi

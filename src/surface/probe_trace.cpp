#include "surface/probe_trace.h"

#include <chrono>
#include <glm/geometric.hpp>
#include <vector>

#include "core/parallel.h"
#include "kernels/bounce.h"
#include "kernels/language.h"
#include "kernels/probe_blend.h"
#include "scene/sky.h"
#include "surface/lighting.h"

namespace probegi {

namespace {

using Clock = std::chrono::steady_clock;

// Rays a task, about: enough to amortise calls, few enough for the second-level cache.
constexpr std::size_t kRaysPerTask = 1152;

std::int64_t nanoseconds(Clock::duration d) {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(d).count();
}

// Everything a task needs, kept between tasks of a thread.
struct TaskBuffers {
    std::vector<Ray> rays, shadowRays;
    std::vector<Hit> hits;
    std::vector<Surface> surfaces;
    std::vector<std::uint32_t> lit;       // indices into rays of hits that reflect
    std::vector<std::uint32_t> shadowed;  // for each shadow ray: index into lit
    std::vector<glm::vec3> unshadowed;    // for each shadow ray: irradiance where it is not blocked
    std::vector<std::uint8_t> blocked;
    std::vector<FieldQuery> queries;
    std::vector<glm::vec3> irradiance;  // for each entry of lit
};

void makeRays(const GridDesc& grid, std::span<const glm::vec3> directions, std::size_t begin, std::size_t end,
              TaskBuffers& b) {
    b.rays.clear();
    for (std::size_t probe = begin; probe < end; ++probe) {
        const glm::vec3 origin = probePosition(grid, int(probe));
        for (const glm::vec3& d : directions) b.rays.push_back({origin, 0.0f, d, 1e30f});
    }
    b.hits.resize(b.rays.size());
    b.surfaces.resize(b.rays.size());
}

// Irradiance from punctual lights, added to b.irradiance.
void addDirectLight(const Tracer& tracer, const Lighting& lighting, float magnitude, TaskBuffers& b) {
    for (const PlacedLight& light : lighting.lights) {
        b.shadowRays.clear();
        b.shadowed.clear();
        b.unshadowed.clear();
        for (std::uint32_t i = 0; i < b.lit.size(); ++i) {
            const Surface& s = b.surfaces[b.lit[i]];
            const kernels::LightSample sample = sampleLight(light, s.position);
            const float cosine = glm::dot(sample.toLight, s.shadingNormal);
            if (!(cosine > 0) || !(glm::dot(sample.toLight, s.geometricNormal) > 0)) continue;
            const glm::vec3 e = sample.irradianceAtNormal * cosine;
            if (e == glm::vec3(0)) continue;
            b.shadowRays.push_back(shadowRay(s.position, s.geometricNormal, sample, magnitude));
            b.shadowed.push_back(i);
            b.unshadowed.push_back(e);
        }
        b.blocked.resize(b.shadowRays.size());
        tracer.occluded(b.shadowRays, b.blocked);
        for (std::size_t k = 0; k < b.blocked.size(); ++k)
            if (!b.blocked[k]) b.irradiance[b.shadowed[k]] += b.unshadowed[k];
    }
}

// Irradiance of earlier bounces at the hits: last frame's field (section 2.3).
void queryBounces(const BounceQuery& bounces, TaskBuffers& b) {
    b.irradiance.assign(b.lit.size(), glm::vec3(0));
    if (!bounces) return;
    b.queries.clear();
    for (const std::uint32_t i : b.lit)
        b.queries.push_back({b.surfaces[i].position, b.surfaces[i].shadingNormal, -b.rays[i].direction});
    bounces(b.queries, b.irradiance);
}

// Distances and the radiance that does not depend on other light; lists the hits that reflect.
void resolveHits(const Lighting& lighting, TaskBuffers& b, RayDatum* out) {
    b.lit.clear();
    for (std::uint32_t i = 0; i < b.rays.size(); ++i) {
        const Hit& hit = b.hits[i];
        if (!hit.valid()) {
            out[i] = {skyRadiance(lighting.sky, b.rays[i].direction), 1e30f};
        } else if (b.surfaces[i].backface) {
            out[i] = {glm::vec3(0), -hit.distance};
        } else {
            out[i] = {b.surfaces[i].emission, hit.distance};
            b.lit.push_back(i);
        }
    }
}

}  // namespace

void traceProbes(const Context& context, const GridDesc& grid, std::span<const glm::vec3> directions,
                 const Tracer& tracer, const Lighting& lighting, const BounceQuery& bounces,
                 std::span<RayDatum> rayData, TraceTimes& times) {
    const float magnitude = sceneMagnitude(tracer.bounds());
    const std::size_t probesPerTask = std::max<std::size_t>(1, kRaysPerTask / directions.size());
    parallelFor(context, std::size_t(probeCount(grid)), probesPerTask, [&](std::size_t begin, std::size_t end) {
        thread_local TaskBuffers b;
        const auto start = Clock::now();
        makeRays(grid, directions, begin, end, b);
        tracer.closestHits(b.rays, b.hits);
        const auto traced = Clock::now();

        tracer.surfaces(b.rays, b.hits, b.surfaces);
        RayDatum* out = rayData.data() + begin * directions.size();
        resolveHits(lighting, b, out);
        queryBounces(bounces, b);
        addDirectLight(tracer, lighting, magnitude, b);
        for (std::size_t k = 0; k < b.lit.size(); ++k) {
            const Surface& surface = b.surfaces[b.lit[k]];
            RayDatum& datum = out[b.lit[k]];
            datum.radiance += kernels::bounceRadiance(surface.albedo, b.irradiance[k]);
            if (surface.back) datum = {kernels::radianceFromBack(datum.radiance), -datum.distance};
        }
        times.traceNs += nanoseconds(traced - start);
        times.shadeNs += nanoseconds(Clock::now() - traced);
    });
}

}  // namespace probegi

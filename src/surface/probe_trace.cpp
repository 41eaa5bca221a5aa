#include "surface/probe_trace.h"

#include <chrono>
#include <glm/geometric.hpp>
#include <vector>

#include "core/parallel.h"
#include "kernels/bounce.h"
#include "kernels/colour.h"
#include "kernels/language.h"
#include "kernels/probe_blend.h"
#include "scene/sky.h"
#include "surface/lighting.h"
#include "surface/probe_emitters.h"

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
    std::vector<glm::vec3> irradiance;  // for each entry of lit: from punctual lights
    std::vector<glm::vec3> bounced;     // for each entry of lit: from the field
};

// All update rays of a task's probes, then all their fixed rays.
void makeRays(const GridDesc& grid, const ProbeRayDirections& directions, std::size_t begin, std::size_t end,
              TaskBuffers& b) {
    b.rays.clear();
    for (const std::span<const glm::vec3> kind : {directions.update, directions.fixed})
        for (std::size_t probe = begin; probe < end; ++probe) {
            const glm::vec3 origin = probePosition(grid, int(probe));
            for (const glm::vec3& d : kind) b.rays.push_back({origin, 0.0f, d, 1e30f});
        }
    b.hits.resize(b.rays.size());
    b.surfaces.resize(b.rays.size());
}

// Irradiance from punctual lights, in b.irradiance.
Result<void> gatherDirectLight(const Tracer& tracer, const Lighting& lighting, float magnitude, TaskBuffers& b) {
    b.irradiance.assign(b.lit.size(), glm::vec3(0));
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
        if (auto traced = tracer.occluded(b.shadowRays, b.blocked); !traced) return traced;
        for (std::size_t k = 0; k < b.blocked.size(); ++k)
            if (!b.blocked[k]) b.irradiance[b.shadowed[k]] += b.unshadowed[k];
    }
    return {};
}

// Irradiance of earlier bounces at the hits: last frame's field (section 2.3).
Result<void> queryBounces(const BounceQuery& bounces, TaskBuffers& b) {
    b.bounced.assign(b.lit.size(), glm::vec3(0));
    if (!bounces) return {};
    b.queries.clear();
    for (const std::uint32_t i : b.lit)
        b.queries.push_back({b.surfaces[i].position, b.surfaces[i].shadingNormal, -b.rays[i].direction});
    return bounces(b.queries, b.bounced);
}

// Where the data of a task's rays go.
struct TaskOutput {
    std::span<RayDatum> update;
    std::span<FixedRayDatum> fixed;

    // The radiance that does not depend on other light.
    void set(std::size_t ray, glm::vec3 radiance, float distance) const {
        if (ray < update.size())
            update[ray] = {radiance, distance};
        else
            fixed[ray - update.size()] = {kernels::luminance(radiance), 0.0f, distance};
    }
    void add(std::size_t ray, glm::vec3 direct, glm::vec3 bounced) const {
        if (ray < update.size()) {
            update[ray].radiance += direct + bounced;
        } else {
            fixed[ray - update.size()].direct += kernels::luminance(direct);
            fixed[ray - update.size()].bounced += kernels::luminance(bounced);
        }
    }
    // The ray met the back of a surface with two sides: see RayDatum.
    void markBack(std::size_t ray) const {
        if (ray < update.size())
            update[ray] = {kernels::radianceFromBack(update[ray].radiance), -update[ray].distance};
        else
            fixed[ray - update.size()].distance *= -1.0f;
    }
};

// Distances and the radiance that does not depend on other light; lists the hits that reflect.
void resolveHits(const Lighting& lighting, const EmitterSearch& emitters, TaskBuffers& b, const TaskOutput& out) {
    b.lit.clear();
    for (std::uint32_t i = 0; i < b.rays.size(); ++i) {
        const Hit& hit = b.hits[i];
        if (!hit.valid()) {
            out.set(i, skyRadiance(lighting.sky, b.rays[i].direction), 1e30f);
        } else if (b.surfaces[i].backface) {
            out.set(i, glm::vec3(0), -hit.distance);
        } else {
            // Fixed rays see all of an emission: looks at emitters add nothing to them.
            const float share = i < out.update.size() ? emitters.rayShare(b.surfaces[i].material, hit.distance) : 1.0f;
            out.set(i, b.surfaces[i].emission * share, hit.distance);
            b.lit.push_back(i);
        }
    }
}

TaskOutput outputOf(const ProbeRayDirections& directions, const ProbeRayData& out, std::size_t begin, std::size_t end) {
    const std::size_t rays = directions.update.size(), fixed = directions.fixed.size();
    return {out.update.subspan(begin * rays, (end - begin) * rays),
            out.fixed.subspan(begin * fixed, (end - begin) * fixed)};
}

// What a task's rays bring home, from their hits on.
Result<void> shadeTask(const Tracer& tracer, const Lighting& lighting, float magnitude, const BounceQuery& bounces,
                       const EmitterSearch& emitters, TaskBuffers& b, const TaskOutput& task) {
    if (auto seen = tracer.surfaces(b.rays, b.hits, b.surfaces); !seen) return seen;
    resolveHits(lighting, emitters, b, task);
    if (auto asked = queryBounces(bounces, b); !asked) return asked;
    if (auto lit = gatherDirectLight(tracer, lighting, magnitude, b); !lit) return lit;
    for (std::size_t k = 0; k < b.lit.size(); ++k) {
        const Surface& surface = b.surfaces[b.lit[k]];
        task.add(b.lit[k], kernels::bounceRadiance(surface.albedo, b.irradiance[k]),
                 kernels::bounceRadiance(surface.albedo, b.bounced[k]));
        if (surface.back) task.markBack(b.lit[k]);
    }
    return {};
}

}  // namespace

Result<void> traceProbes(const Context& context, const GridDesc& grid, const ProbeRayDirections& directions,
                         const Tracer& tracer, const Lighting& lighting, const BounceQuery& bounces,
                         const EmitterSearch& emitters, const ProbeRayData& out, TraceTimes& times) {
    const float magnitude = sceneMagnitude(tracer.bounds());
    const std::size_t probesPerTask =
        std::max<std::size_t>(1, kRaysPerTask / (directions.update.size() + directions.fixed.size()));
    const auto trace = [&](std::size_t begin, std::size_t end) -> Result<void> {
        thread_local TaskBuffers b;
        const auto start = Clock::now();
        makeRays(grid, directions, begin, end, b);
        if (auto hit = tracer.closestHits(b.rays, b.hits); !hit) return hit;
        const auto traced = Clock::now();
        const TaskOutput task = outputOf(directions, out, begin, end);
        if (auto shaded = shadeTask(tracer, lighting, magnitude, bounces, emitters, b, task); !shaded) return shaded;
        times.traceNs += nanoseconds(traced - start);
        times.shadeNs += nanoseconds(Clock::now() - traced);
        return {};
    };
    return tryParallelFor(context, std::size_t(probeCount(grid)), probesPerTask, trace);
}

}  // namespace probegi

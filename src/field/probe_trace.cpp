#include "field/probe_trace.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <vector>

#include "core/parallel.h"
#include "field/probe_emitters.h"
#include "field/ray_order.h"
#include "geometry/lighting.h"
#include "kernels/blend/probe_blend.h"
#include "kernels/language.h"
#include "kernels/screen/colour.h"
#include "kernels/shade/bounce.h"
#include "scene/sky_radiance.h"

namespace probegi {

namespace {

// Approximate rays per batch: enough to amortise calls, few enough for the L2 cache.
constexpr std::size_t kRaysPerBatch = 1152;

// Light along a ray.
struct RayLight {
    glm::vec3 emitted{0.0f};  // independent of other light
    float distance = 0;
    glm::vec3 direct{0.0f}, bounced{0.0f};  // reflected
    bool back = false;                      // from the back of a double-sided surface: see RayDatum
};

// Everything a batch needs, kept between batches of a thread. What has an entry for each ray is as long as the longest
// batch, and filled in place, field by field: whole structs would go through memory twice.
struct BatchBuffers {
    std::span<const std::uint32_t> tasks;
    std::vector<glm::vec3> origins;  // of their rays
    std::vector<Ray> rays, shadowRays;
    std::vector<Hit> hits;
    std::vector<Surface> surfaces;
    std::vector<RayLight> light;
    std::vector<std::uint32_t> lit;       // indices into rays of hits that reflect
    std::vector<std::uint32_t> shadowed;  // for each shadow ray: index into lit
    std::vector<glm::vec3> unshadowed;    // for each shadow ray: irradiance if unoccluded
    std::vector<std::uint8_t> blocked;
    std::vector<FieldQuery> queries;
    std::vector<glm::vec3> irradiance;  // for each entry of lit: from punctual lights
    std::vector<glm::vec3> bounced;     // for each entry of lit: from the field

    void reserve(std::size_t most) {
        if (rays.size() >= most) return;
        const auto each = [most](auto&... buffers) { (buffers.resize(most), ...); };
        // The rays last: if memory runs out, the others are requested again.
        each(shadowRays, hits, surfaces, light, shadowed, unshadowed, blocked, queries, irradiance, bounced, rays);
    }
};

// Directions of a batch: a part of the update rays' or of the fixed rays'.
struct Batch {
    std::span<const OrderedDirection> directions;
    bool fixed;
};

std::vector<Batch> makeBatches(std::span<const OrderedDirection> update, std::span<const OrderedDirection> fixed) {
    constexpr std::size_t kMost = kRaysPerBatch / TaskBlocks::kMostTasks;
    std::vector<Batch> batches;
    const auto add = [&](std::span<const OrderedDirection> all, bool isFixed) {
        for (std::size_t begin = 0; begin < all.size(); begin += kMost)
            batches.push_back({all.subspan(begin, std::min(kMost, all.size() - begin)), isFixed});
    };
    add(update, false);
    add(fixed, true);
    return batches;
}

// Rays of one direction side by side. Returns how many.
std::size_t makeRays(const Batch& batch, BatchBuffers& b) {
    const std::size_t count = batch.directions.size() * b.origins.size();
    b.reserve(count);
    Ray* ray = b.rays.data();
    for (const OrderedDirection& d : batch.directions)
        for (const glm::vec3& origin : b.origins) {
            ray->origin = origin;
            ray->direction = d.direction;
            ++ray;
        }
    return count;
}

// Irradiance from punctual lights, in b.irradiance.
Result<void> gatherDirectLight(const Tracer& tracer, const Lighting& lighting, float magnitude, BatchBuffers& b) {
    std::fill_n(b.irradiance.begin(), b.lit.size(), glm::vec3(0));
    for (const PlacedLight& light : lighting.lights) {
        std::size_t count = 0;
        for (std::uint32_t i = 0; i < b.lit.size(); ++i) {
            const Surface& s = b.surfaces[b.lit[i]];
            const kernels::LightSample sample = sampleLight(light, s.position);
            if (!kernels::reachesSurface(sample, s.geometricNormal, s.shadingNormal)) continue;
            const Ray shadow = shadowRay(s.position, s.geometricNormal, sample, magnitude);
            Ray& ray = b.shadowRays[count];
            ray.origin = shadow.origin;
            ray.direction = shadow.direction;
            ray.far = shadow.far;
            b.shadowed[count] = i;
            b.unshadowed[count++] = sample.irradianceAtNormal * glm::dot(sample.toLight, s.shadingNormal);
        }
        const std::span<std::uint8_t> blocked(b.blocked.data(), count);
        if (auto traced = tracer.occluded({b.shadowRays.data(), count}, blocked); !traced) return traced;
        for (std::size_t k = 0; k < count; ++k)
            if (!blocked[k]) b.irradiance[b.shadowed[k]] += b.unshadowed[k];
    }
    return {};
}

// Irradiance of earlier bounces at the hits: last frame's field (section 2.3).
Result<void> queryBounces(const BounceQuery& bounces, BatchBuffers& b) {
    const std::size_t count = b.lit.size();
    if (!bounces) {
        std::fill_n(b.bounced.begin(), count, glm::vec3(0));
        return {};
    }
    for (std::size_t k = 0; k < count; ++k) {
        const Surface& surface = b.surfaces[b.lit[k]];
        FieldQuery& query = b.queries[k];
        query.position = surface.position;
        query.normal = surface.shadingNormal;
        query.toViewer = -b.rays[b.lit[k]].direction;
    }
    return bounces({b.queries.data(), count}, {b.bounced.data(), count});
}

// Resolves distances and the radiance that is independent of other light; lists the hits that reflect.
void resolveHits(const Lighting& lighting, const EmitterSearch& emitters, const Batch& batch, std::size_t count,
                 BatchBuffers& b) {
    b.lit.clear();
    for (std::uint32_t i = 0; i < count; ++i) {
        const Hit& hit = b.hits[i];
        const Surface& surface = b.surfaces[i];
        RayLight& light = b.light[i];
        light = {};
        if (!hit.valid()) {
            light.emitted = skyRadiance(lighting.sky, b.rays[i].direction);
            light.distance = 1e30f;
        } else if (surface.backface) {
            light.distance = -hit.distance;
        } else {
            // Fixed rays get the full emission: emitter samples add nothing to them.
            const float share = batch.fixed ? 1.0f : emitters.rayShare(surface.material, hit.distance);
            light.emitted = surface.emission * share;
            light.distance = hit.distance;
            light.back = surface.back;
            b.lit.push_back(i);
        }
    }
}

RayDatum updateDatum(const RayLight& light) {
    const glm::vec3 radiance = light.emitted + (light.direct + light.bounced);
    if (light.back) return {kernels::radianceFromBack(radiance), -light.distance};
    return {radiance, light.distance};
}

FixedRayDatum fixedDatum(const RayLight& light) {
    return {kernels::luminance(light.emitted) + kernels::luminance(light.direct), kernels::luminance(light.bounced),
            light.back ? -light.distance : light.distance};
}

void writeData(const ProbeRayDirections& directions, const Batch& batch, const BatchBuffers& b,
               const ProbeRayData& out) {
    const RayLight* light = b.light.data();
    for (const OrderedDirection& d : batch.directions)
        for (const std::size_t task : b.tasks) {
            if (batch.fixed)
                out.fixed[task * directions.fixed.size() + d.index] = fixedDatum(*light);
            else
                out.update[task * directions.update.size() + d.index] = updateDatum(*light);
            ++light;
        }
}

// Shades a batch's hits.
Result<void> shadeBatch(const Tracer& tracer, const Lighting& lighting, float magnitude, const BounceQuery& bounces,
                        const EmitterSearch& emitters, const Batch& batch, std::size_t count, BatchBuffers& b) {
    const std::span<Surface> surfaces(b.surfaces.data(), count);
    if (auto seen = tracer.surfaces({b.rays.data(), count}, {b.hits.data(), count}, surfaces); !seen) return seen;
    resolveHits(lighting, emitters, batch, count, b);
    if (auto asked = queryBounces(bounces, b); !asked) return asked;
    if (auto lit = gatherDirectLight(tracer, lighting, magnitude, b); !lit) return lit;
    for (std::size_t k = 0; k < b.lit.size(); ++k) {
        const Surface& surface = b.surfaces[b.lit[k]];
        RayLight& light = b.light[b.lit[k]];
        light.direct = kernels::bounceRadiance(surface.albedo, b.irradiance[k]);
        light.bounced = kernels::bounceRadiance(surface.albedo, b.bounced[k]);
    }
    return {};
}

}  // namespace

Result<void> traceProbes(const Context& context, std::span<const kernels::Volume> volumes,
                         std::span<const ProbeTask> tasks, const ProbeRayDirections& directions, const Tracer& tracer,
                         const Lighting& lighting, const BounceQuery& bounces, const EmitterSearch& emitters,
                         const ProbeRayData& out, TraceTimes& times) {
    const float magnitude = sceneMagnitude(tracer.bounds());
    const TaskBlocks blocks(volumes, tasks);
    const std::vector<OrderedDirection> update = alongCurve(directions.update), fixed = alongCurve(directions.fixed);
    const auto traceBatch = [&](const Batch& batch, BatchBuffers& b) -> Result<void> {
        const auto start = TraceTimes::Clock::now();
        const std::size_t count = makeRays(batch, b);
        if (auto hit = tracer.closestHits({b.rays.data(), count}, {b.hits.data(), count}); !hit) return hit;
        const auto traced = TraceTimes::Clock::now();
        if (auto shaded = shadeBatch(tracer, lighting, magnitude, bounces, emitters, batch, count, b); !shaded)
            return shaded;
        writeData(directions, batch, b, out);
        times.add(start, traced);
        return {};
    };
    const std::vector<Batch> batches = makeBatches(update, fixed);
    const auto traceOne = [&](std::size_t number, std::size_t) -> Result<void> {
        thread_local BatchBuffers b;
        b.tasks = blocks.tasksOf(number / batches.size());
        b.origins.clear();
        for (const std::uint32_t task : b.tasks) b.origins.push_back(tasks[task].origin);
        return b.tasks.empty() ? Result<void>() : traceBatch(batches[number % batches.size()], b);
    };
    return tryParallelFor(context, blocks.count() * batches.size(), 1, traceOne);
}

}  // namespace probegi

#include "field/probe_emitters.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/parallel.h"
#include "field/layout.h"
#include "geometry/lighting.h"
#include "kernels/blend/probe_blend.h"

namespace probegi {

namespace {

// Approximate emitter samples per task: enough to fill the tracer's packets, few enough to spread small fields over
// threads.
constexpr std::size_t kLooksPerTask = 256;

// Buffers of a task, reused by a thread's tasks.
struct TaskBuffers {
    std::vector<Ray> rays;
    std::vector<Hit> hits;
    std::vector<Surface> surfaces;
    std::vector<kernels::EmitterAim> aims;
    std::vector<std::int32_t> materials;  // targets of the samples
};

const EmissiveTriangle* chosen(const EmitterSet& set, std::uint32_t choice) {
    const auto found =
        std::lower_bound(set.triangles.begin(), set.triangles.end(), choice,
                         [](const EmissiveTriangle& t, std::uint32_t number) { return t.upTo < number; });
    return &*found;
}

void aim(glm::vec3 probe, std::uint32_t seed, std::uint32_t look, const EmitterSearch& search, float magnitude,
         TaskBuffers& b) {
    const std::uint32_t choice = kernels::emitterChoice(seed, look, std::uint32_t(search.looks));
    const EmissiveTriangle* t = chosen(*search.set, choice);
    const std::uint32_t below = t == search.set->triangles.data() ? 0u : t[-1].upTo;
    const glm::vec2 where = kernels::emitterBarycentric(seed, look, choice, below, t->upTo);
    const kernels::EmitterAim at = kernels::aimAtEmitter(probe, t->corner, t->edge1, t->edge2, where);
    const float offset = kernels::rayOffset(probe + at.direction * at.distance, magnitude);
    b.aims.push_back(at);
    b.materials.push_back(t->material);
    b.rays.push_back({probe, 0.0f, at.direction, at.distance + kernels::emitterTolerance(at, offset)});
}

// The sample's light; 0 if it is occluded.
kernels::EmitterLight lightOf(const EmitterSearch& search, std::size_t i, const TaskBuffers& b) {
    const kernels::EmitterAim& at = b.aims[i];
    const Surface& surface = b.surfaces[i];
    kernels::EmitterLight light{at.direction, glm::vec3(0.0f)};
    if (!b.hits[i].valid() || surface.backface || surface.material != b.materials[i] || !(at.cosine > 0)) return light;
    const float tolerance = b.rays[i].far - at.distance;
    if (!(std::abs(b.hits[i].distance - at.distance) <= tolerance)) return light;
    const float perArea = search.set->density(surface.material);
    const float factor = kernels::emitterLightFactor(search.rays, search.looks, perArea, at);
    for (int c = 0; c < 3; ++c) light.light[c] = factor * kernels::safeRadiance(surface.emission[c]);
    return light;
}

}  // namespace

EmitterSearch emitterSearch(const FieldDesc& desc, const Tracer& tracer, std::uint32_t frameSeed) {
    const EmitterSet* set = tracer.emitters();
    const int looks = emitterLooks(desc);
    if (looks == 0 || !set || set->empty()) return {};
    return {set, desc.raysPerProbe, looks, frameSeed};
}

Result<void> lookAtEmitters(const Context& context, std::span<const kernels::Volume> volumes,
                            std::span<const ProbeTask> tasks, const EmitterSearch& search, const Tracer& tracer,
                            std::span<kernels::EmitterLight> out, TraceTimes& times) {
    const float magnitude = sceneMagnitude(tracer.bounds());
    const std::size_t looks = std::size_t(search.looks);
    const auto look = [&](std::size_t begin, std::size_t end) -> Result<void> {
        thread_local TaskBuffers b;
        const auto start = TraceTimes::Clock::now();
        b.rays.clear();
        b.aims.clear();
        b.materials.clear();
        for (const ProbeTask& task : tasks.subspan(begin, end - begin)) {
            const std::uint32_t number = std::uint32_t(kernels::probeNumber(volumes[task.volume], int(task.slot)));
            const std::uint32_t seed = kernels::emitterSeed(search.seed, number);
            for (std::uint32_t i = 0; i < std::uint32_t(looks); ++i) aim(task.origin, seed, i, search, magnitude, b);
        }
        b.hits.resize(b.rays.size());
        b.surfaces.resize(b.rays.size());
        if (auto hit = tracer.closestHits(b.rays, b.hits); !hit) return hit;
        const auto traced = TraceTimes::Clock::now();
        if (auto seen = tracer.surfaces(b.rays, b.hits, b.surfaces); !seen) return seen;
        for (std::size_t i = 0; i < b.rays.size(); ++i) out[begin * looks + i] = lightOf(search, i, b);
        times.add(start, traced);
        return {};
    };
    return tryParallelFor(context, tasks.size(), kLooksPerTask / looks, look);
}

}  // namespace probegi

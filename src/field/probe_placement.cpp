#include "field/probe_placement.h"

#include <algorithm>
#include <atomic>

#include "core/parallel.h"
#include "field/layout.h"
#include "kernels/blend/probe_blend.h"
#include "kernels/lookup/used_probes.h"
#include "kernels/probe/placing.h"
#include "kernels/trace/ray_set.h"

namespace probegi {

namespace {

// Probes whose rays are traced together.
constexpr std::size_t kBatch = 64;

// What a ray of a probe met.
struct SeenRay {
    float distance = 1e30f;  // as RayDatum's, made safe
    bool solid = false;      // the back of a single-sided surface
    glm::vec3 position{0.0f}, normal{0.0f};
};

class Placing {
public:
    Placing(const UpdateFrame& frame, std::span<const std::uint32_t> placements, std::span<const Bounds> moving)
        : m_frame(frame),
          m_rules(frame.desc.rules == FieldRules::paper ? kernels::kRulesPaper : kernels::kRulesMeasured),
          m_moving(moving) {
        found.placements.assign(placements.begin(), placements.end());
        found.surfaces.resize(placements.size());
    }

    bool isNew(const ProbeTask& task) const {
        return kernels::stateOf(found.placements[task.slot]) == kernels::kUninitialized;
    }
    void begin(const ProbeTask& task) {
        found.placements[task.slot] = kernels::beginPlacing(found.placements[task.slot]);
    }
    glm::vec3 positionOf(const ProbeTask& task) const {
        const kernels::Volume& v = m_frame.volumes[task.volume];
        return kernels::placedPosition(v, kernels::probeCell(v, int(task.slot)), found.placements[task.slot]);
    }

    /// One look of a probe by its rays. Probes of different slots may look at once.
    void look(const ProbeTask& task, std::span<const glm::vec3> directions, std::span<const SeenRay> rays) {
        const kernels::Volume& v = m_frame.volumes[task.volume];
        std::uint32_t& placement = found.placements[task.slot];
        kernels::PlaceSight sight = kernels::nothingSeen();
        int counted = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const bool hit = rays[i].distance < kernels::kMissDistance;
            // Within the bounds of what moves may be static surfaces too, which stay when it goes.
            if (hit && !kernels::hitBack(rays[i].distance)) mark(rays[i].position, rays[i].normal);
            if (hit && moves(rays[i].position)) continue;
            ++counted;
            kernels::addToPlaceSight(sight, kernels::toVolumeDirection(v, directions[i]), rays[i].distance,
                                     rays[i].solid);
        }
        placement = kernels::lookedAround(v, placement, sight, counted, m_frame.desc.relocation, m_rules);
    }

    FoundPlaces found;

private:
    bool moves(glm::vec3 point) const {
        return std::any_of(m_moving.begin(), m_moving.end(), [&](const Bounds& box) {
            return kernels::holdsPoint({box.lower, box.upper}, point);
        });
    }

    // The probes, of all volumes, that a surface uses.
    void mark(glm::vec3 position, glm::vec3 normal) {
        if (!m_frame.desc.probeStates) return;
        for (const kernels::Volume& v : m_frame.volumes) {
            const kernels::UsedProbes used =
                kernels::usedProbes(v, position, normal, m_frame.settings.selfShadowBias, m_rules);
            for (int z = used.lowest.z; z <= used.highest.z; ++z)
                for (int y = used.lowest.y; y <= used.highest.y; ++y)
                    for (int x = used.lowest.x; x <= used.highest.x; ++x) {
                        const int slot = kernels::probeSlot(v, {x, y, z});
                        std::atomic_ref(found.surfaces[std::size_t(slot)]).store(1, std::memory_order_relaxed);
                    }
        }
    }

    const UpdateFrame& m_frame;
    int m_rules;
    std::span<const Bounds> m_moving;
};

// Rays of one look of some probes, [probe][ray], and what they meet.
struct LookBuffers {
    std::vector<Ray> rays;
    std::vector<Hit> hits;
    std::vector<Surface> surfaces;
    std::vector<SeenRay> seen;
};

Result<void> trace(const Tracer& tracer, LookBuffers& b) {
    b.hits.resize(b.rays.size());
    b.surfaces.resize(b.rays.size());
    b.seen.resize(b.rays.size());
    if (auto hit = tracer.closestHits(b.rays, b.hits); !hit) return hit;
    if (auto resolved = tracer.surfaces(b.rays, b.hits, b.surfaces); !resolved) return resolved;
    for (std::size_t i = 0; i < b.rays.size(); ++i) {
        const Surface& surface = b.surfaces[i];
        b.seen[i] = {};
        if (!b.hits[i].valid()) continue;
        const float distance = b.hits[i].distance;
        b.seen[i] = {surface.back ? -distance : distance, surface.backface, surface.position, surface.geometricNormal};
    }
    return {};
}

}  // namespace

Result<FoundPlaces> placeProbes(const Context& context, const UpdateFrame& frame,
                                std::span<const std::uint32_t> placements, std::span<const Bounds> moving,
                                const Tracer& tracer) {
    Placing placing(frame, placements, moving);
    std::vector<ProbeTask> tasks;
    for (std::uint32_t slot = 0; slot < placements.size(); ++slot) {
        const ProbeTask task{{}, slot, std::uint32_t(volumeOf(frame.volumes, int(slot)))};
        if (!placing.isNew(task)) continue;
        placing.begin(task);
        tasks.push_back(task);
    }
    std::vector<glm::vec3> directions;
    for (std::uint32_t i = 0; i < kernels::kRelocationRays; ++i)
        directions.push_back(kernels::sphericalFibonacci(i, kernels::kRelocationRays));
    auto placed =
        tryParallelFor(context, tasks.size(), kBatch, [&](std::size_t begin, std::size_t end) -> Result<void> {
            LookBuffers b;
            for (std::uint32_t look = 0; look < kernels::looksOfPlacement(frame.desc.relocation); ++look) {
                b.rays.clear();
                for (std::size_t task = begin; task < end; ++task) {
                    const glm::vec3 origin = placing.positionOf(tasks[task]);
                    for (const glm::vec3& direction : directions) b.rays.push_back({origin, 0.0f, direction});
                }
                if (auto traced = trace(tracer, b); !traced) return traced;
                for (std::size_t task = begin; task < end; ++task)
                    placing.look(tasks[task], directions,
                                 std::span(b.seen).subspan((task - begin) * directions.size(), directions.size()));
            }
            return {};
        });
    if (!placed) return placed.error();
    return std::move(placing.found);
}

FoundPlaces lookAround(const Context& context, const UpdateFrame& frame, std::span<const std::uint32_t> placements,
                       std::span<const Bounds> moving, std::span<const RayDatum> rayData) {
    Placing placing(frame, placements, moving);
    const std::size_t rays = frame.directions.size();
    parallelFor(context, frame.tasks.size(), kBatch, [&](std::size_t begin, std::size_t end) {
        std::vector<SeenRay> seen(rays);
        for (std::size_t i = begin; i < end; ++i) {
            const ProbeTask& task = frame.tasks[i];
            if (!placing.isNew(task)) continue;
            for (std::size_t ray = 0; ray < rays; ++ray) {
                const RayDatum& d = rayData[i * rays + ray];
                const float distance = kernels::safeDistance(d.distance);
                // Of its surface no more is known than that it faces the ray.
                seen[ray] = {distance, kernels::hitBackface(distance, d.radiance.x),
                             task.origin + std::abs(distance) * frame.directions[ray], -frame.directions[ray]};
            }
            placing.look(task, frame.directions, seen);
        }
    });
    return std::move(placing.found);
}

}  // namespace probegi

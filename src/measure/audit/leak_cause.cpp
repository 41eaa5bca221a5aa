#include "measure/audit/leak_cause.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "kernels/trace/ray_offset.h"
#include "kernels/trace/ray_set.h"
#include "measure/audit/ray_bundle.h"

namespace probegi {

namespace {

constexpr double kBeyondCells = 0.5;  ///< outside the volume, up to which its answers are as good as inside
constexpr double kLeastCosine = 0.1;  ///< by which distances along a ray are taken across a wall
constexpr double kThickestCells = 2;  ///< missing thickness that is looked for
constexpr double kEdgeCells = 0.5;    ///< missing thickness from which it is not the wall that is too thin
constexpr int kWaysInside = 6;        ///< directions that must agree on a point's lying in matter
constexpr int kMostLayers = 64;       ///< that a ray is followed through
constexpr int kWaysOut = 64;          ///< directions in which a probe in matter looks for the open
constexpr float kInMatter = 0.25f;    ///< of a probe's rays hit backs: it stands in matter

struct FirstHit {
    bool valid = false;
    float distance = 0;
    Surface surface;
};

Result<FirstHit> firstHit(const Tracer& tracer, const Ray& ray) {
    Hit hit;
    Surface surface;
    if (auto traced = tracer.closestHits(std::span(&ray, 1), std::span(&hit, 1)); !traced) return traced.error();
    if (!hit.valid()) return FirstHit{};
    if (auto found = tracer.surfaces(std::span(&ray, 1), std::span(&hit, 1), std::span(&surface, 1)); !found)
        return found.error();
    return FirstHit{true, hit.distance, surface};
}

/// The guard's word on each probe of the cage if the point were `extra` metres farther away, over what it says now.
std::array<float, 8> seenFrom(const FieldRecord& record, const RecordAccess& access, const LookUp& look,
                              const Hidden& hidden, float extra) {
    std::array<float, 8> factors;
    factors.fill(1);
    const kernels::Volume& v = record.volumes[std::size_t(look.volume)];
    const kernels::GuardPoint point = kernels::guardPoint(access, v, look.cage, kernels::cageSlots(v, look.cage.base));
    for (std::size_t corner = 0; corner < 8; ++corner) {
        if (!hidden.corner[corner]) continue;
        const int slot = look.weights.slot[corner];
        // The guards' argument, as cage_weights.h has it.
        glm::vec3 toProbe = kernels::probePlace(v, kernels::probeCell(v, slot)) - look.cage.position;
        if (v.relocated != 0) toProbe += kernels::probeOffset(v, storedPlacement(access, slot));
        const glm::vec3 fromProbe = look.cage.bias - toProbe;
        const float distance = glm::length(fromProbe);
        if (!(distance > 0)) continue;
        const float now = kernels::guardSeen(access, v, slot, int(corner), fromProbe, point);
        if (!(now > 0)) continue;  // no distance makes masks see more
        factors[corner] =
            kernels::guardSeen(access, v, slot, int(corner), fromProbe * (1 + extra / distance), point) / now;
    }
    return factors;
}

/// Whether masks, and not distances, say what the point sees.
bool goesByMasks(const FieldRecord& record, const FieldQuery& point) {
    if (record.settings.guard != LeakGuard::masks) return false;
    const LookUp look = lookUp(record, point);
    const LeftOut none;
    const RecordAccess access(record, none);
    const kernels::Volume& v = record.volumes[std::size_t(look.volume)];
    return kernels::guardPoint(access, v, look.cage, kernels::cageSlots(v, look.cage.base)).scale > 0;
}

bool inMatter(const FieldRecord& record, int slot) {
    return record.snapshot.state(slot).backs > kInMatter;
}

}  // namespace

Result<Obstacle> obstacleBetween(const Tracer& tracer, const FieldQuery& point, glm::vec3 probe) {
    const float magnitude = magnitudeOf(tracer);
    Ray ray = segment(point.position, point.normal, probe, magnitude);
    const auto entry = firstHit(tracer, ray);
    if (!entry) return entry.error();
    if (!entry->valid) return Obstacle{};
    const double cosine = double(std::abs(glm::dot(ray.direction, entry->surface.geometricNormal)));
    if (entry->surface.back) return Obstacle{true, 0, cosine};
    // On from inside the thing, past the rounding of the first hit.
    const float far = ray.far;
    ray.near = entry->distance + kernels::rayOffset(entry->surface.position, magnitude);
    ray.far = std::numeric_limits<float>::max();
    const auto exit = firstHit(tracer, ray);
    if (!exit) return exit.error();
    if (!exit->valid || !exit->surface.back) return Obstacle{true, 0, cosine};
    const double thickness = double(exit->distance - entry->distance) * cosine;
    return Obstacle{true, thickness, cosine, exit->distance > far};
}

std::optional<double> missingThickness(const FieldRecord& record, const FieldQuery& point, const Hidden& hidden,
                                       double cosine, double least, double most) {
    const LeftOut none;
    const RecordAccess access(record, none);
    const LookUp now = lookUp(record, point);
    std::vector<int> slots;
    for (std::size_t corner = 0; corner < 8; ++corner)
        if (hidden.corner[corner]) slots.push_back(now.weights.slot[corner]);
    const auto shareAt = [&](double thickness) {
        LeftOut out;
        out.seen = seenFrom(record, access, now, hidden, float(thickness / std::max(cosine, kLeastCosine)));
        const LookUp then = lookUp(record, point, out);
        // Where the cage has too little weight then, its neighbours answer, and these probes no longer count.
        return then.enough ? shareOf(record, point, then, slots) : 0.0;
    };
    if (shareAt(0) <= least) return 0.0;
    if (shareAt(most) > least) return std::nullopt;
    double lower = 0, upper = most;
    for (int i = 0; i < 20; ++i) {
        const double middle = 0.5 * (lower + upper);
        (shareAt(middle) > least ? lower : upper) = middle;
    }
    return upper;
}

Result<double> spacingThatSees(const FieldRecord& record, const Tracer& tracer, const FieldQuery& point) {
    const LookUp look = lookUp(record, point);
    const kernels::Volume& v = record.volumes[std::size_t(look.volume)];
    const float magnitude = magnitudeOf(tracer);
    float shrink = 1;
    // From a little in front of the surface: along the others' axes the surface itself is not in the way.
    const Ray off = segment(point.position, point.normal, point.position + point.normal * v.minSpacing, magnitude);
    const auto ahead = firstHit(tracer, off);
    if (!ahead) return ahead.error();
    const float step = 0.5f * std::min(ahead->valid ? ahead->distance : v.minSpacing, kLean * v.minSpacing);
    for (int axis = 0; axis < 3; ++axis) {
        float free = 0;
        for (const bool up : {false, true}) {
            Ray ray;
            ray.origin = off.origin + point.normal * step;
            ray.direction = kernels::axisDirection(v, axis, up);
            ray.far = v.spacing[axis];
            const auto hit = firstHit(tracer, ray);
            if (!hit) return hit.error();
            free += hit->valid ? hit->distance : ray.far;
        }
        shrink = std::min(shrink, free / v.spacing[axis]);
    }
    return double(shrink * v.minSpacing);
}

Result<bool> isInsideMatter(const Tracer& tracer, const FieldQuery& point) {
    const float magnitude = magnitudeOf(tracer);
    for (int way = 0; way < kWaysInside; ++way) {
        Ray ray;
        ray.origin = segment(point.position, point.normal, point.position, magnitude).origin;
        ray.direction = kernels::sphericalFibonacci(kernels::uint(way), kWaysInside);
        if (glm::dot(ray.direction, point.normal) < 0) ray.direction = -ray.direction;
        int left = 0;
        for (int hits = 0; hits < kMostLayers; ++hits) {
            const auto hit = firstHit(tracer, ray);
            if (!hit) return hit.error();
            if (!hit->valid) break;
            left += hit->surface.back ? 1 : -1;
            ray.near = hit->distance + kernels::rayOffset(hit->surface.position, magnitude);
        }
        if (left <= 0) return false;
    }
    return true;
}

Result<double> distanceToOpen(const Tracer& tracer, glm::vec3 probe) {
    std::vector<Ray> rays(kWaysOut);
    for (int i = 0; i < kWaysOut; ++i) {
        rays[std::size_t(i)].origin = probe;
        rays[std::size_t(i)].direction = kernels::sphericalFibonacci(kernels::uint(i), kWaysOut);
    }
    std::vector<Hit> hits(rays.size());
    std::vector<Surface> surfaces(rays.size());
    if (auto traced = tracer.closestHits(rays, hits); !traced) return traced.error();
    if (auto found = tracer.surfaces(rays, hits, surfaces); !found) return found.error();
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < hits.size(); ++i)
        if (hits[i].valid() && surfaces[i].back) nearest = std::min(nearest, double(hits[i].distance));
    return std::isfinite(nearest) ? nearest : 0.0;
}

namespace {

/// Why a guard lets through the light of a probe in the open that the point does not see.
Result<void> explainGuard(const FieldRecord& record, const Tracer& tracer, const LeakPoint& point,
                          const Obstacle& obstacle, double least, PointCause& why) {
    const LookUp look = lookUp(record, point.query);
    const auto hidden = hiddenAt(record, tracer, std::span(&point.query, 1), std::span(&look, 1));
    if (!hidden) return hidden.error();
    const double spacing = double(record.volumes[std::size_t(point.volume)].minSpacing);
    const auto missing =
        missingThickness(record, point.query, hidden->front(), obstacle.cosine, least, kThickestCells * spacing);
    const double wall = obstacle.thickness;
    const bool edge = !missing || *missing > kEdgeCells * spacing;
    why.cause = wall <= 0 ? LeakCause::sheet : edge ? LeakCause::blurredEdge : LeakCause::thinWall;
    if (!missing || !(*missing > 0)) return {};
    if (!edge) why.thicken = wall + *missing;
    // A grid of finer spacing is the same picture made smaller, with the wall as it is.
    if (wall > 0) why.refine = spacing * wall / (wall + *missing);
    return {};
}

}  // namespace

Result<PointCause> explain(const FieldRecord& record, const Tracer& tracer, const LeakPoint& point, double least) {
    PointCause why;
    const double spacing = double(record.volumes[std::size_t(point.volume)].minSpacing);
    Obstacle obstacle;
    if (point.slot >= 0) {
        const auto found = obstacleBetween(tracer, point.query, point.probe);
        if (!found) return found.error();
        obstacle = *found;
        if (obstacle.any) why.wall = obstacle.thickness;
    }
    if (record.settings.guard == LeakGuard::none) {
        why.cause = LeakCause::guardOff;
    } else if (point.beyond > kBeyondCells * spacing) {
        why.cause = LeakCause::beyondVolume;
        why.extend = point.beyond;
    } else if (!point.probesSee || point.slot < 0) {
        why.cause = LeakCause::noProbeSees;
        const auto seen = spacingThatSees(record, tracer, point.query);
        if (!seen) return seen.error();
        if (*seen < spacing) why.refine = *seen;
    } else if (point.gradient) {
        why.cause = LeakCause::gradient;
    } else if (obstacle.aroundProbe || inMatter(record, point.slot)) {
        why.cause = LeakCause::probeInMatter;
        const auto way = distanceToOpen(tracer, point.probe);
        if (!way) return way.error();
        why.move = *way;
    } else if (goesByMasks(record, point.query)) {
        why.cause = LeakCause::sharedCluster;
    } else if (auto done = explainGuard(record, tracer, point, obstacle, least, why); !done) {
        return done.error();
    }
    return why;
}

}  // namespace probegi

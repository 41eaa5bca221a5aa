#include "field/walls.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "field/layout.h"
#include "kernels/random.h"
#include "kernels/sampling.h"

namespace probegi {

namespace {

constexpr std::uint32_t kOrigins = 2048;
constexpr std::uint32_t kRaysPerOrigin = 8;
constexpr int kMostBacks = kRaysPerOrigin / 4;  ///< for an origin in the open
constexpr float kAcross = 0.99f;                ///< normal component from which a surface is across an axis

// In cells. Measured error at surfaces over the distance of the first layer of probes (docs/accuracy.md): lowest at a
// fifth of a cell, growing linearly from there.
constexpr float kBestDistance = 0.2f;
constexpr float kOwnError = 0.4f;  ///< error at the best distance, where one cell more adds 1
// This close to a wall, unevenness decides whether a probe is in front of it.
constexpr float kTooNear = 0.05f;

// Range of the search.
constexpr float kLeastStretch = 0.95f, kMostStretch = 1.08f;
constexpr int kStretches = 14, kPhases = 32;
// The probes stay if less than this share of the squared error can be gained, which is insignificant.
constexpr float kLeastGain = 0.1f;
// Minimum share of points across the axis among those found.
constexpr float kLeastShare = 0.05f;

float unit(std::uint32_t& state) {
    return kernels::nextRandom(state);
}

// The rays of origins `first`, `first + 1`, ...
void makeRays(const Bounds& bounds, std::uint32_t first, std::span<Ray> rays) {
    for (std::size_t i = 0; i < rays.size(); i += kRaysPerOrigin) {
        std::uint32_t state = kernels::hashUint(first + std::uint32_t(i) / kRaysPerOrigin);
        const float x = unit(state), y = unit(state), z = unit(state);
        for (std::size_t r = i; r < i + kRaysPerOrigin; ++r) {
            const float u = unit(state), v = unit(state);
            rays[r].origin = bounds.lower + glm::vec3(x, y, z) * bounds.size();
            rays[r].direction = kernels::sampleSphere({u, v});
        }
    }
}

void addSamples(std::span<const Hit> hits, std::span<const Surface> surfaces, std::vector<WallSample>& samples) {
    int backs = 0;
    for (std::size_t i = 0; i < hits.size(); ++i) backs += hits[i].valid() && surfaces[i].back ? 1 : 0;
    if (backs > kMostBacks) return;
    for (std::size_t i = 0; i < hits.size(); ++i)
        if (hits[i].valid() && !surfaces[i].back)
            samples.push_back({surfaces[i].position, surfaces[i].geometricNormal});
}

// Mean squared error of the light at the walls, in units of square metres.
double squaredError(const std::vector<WallPoint>& walls, AxisPlacement p) {
    double sum = 0;
    for (const WallPoint& wall : walls) {
        const float x = (wall.place - p.first) / p.spacing;
        const float distance = wall.up ? std::ceil(x) - x : x - std::floor(x);
        const float error = kOwnError + (distance < kTooNear ? 0.5f : std::abs(distance - kBestDistance));
        sum += double(error) * error;
    }
    return sum / double(walls.size()) * p.spacing * p.spacing;
}

}  // namespace

Result<std::vector<WallSample>> findWalls(const Tracer& tracer) {
    constexpr std::uint32_t kBatch = 256;  // origins
    std::vector<Ray> rays(kBatch * kRaysPerOrigin);
    std::vector<Hit> hits(rays.size());
    std::vector<Surface> surfaces(rays.size());
    const Bounds bounds = tracer.bounds();
    std::vector<WallSample> samples;
    for (std::uint32_t first = 0; first < kOrigins; first += kBatch) {
        makeRays(bounds, first, rays);
        if (const auto traced = tracer.closestHits(rays, hits); !traced) return traced.error();
        if (const auto resolved = tracer.surfaces(rays, hits, surfaces); !resolved) return resolved.error();
        for (std::size_t i = 0; i < rays.size(); i += kRaysPerOrigin)
            addSamples(std::span(hits).subspan(i, kRaysPerOrigin), std::span(surfaces).subspan(i, kRaysPerOrigin),
                       samples);
    }
    return samples;
}

std::vector<WallPoint> wallsAcross(std::span<const WallSample> samples, glm::vec3 axis) {
    std::vector<WallPoint> walls;
    for (const WallSample& s : samples)
        if (const float facing = glm::dot(s.normal, axis); std::abs(facing) > kAcross)
            walls.push_back({glm::dot(s.position, axis), facing > 0});
    return walls;
}

AxisPlacement fitToWalls(const std::vector<WallPoint>& walls, std::size_t seen, AxisPlacement placed, int count,
                         float lower, float upper, float marginCells) {
    if (walls.empty() || float(walls.size()) < kLeastShare * float(seen)) return placed;
    const float cells = float(count - 1), cellsWithin = cells - 2 * std::max(marginCells, kTooNear);
    const double before = squaredError(walls, placed);
    AxisPlacement best = placed;
    double least = before;
    for (int i = 0; i < kStretches; ++i) {
        const float share = float(i) / float(kStretches - 1);
        const float spacing = placed.spacing * (kLeastStretch + (kMostStretch - kLeastStretch) * share);
        if (spacing < kSmallestSpacing) continue;
        // Possible shift within the margin; half a cell to both sides covers every phase.
        const float room = cellsWithin * spacing - (upper - lower);
        if (room < 0) continue;
        const float reach = 0.5f * std::min(room, spacing);
        const float middle = 0.5f * (lower + upper - cells * spacing);
        for (int k = 0; k <= kPhases; ++k) {
            const AxisPlacement p{middle + reach * (2.0f * float(k) / float(kPhases) - 1.0f), spacing};
            if (const double error = squaredError(walls, p); error < least) least = error, best = p;
        }
    }
    return least < (1 - kLeastGain) * before ? best : placed;
}

}  // namespace probegi

#include "reference/guide_lessons.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/parallel.h"
#include "geometry/lighting.h"
#include "kernels/sampling.h"
#include "kernels/screen/colour.h"

namespace probegi {

namespace {

/// Number of reflections after the first surface that also yield receivers.
constexpr int kGenerations = 2;
constexpr std::size_t kReceiversPerRegion = 16;
/// Regions visited less often are skipped: the gain would not be worth the rays.
constexpr std::size_t kMinVisits = 2;
/// Approximate total number of receivers; the regions with most visits come first.
constexpr std::size_t kMaxReceivers = 8192;
/// Receivers whose rays are in memory at once, and receivers per task.
constexpr std::size_t kBlock = 256, kGrain = 8;
constexpr int kSide = GuideLessons::kRaysPerSide, kRays = GuideLessons::kRaysPerReceiver;

Ray rayFrom(const GuideReceiver& receiver, glm::vec2 u, float magnitude) {
    const glm::mat3 frame = kernels::orthonormalBasis(receiver.normal);
    const glm::vec3 direction = glm::normalize(kernels::toWorld(frame, kernels::sampleCosineHemisphere(u)));
    return {kernels::offsetOrigin(receiver.position, receiver.geometricNormal, magnitude), 0.0f, direction};
}

GuideReceiver receiverAt(const Surface& surface) {
    return {surface.position, surface.geometricNormal, surface.shadingNormal, 0};
}

Result<std::vector<GuideReceiver>> nextGeneration(const Transport& transport, std::span<const GuideReceiver> last,
                                                  std::uint64_t seed) {
    std::vector<Ray> rays;
    rays.reserve(last.size());
    for (std::size_t i = 0; i < last.size(); ++i)
        rays.push_back(rayFrom(last[i], Random(seed, i).nextPair(), transport.magnitude));
    return receiversSeen(transport, rays);
}

/// At most kReceiversPerRegion for each region with enough visits, ordered by region.
std::vector<GuideReceiver> choose(std::vector<GuideReceiver> all) {
    std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.region < b.region; });
    struct Range {
        std::size_t begin, end;
    };
    std::vector<Range> ranges;
    for (std::size_t begin = 0, end; begin < all.size(); begin = end) {
        for (end = begin; end < all.size() && all[end].region == all[begin].region; ++end) {
        }
        if (end - begin >= kMinVisits) ranges.push_back({begin, end});
    }
    std::stable_sort(ranges.begin(), ranges.end(),
                     [](const Range& a, const Range& b) { return a.end - a.begin > b.end - b.begin; });
    std::size_t total = 0, kept = 0;
    for (; kept < ranges.size() && total < kMaxReceivers; ++kept)
        total += std::min(ranges[kept].end - ranges[kept].begin, kReceiversPerRegion);
    ranges.resize(kept);
    std::sort(ranges.begin(), ranges.end(), [](const Range& a, const Range& b) { return a.begin < b.begin; });
    std::vector<GuideReceiver> chosen;
    chosen.reserve(total);
    for (const Range& range : ranges) {
        const std::size_t count = range.end - range.begin, wanted = std::min(count, kReceiversPerRegion);
        // Evenly spaced over the visits, which are ordered by generation.
        for (std::size_t i = 0; i < wanted; ++i) chosen.push_back(all[range.begin + i * count / wanted]);
    }
    return chosen;
}

/// Results of the rays of one block of receivers.
struct Views {
    std::vector<Ray> rays;
    std::vector<Hit> hits;
    std::vector<Surface> surfaces;
    std::vector<float> punctual;  ///< reflected radiance of lamps and sun
    std::vector<FieldQuery> queries;
    std::vector<glm::vec3> irradiance;

    explicit Views(std::size_t count)
        : rays(count), hits(count), surfaces(count), punctual(count), queries(count), irradiance(count) {}
};

/// Luminance of E reflected by a Lambert surface of this albedo.
float reflected(const Surface& surface, glm::vec3 irradiance) {
    const float radiance = kernels::luminance(surface.albedo * irradiance) / kernels::kPi;
    return std::isfinite(radiance) ? std::max(radiance, 0.0f) : 0.0f;
}

Result<void> addPunctual(const Transport& transport, std::size_t begin, std::size_t end, Views& views) {
    std::vector<Ray> shadows;
    std::vector<std::pair<std::size_t, float>> arriving;
    for (std::size_t i = begin; i < end; ++i) {
        views.punctual[i] = 0;
        const Surface& surface = views.surfaces[i];
        if (!views.hits[i].valid() || surface.backface) continue;
        for (const PlacedLight& light : transport.lights) {
            const kernels::LightSample s = sampleLight(light, surface.position);
            if (!kernels::reachesSurface(s, surface.geometricNormal, surface.shadingNormal)) continue;
            const float radiance =
                reflected(surface, s.irradianceAtNormal * glm::dot(surface.shadingNormal, s.toLight));
            if (!(radiance > 0)) continue;
            shadows.push_back(shadowRay(surface.position, surface.geometricNormal, s, transport.magnitude));
            arriving.emplace_back(i, radiance);
        }
    }
    std::vector<std::uint8_t> blocked(shadows.size());
    if (auto traced = transport.tracer->occluded(shadows, blocked); !traced) return traced;
    for (std::size_t i = 0; i < shadows.size(); ++i)
        if (!blocked[i]) views.punctual[arriving[i].first] += arriving[i].second;
    return {};
}

/// Traces the rays of `receivers`, numbered from `first`, and shades their hits, except for the field's share.
Result<void> look(const Context& context, const Transport& transport, std::span<const GuideReceiver> receivers,
                  std::size_t first, std::uint64_t seed, Views& views) {
    return tryParallelFor(context, receivers.size(), kGrain, [&](std::size_t from, std::size_t to) -> Result<void> {
        const std::size_t begin = from * kRays, end = to * kRays;
        for (std::size_t r = from; r < to; ++r) {
            Random random(seed, first + r);
            for (int i = 0; i < kRays; ++i) {
                const glm::vec2 u = (glm::vec2(i % kSide, i / kSide) + random.nextPair()) / float(kSide);
                views.rays[r * kRays + std::size_t(i)] = rayFrom(receivers[r], u, transport.magnitude);
            }
        }
        const auto part = [&](auto& all) { return std::span(all).subspan(begin, end - begin); };
        std::fill(part(views.hits).begin(), part(views.hits).end(), Hit{});
        const Tracer& tracer = *transport.tracer;
        if (auto hit = tracer.closestHits(part(views.rays), part(views.hits)); !hit) return hit;
        auto found = tracer.surfaces(part(views.rays), part(views.hits), part(views.surfaces));
        if (!found) return found;
        if (auto lit = addPunctual(transport, begin, end, views); !lit) return lit;
        for (std::size_t i = begin; i < end; ++i)
            views.queries[i] =
                views.hits[i].valid()
                    ? FieldQuery{views.surfaces[i].position, views.surfaces[i].shadingNormal, -views.rays[i].direction}
                    : FieldQuery{views.rays[i].origin, -views.rays[i].direction, -views.rays[i].direction};
        return {};
    });
}

/// Rays that see the sky get the distance of the window that they pass through: the smallest among their neighbours'
/// hits, or `farthest` if no ray hit anything.
void fillDistances(float* distances, float farthest) {
    bool missing = true;
    for (int round = 0; round < kSide && missing; ++round) {
        missing = false;
        float before[kRays];
        std::copy(distances, distances + kRays, before);
        for (int i = 0; i < kRays; ++i) {
            if (before[i] > 0) continue;
            float nearest = 0;
            for (int y = std::max(i / kSide - 1, 0); y <= std::min(i / kSide + 1, kSide - 1); ++y)
                for (int x = std::max(i % kSide - 1, 0); x <= std::min(i % kSide + 1, kSide - 1); ++x) {
                    const float d = before[y * kSide + x];
                    if (d > 0 && (nearest == 0 || d < nearest)) nearest = d;
                }
            distances[i] = nearest;
            missing = missing || nearest == 0;
        }
    }
    for (int i = 0; i < kRays; ++i)
        if (distances[i] == 0) distances[i] = farthest;
}

/// Splits what receiver `index` saw into lights and background.
void learn(const Transport& transport, const Views& views, std::size_t offset, std::uint32_t index, float farthest,
           GuideLessons& out, std::vector<GuideLight>& lights) {
    float distances[kRays];
    for (int i = 0; i < kRays; ++i) {
        const Hit& hit = views.hits[offset + std::size_t(i)];
        distances[i] = hit.valid() ? std::max(hit.distance, 1e-6f) : 0.0f;
    }
    fillDistances(distances, farthest);
    float sum = 0, squares = 0;
    for (int i = 0; i < kRays; ++i) {
        const std::size_t at = offset + std::size_t(i);
        const Ray& ray = views.rays[at];
        if (!(glm::dot(out.receivers[index].geometricNormal, ray.direction) > 0)) continue;
        const glm::vec3 position = ray.origin + ray.direction * distances[i];
        if (!views.hits[at].valid()) {
            const float radiance = kernels::luminance(transport.sky.radiance(ray.direction));
            if (radiance > 0) lights.push_back({position, distances[i], radiance, index, true});
            continue;
        }
        if (views.surfaces[at].backface) continue;
        const float indirect = reflected(views.surfaces[at], views.irradiance[at]);
        const float radiance = indirect + views.punctual[at];
        if (views.punctual[at] > indirect) {
            lights.push_back({position, distances[i], radiance, index, false});
        } else {
            sum += radiance;
            squares += radiance * radiance;
        }
    }
    out.background[index] = sum;
    out.backgroundSquares[index] = squares;
}

/// The field's level for the regions of all these receivers.
Result<std::vector<float>> levelsOf(const Field& field, std::size_t regions, std::span<const GuideReceiver> all) {
    std::vector<FieldQuery> queries;
    queries.reserve(all.size());
    for (const GuideReceiver& r : all) queries.push_back({r.position, r.normal, r.normal});
    std::vector<glm::vec3> irradiance(all.size());
    if (auto answered = field.irradiance(queries, irradiance); !answered) return answered.error();
    std::vector<double> sums(regions);
    std::vector<int> counts(regions);
    for (std::size_t i = 0; i < all.size(); ++i) {
        const float level = kernels::luminance(irradiance[i]) / kernels::kPi;
        sums[all[i].region] += std::isfinite(level) ? double(std::max(level, 0.0f)) : 0.0;
        ++counts[all[i].region];
    }
    std::vector<float> levels(regions, -1.0f);
    for (std::size_t i = 0; i < regions; ++i)
        if (counts[i] > 0) levels[i] = float(sums[i] / counts[i]);
    return levels;
}

}  // namespace

Result<std::vector<GuideReceiver>> receiversSeen(const Transport& transport, std::span<const Ray> rays) {
    std::vector<Hit> hits(rays.size());
    std::vector<Surface> surfaces(rays.size());
    if (auto hit = transport.tracer->closestHits(rays, hits); !hit) return hit.error();
    if (auto found = transport.tracer->surfaces(rays, hits, surfaces); !found) return found.error();
    std::vector<GuideReceiver> seen;
    for (std::size_t i = 0; i < rays.size(); ++i)
        if (hits[i].valid() && !surfaces[i].backface) seen.push_back(receiverAt(surfaces[i]));
    return seen;
}

Result<GuideLessons> takeLessons(const Context& context, const Transport& transport, const Field& field,
                                 const PathGuide& guide, std::vector<GuideReceiver> first, std::uint64_t seed) {
    std::vector<GuideReceiver> all = first;
    for (int generation = 1; generation <= kGenerations; ++generation) {
        auto next = nextGeneration(transport, first, seed + std::uint64_t(generation));
        if (!next) return next.error();
        first = std::move(*next);
        all.insert(all.end(), first.begin(), first.end());
    }
    for (GuideReceiver& receiver : all)
        receiver.region = std::uint32_t(guide.regionOf(receiver.position, receiver.normal));

    GuideLessons lessons;
    auto levels = levelsOf(field, guide.regionCount(), all);
    if (!levels) return levels.error();
    lessons.levels = std::move(*levels);
    lessons.receivers = choose(std::move(all));
    const std::size_t count = lessons.receivers.size();
    lessons.background.resize(count);
    lessons.backgroundSquares.resize(count);
    const Bounds bounds = transport.tracer->bounds();
    const float farthest = std::max(glm::length(bounds.upper - bounds.lower), 1e-6f);
    Views views(std::min(kBlock, count) * kRays);
    for (std::size_t begin = 0; begin < count; begin += kBlock) {
        const std::size_t size = std::min(kBlock, count - begin);
        const auto block = std::span(lessons.receivers).subspan(begin, size);
        if (auto looked = look(context, transport, block, begin, seed, views); !looked) return looked.error();
        const auto answered = field.irradiance(std::span(views.queries).first(size * kRays),
                                               std::span(views.irradiance).first(size * kRays));
        if (!answered) return answered.error();
        std::vector<std::vector<GuideLight>> found((size + kGrain - 1) / kGrain);
        parallelFor(context, size, kGrain, [&](std::size_t from, std::size_t to) {
            for (std::size_t r = from; r < to; ++r)
                learn(transport, views, r * kRays, std::uint32_t(begin + r), farthest, lessons, found[from / kGrain]);
        });
        for (const auto& lights : found) lessons.lights.insert(lessons.lights.end(), lights.begin(), lights.end());
    }
    return lessons;
}

}  // namespace probegi

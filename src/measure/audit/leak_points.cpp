#include "measure/audit/leak_points.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/parallel.h"
#include "core/progress.h"
#include "measure/audit/ray_bundle.h"
#include "measure/input_checks.h"

namespace probegi {

namespace {

constexpr std::size_t kTask = 256;  ///< points
constexpr double kCounts = 1e-4;    ///< share of the weights from which a probe is counted
constexpr double kNoLight = 1e-20;  ///< W m^-2

/// Finds the hidden ones of some probes of each point: those that the point does not see, nor a place in front of it.
/// `slots` and `out` are by point.
Result<void> findHidden(const FieldRecord& record, const Tracer& tracer, std::span<const FieldQuery> queries,
                        const std::vector<std::vector<int>>& slots, const std::vector<glm::vec3>& ahead,
                        std::vector<std::vector<int>>& out) {
    struct Asked {
        std::size_t point;
        int slot;
    };
    std::vector<Asked> asked, again;
    RayBundle plain(tracer), leaning(tracer);
    for (std::size_t i = 0; i < queries.size(); ++i)
        for (const int slot : slots[i]) {
            plain.add(queries[i].position, queries[i].normal, record.probeAt(slot));
            asked.push_back({i, slot});
        }
    if (auto traced = plain.trace(); !traced) return traced;
    for (std::size_t s = 0; s < asked.size(); ++s) {
        if (!plain.blocked(s)) continue;
        leaning.add(ahead[asked[s].point], queries[asked[s].point].normal, record.probeAt(asked[s].slot));
        again.push_back(asked[s]);
    }
    if (auto traced = leaning.trace(); !traced) return traced;
    for (std::size_t s = 0; s < again.size(); ++s)
        if (leaning.blocked(s)) out[again[s].point].push_back(again[s].slot);
    return {};
}

/// The places in front of the points from which probes may be seen too: no farther than half the way to what is ahead.
Result<std::vector<glm::vec3>> placesAhead(const FieldRecord& record, const Tracer& tracer,
                                           std::span<const FieldQuery> queries, std::span<const LookUp> looks) {
    const float magnitude = magnitudeOf(tracer);
    std::vector<Ray> rays;
    for (std::size_t i = 0; i < queries.size(); ++i) {
        const float lean = kLean * record.volumes[std::size_t(looks[i].volume)].minSpacing;
        const FieldQuery& q = queries[i];
        rays.push_back(segment(q.position, q.normal, q.position + 2 * lean * q.normal, magnitude));
    }
    std::vector<Hit> hits(rays.size());
    if (auto traced = tracer.closestHits(rays, hits); !traced) return traced.error();
    std::vector<glm::vec3> places;
    for (std::size_t i = 0; i < queries.size(); ++i) {
        const float free = hits[i].valid() ? hits[i].distance : rays[i].far;
        places.push_back(queries[i].position + 0.5f * free * queries[i].normal);
    }
    return places;
}

/// Pairs of the gradient whose two probes do not see each other.
Result<void> findHiddenPairs(const FieldRecord& record, const Tracer& tracer, std::span<const LookUp> looks,
                             std::vector<Hidden>& hidden) {
    struct Asked {
        std::size_t point, pair;
    };
    std::vector<Asked> asked;
    RayBundle bundle(tracer);
    for (std::size_t i = 0; i < looks.size(); ++i) {
        const kernels::CageWeights& w = looks[i].weights;
        for (std::size_t k = 0; k < 4; ++k) {
            if (!(w.pair[k] > 0) || w.step == 0) continue;
            const int front = w.slot[w.front[k]];
            bundle.add(record.probeAt(front), glm::vec3(0), record.probeAt(front + w.step));
            asked.push_back({i, k});
        }
    }
    if (auto traced = bundle.trace(); !traced) return traced;
    for (std::size_t s = 0; s < asked.size(); ++s) hidden[asked[s].point].out.pairs[asked[s].pair] = bundle.blocked(s);
    return {};
}

/// Light that the hidden probes alone would answer.
double hiddenLight(const FieldRecord& record, const FieldQuery& query, const LookUp& look,
                   const std::vector<int>& hidden) {
    const LeftOut none;
    const RecordAccess access(record, none);
    double weight = 0, sum = 0;
    const auto add = [&](int slot, double w) {
        const glm::vec3 root = kernels::storedRoot(access, slot, query.normal);
        weight += w;
        sum += w * (double(root.x) + double(root.y) + double(root.z)) / 3;
    };
    for (int corner = 0; corner < 8; ++corner)
        if (std::find(hidden.begin(), hidden.end(), look.weights.slot[corner]) != hidden.end())
            add(look.weights.slot[corner], double(look.weights.weight[corner]));
    if (!look.enough) {
        const std::vector<int> around = neighboursOf(record, look);
        for (const int slot : hidden)
            if (std::find(around.begin(), around.end(), slot) != around.end())
                add(slot, double(kernels::kDoubtful) / double(around.size()));
    }
    if (!(weight > 0)) return 0;
    return sum / weight * (sum / weight) * double(kernels::kPi);
}

/// Metres from a point to the volume that answers there; 0 inside.
double beyondVolume(const FieldRecord& record, const LookUp& look, glm::vec3 point) {
    const kernels::Volume& v = record.volumes[std::size_t(look.volume)];
    const glm::vec3 local = kernels::toVolumePoint(v, point);
    return double(glm::length(local - kernels::clampToVolume(v, local)));
}

/// Whether look-ups use the probe at all: those in walls and new ones they pass over.
bool isUsed(const FieldRecord& record, int slot) {
    const LeftOut none;
    return kernels::outsideWeight(record.snapshot.state(slot).backfaceShare, RecordAccess(record, none).rules) > 0;
}

/// Most of the weights that one hidden probe has.
void nameWorst(const FieldRecord& record, const LookUp& look, const Hidden& hidden, LeakPoint& point) {
    for (int corner = 0; corner < 8; ++corner) {
        if (!hidden.corner[std::size_t(corner)]) continue;
        const double share = shareOf(record, point.query, look, {look.weights.slot[corner]});
        if (share <= point.slotShare) continue;
        point.slot = look.weights.slot[corner];
        point.slotShare = share;
    }
    if (!look.enough)
        for (const int slot : hidden.out.slots) {
            const double share = shareOf(record, point.query, look, {slot});
            if (share > point.slotShare) point.slot = slot, point.slotShare = share;
        }
    if (point.slot >= 0) point.probe = record.probeAt(point.slot);
}

LeakPoint judge(const FieldRecord& record, const FieldQuery& query, const LookUp& look, const Hidden& hidden,
                LeakCounts& counts) {
    LeakPoint point;
    point.query = query;
    point.volume = look.volume;
    point.beyond = beyondVolume(record, look, query.position);
    point.light = answerOf(record, query, look);
    point.unleaked = point.light;
    point.probesSee = false;
    for (int corner = 0; corner < 8; ++corner) {
        const bool usable = isUsed(record, look.weights.slot[corner]);
        point.probesSee |= usable && !hidden.corner[std::size_t(corner)];
        const bool counted = double(look.weights.weight[corner]) > kCounts * double(look.weights.weightSum);
        counts.pairs += counted;
        counts.hiddenPairs += counted && hidden.corner[std::size_t(corner)];
    }
    const bool pairs = std::find(hidden.out.pairs.begin(), hidden.out.pairs.end(), true) != hidden.out.pairs.end();
    if (hidden.out.slots.empty() && !pairs) return point;
    point.hidden = shareOf(record, query, look, hidden.out.slots);
    nameWorst(record, look, hidden, point);
    const LookUp seen = lookUp(record, query, hidden.out);
    point.unleaked = answerOf(record, query, seen, hidden.out);
    if (pairs) {
        LeftOut gradient;
        gradient.pairs = hidden.out.pairs;
        const double without = answerOf(record, query, lookUp(record, query, gradient));
        point.gradient = std::abs(point.light - without) > 0.5 * std::abs(point.light - point.unleaked);
    }
    const double brighter = std::max({point.unleaked, point.light, hiddenLight(record, query, look, hidden.out.slots)});
    if (brighter > kNoLight) point.leak = std::clamp((point.light - point.unleaked) / brighter, -1.0, 1.0);
    return point;
}

}  // namespace

Result<std::vector<Hidden>> hiddenAt(const FieldRecord& record, const Tracer& tracer,
                                     std::span<const FieldQuery> queries, std::span<const LookUp> looks) {
    const auto ahead = placesAhead(record, tracer, queries, looks);
    if (!ahead) return ahead.error();
    std::vector<std::vector<int>> cages(queries.size()), hiddenSlots(queries.size());
    for (std::size_t i = 0; i < queries.size(); ++i)
        cages[i].assign(std::begin(looks[i].weights.slot), std::end(looks[i].weights.slot));
    if (auto found = findHidden(record, tracer, queries, cages, *ahead, hiddenSlots); !found) return found.error();
    std::vector<Hidden> hidden(queries.size());
    for (std::size_t i = 0; i < queries.size(); ++i)
        for (std::size_t corner = 0; corner < 8; ++corner)
            hidden[i].corner[corner] = std::find(hiddenSlots[i].begin(), hiddenSlots[i].end(),
                                                 looks[i].weights.slot[corner]) != hiddenSlots[i].end();
    // Neighbours come in where the cage has too little weight, or would without its hidden probes.
    std::vector<std::vector<int>> around(queries.size());
    for (std::size_t i = 0; i < queries.size(); ++i) {
        bool asked = !looks[i].enough;
        if (!hiddenSlots[i].empty() && !asked) {
            LeftOut out;
            out.slots = hiddenSlots[i];
            asked = !lookUp(record, queries[i], out).enough;
        }
        if (asked) around[i] = neighboursOf(record, looks[i]);
    }
    if (auto found = findHidden(record, tracer, queries, around, *ahead, hiddenSlots); !found) return found.error();
    for (std::size_t i = 0; i < queries.size(); ++i) hidden[i].out.slots = std::move(hiddenSlots[i]);
    if (auto found = findHiddenPairs(record, tracer, looks, hidden); !found) return found.error();
    return hidden;
}

Result<void> measureLeaks(const FieldRecord& record, const Tracer& tracer, std::span<const FieldQuery> queries,
                          std::span<LeakPoint> out, LeakCounts& counts) {
    std::vector<LookUp> looks;
    for (const FieldQuery& query : queries) looks.push_back(lookUp(record, query));
    const auto hidden = hiddenAt(record, tracer, queries, looks);
    if (!hidden) return hidden.error();
    for (std::size_t i = 0; i < queries.size(); ++i) out[i] = judge(record, queries[i], looks[i], (*hidden)[i], counts);
    return {};
}

Result<std::vector<LeakPoint>> measureAllLeaks(const Context& context, const FieldRecord& record, const Tracer& tracer,
                                               std::span<const FieldQuery> queries, LeakCounts& counts) {
    std::vector<LeakPoint> points(queries.size());
    std::vector<LeakCounts> each((queries.size() + kTask - 1) / kTask);
    Progress progress(context, "looking for leaks", double(queries.size()));
    const auto done =
        tryParallelFor(context, queries.size(), kTask, [&](std::size_t begin, std::size_t end) -> Result<void> {
            const auto part = measureLeaks(record, tracer, queries.subspan(begin, end - begin),
                                           std::span(points).subspan(begin, end - begin), each[begin / kTask]);
            if (!part) return part;
            if (!progress.advance(double(end - begin))) return fail(ErrorCode::cancelled, "The audit was cancelled.");
            return {};
        });
    if (!done) return done.error();
    for (const LeakCounts& c : each) counts.pairs += c.pairs, counts.hiddenPairs += c.hiddenPairs;
    return points;
}

Result<std::vector<LeakPoint>> leaksAt(const Context& context, const Tracer& tracer, const Field& field,
                                       std::span<const FieldQuery> points) {
    return withinMemory("look for leaks", [&]() -> Result<std::vector<LeakPoint>> {
        const auto record = recordOf(field);
        if (!record) return record.error();
        LeakCounts counts;
        return measureAllLeaks(context, *record, tracer, points, counts);
    });
}

}  // namespace probegi

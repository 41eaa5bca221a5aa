#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "core/progress.h"
#include "core/sentence.h"
#include "measure/audit/leak_places.h"
#include "measure/audit/viewers.h"
#include "measure/input_checks.h"
#include "measure/luminance.h"
#include "measure/surface_sampling.h"

namespace probegi {

namespace {

constexpr std::size_t kExplained = 16;    ///< points of a task
constexpr std::size_t kTruthPoints = 24;  ///< of a place, at which the path tracer is asked
constexpr double kConfirmed = 0.5;        ///< of a leak that must be wrong light in truth
constexpr double kSigmas = 2;             ///< of the path tracer's noise

Result<void> check(const AuditDesc& desc) {
    const auto refuse = [](const char* name, auto value, const char* range) {
        return fail(ErrorCode::invalidArgument,
                    sentence("AuditDesc::", name, " is ", value, "; the range is ", range, "."));
    };
    if (desc.points < 1 || desc.points > 1 << 22) return refuse("points", desc.points, "1 to 4194304");
    if (!(desc.least >= 1e-4 && desc.least <= 1)) return refuse("least", desc.least, "0.0001 to 1");
    if (!(desc.leastStops >= 0 && desc.leastStops <= 10)) return refuse("leastStops", desc.leastStops, "0 to 10");
    if (desc.truthSamples < 1 || desc.truthSamples > 65536)
        return refuse("truthSamples", desc.truthSamples, "1 to 65536");
    return {};
}

Result<std::vector<ExplainedPoint>> explainAll(const Context& context, const FieldRecord& record, const Tracer& tracer,
                                               const std::vector<LeakPoint>& points, const AuditDesc& desc,
                                               double meanLight) {
    std::vector<ExplainedPoint> leaking;
    for (const LeakPoint& p : points)
        if (std::abs(p.leak) >= desc.least && stopsApart(p.light, p.unleaked, meanLight) >= desc.leastStops)
            leaking.push_back({p, {}});
    std::vector<char> open(leaking.size(), false);
    Progress progress(context, "finding out why it leaks", double(leaking.size()));
    const auto done =
        tryParallelFor(context, leaking.size(), kExplained, [&](std::size_t begin, std::size_t end) -> Result<void> {
            for (std::size_t i = begin; i < end; ++i) {
                const auto inside = isInsideMatter(tracer, leaking[i].point.query);
                if (!inside) return inside.error();
                if (*inside) continue;
                open[i] = true;
                const auto why = explain(record, tracer, leaking[i].point, desc.least);
                if (!why) return why.error();
                leaking[i].why = *why;
            }
            if (!progress.advance(double(end - begin))) return fail(ErrorCode::cancelled, "The audit was cancelled.");
            return {};
        });
    if (!done) return done.error();
    // No camera gets into a crown of leaves whose parts reach into each other.
    std::vector<ExplainedPoint> seen;
    for (std::size_t i = 0; i < leaking.size(); ++i)
        if (open[i]) seen.push_back(leaking[i]);
    return seen;
}

/// Some points of a group, spread over it.
std::vector<FieldQuery> someOf(const std::vector<ExplainedPoint>& points, const std::vector<std::size_t>& group) {
    const std::size_t count = std::min(group.size(), kTruthPoints);
    std::vector<FieldQuery> some;
    for (std::size_t i = 0; i < count; ++i) some.push_back(points[group[i * group.size() / count]].point.query);
    return some;
}

/// What the path tracer says of a place. False: the light there is right, whatever the weights say.
Result<bool> confirm(const std::vector<ExplainedPoint>& points, const std::vector<std::size_t>& group,
                     const AuditDesc& desc, LeakPlace& place) {
    const std::vector<FieldQuery> queries = someOf(points, group);
    const auto truth = desc.truth->irradiance(queries, desc.truthSamples, desc.seed);
    if (!truth) return truth.error();
    double light = 0, variance = 0, sum = 0, unleaked = 0;
    for (std::size_t i = 0; i < queries.size(); ++i) {
        const LeakPoint& p = points[group[i * group.size() / queries.size()]].point;
        light += p.light, unleaked += p.unleaked;
        sum += channelMean((*truth)[i].mean);
        variance += std::pow(channelMean((*truth)[i].standardError), 2);
    }
    const double count = double(queries.size());
    place.truth = sum / count, place.truthError = std::sqrt(variance) / count;
    const double leaked = std::abs(light - unleaked) / count;
    const double wrong = place.leak > 0 ? light / count - place.truth : place.truth - light / count;
    return wrong - kSigmas * place.truthError >= kConfirmed * leaked;
}

/// Harm by the light that is right as far as it is known.
double harmOf(const LeakPlace& place, double meanLight) {
    double right = place.unleaked;
    if (place.truth >= 0)
        right = std::clamp(place.truth, std::min(place.light, place.unleaked), std::max(place.light, place.unleaked));
    return place.area * stopsApart(place.light, right, meanLight);
}

Result<void> findPlaces(const Context& context, const FieldRecord& record, const Tracer& tracer,
                        const std::vector<LeakPoint>& points, const AuditDesc& desc, LeakAudit& audit) {
    const auto leaking = explainAll(context, record, tracer, points, desc, audit.meanLight);
    if (!leaking) return leaking.error();
    for (const std::vector<std::size_t>& group : groupPoints(*leaking, record)) {
        LeakPlace place = placeOf(*leaking, group, record);
        if (desc.truth) {
            const auto wrong = confirm(*leaking, group, desc, place);
            if (!wrong) return wrong.error();
            if (!*wrong) {
                ++audit.harmless;
                continue;
            }
        }
        place.harm = harmOf(place, audit.meanLight);
        audit.leakingArea += place.area;
        audit.worst = std::max(audit.worst, std::abs(place.leak));
        audit.places.push_back(place);
    }
    std::stable_sort(audit.places.begin(), audit.places.end(),
                     [](const LeakPlace& a, const LeakPlace& b) { return a.harm > b.harm; });
    return {};
}

Result<LeakAudit> auditScene(const Context& context, const Scene& scene, const ScenePose& pose, const Tracer& tracer,
                             const Field& field, const AuditDesc& desc) {
    const auto record = recordOf(field);
    if (!record) return record.error();
    const auto samples = sampleSurfaces(scene, pose, tracer, desc.points, desc.seed);
    if (!samples) return samples.error();
    std::vector<FieldQuery> queries;
    for (const SurfaceSample& sample : *samples) queries.push_back(sample.query);
    if (auto placed = placeViewers(tracer, queries, desc.seed); !placed) return placed.error();
    LeakCounts counts;
    auto points = measureAllLeaks(context, *record, tracer, queries, counts);
    if (!points) return points.error();

    LeakAudit audit;
    audit.points = int(points->size());
    audit.pairs = counts.pairs;
    audit.hiddenPairs = counts.hiddenPairs;
    for (std::size_t i = 0; i < points->size(); ++i) {
        LeakPoint& p = (*points)[i];
        p.area = (*samples)[i].area;
        audit.area += p.area;
        audit.hidden += p.area * p.hidden, audit.meanLight += p.area * p.light;
    }
    if (audit.area > 0) audit.hidden /= audit.area, audit.meanLight /= audit.area;
    if (auto found = findPlaces(context, *record, tracer, *points, desc, audit); !found) return found.error();
    return audit;
}

}  // namespace

Result<LeakAudit> auditLeaks(const Context& context, const Scene& scene, const ScenePose& pose, const Tracer& tracer,
                             const Field& field, const AuditDesc& desc) {
    if (auto ok = check(desc); !ok) return ok.error();
    // What primitives do not hide follows from how they stand for the scene, which is none of the causes.
    if (field.control().settings().guard == LeakGuard::sdfShadow)
        return fail(
            ErrorCode::invalidArgument,
            "of a field with LeakGuard::sdfShadow no cause can be told; audit it with another guard, or measure "
            "it with leaksAt()");
    return withinMemory("audit the leaks", [&] { return auditScene(context, scene, pose, tracer, field, desc); });
}

}  // namespace probegi

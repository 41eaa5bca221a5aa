#include "bench/rounds.h"

#include <chrono>
#include <optional>

#include "bench/floor.h"
#include "bench/points.h"
#include "camera_rays.h"
#include "probegi/render.h"
#include "render_stats.h"

namespace probegi::tool {

namespace {

using Clock = std::chrono::steady_clock;

constexpr int kWarmUpUpdates = 8;           // so that the field has light of several bounces
constexpr double kLeastGrowthRays = 320e3;  // per sample: small volumes are updated several times

double millisecondsSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

std::vector<Ray> probeRays(const Field& field) {
    const FieldControl& control = field.control();
    std::vector<Ray> rays;
    rays.reserve(control.tasks().size() * (control.rayDirections().size() + control.fixedRayDirections().size()));
    for (const ProbeTask& task : control.tasks())
        for (const std::span<const glm::vec3> directions : {control.rayDirections(), control.fixedRayDirections()})
            for (const glm::vec3& direction : directions) rays.push_back({task.origin, 0.0f, direction});
    return rays;
}

Result<Context> quietContext(int threads) {
    ContextDesc desc;
    desc.threads = threads;
    return Context::create(desc);
}

// What all rounds share. Not movable.
class Bench {
public:
    static Result<std::unique_ptr<Bench>> create(const LoadedSetup& setup, const BenchPlan& plan);

    /// What probe rays hit.
    const Tracer& probes() const { return m_primitives ? *m_primitives : *m_tracer; }
    Result<void> warmUp();
    Result<BenchRound> round();
    Result<void> growth(BenchResult& result, const BenchProgress& progress) const;
    BenchResult facts() const;

private:
    Bench(const LoadedSetup& setup, const BenchPlan& plan, Context all, Context one, RawEmbree raw, RawEmbree robust)
        : m_setup(setup),
          m_plan(plan),
          m_all(std::move(all)),
          m_one(std::move(one)),
          m_raw(std::move(raw)),
          m_robust(std::move(robust)) {}

    const LoadedSetup& m_setup;
    const BenchPlan& m_plan;
    Context m_all, m_one;
    RawEmbree m_raw, m_robust;
    std::unique_ptr<Tracer> m_tracer;
    std::unique_ptr<MovableTracer> m_primitives;  // of --sdf; null: probe rays hit the triangles
    std::optional<Field> m_field, m_fieldAlone, m_fieldOfActive;
    std::vector<Ray> m_primary;
    std::vector<FieldQuery> m_points;
    std::vector<glm::vec3> m_irradiance;
};

Result<std::unique_ptr<Bench>> Bench::create(const LoadedSetup& setup, const BenchPlan& plan) {
    const auto all = quietContext(plan.threads), one = quietContext(1);
    if (!all) return all.error();
    auto raw = RawEmbree::create(*setup.scene, setup.pose, all->threads(), false);
    if (!raw) return raw.error();
    auto robust = RawEmbree::create(*setup.scene, setup.pose, all->threads(), true);
    if (!robust) return robust.error();
    std::unique_ptr<Bench> bench(new Bench(setup, plan, *all, *one, std::move(*raw), std::move(*robust)));

    auto tracer = makeEmbreeTracer(*all, *setup.scene, setup.pose);
    if (!tracer) return tracer.error();
    bench->m_tracer = std::move(*tracer);
    if (setup.sdf) {
        auto primitives = makeSdfTracer(*all, *setup.sdf, *setup.scene, setup.pose);
        if (!primitives) return primitives.error();
        bench->m_primitives = std::move(*primitives);
    }
    FieldDesc desc;
    desc.volumes = setup.volumes;
    desc.raysPerProbe = plan.raysPerProbe;
    auto field = Field::create(*all, desc, setup.settings), alone = Field::create(*one, desc, setup.settings);
    desc.probeStates = true;
    auto active = Field::create(*all, desc, setup.settings);
    if (!field) return field.error();
    if (!alone) return alone.error();
    if (!active) return active.error();
    bench->m_fieldOfActive.emplace(std::move(*active));
    bench->m_field.emplace(std::move(*field));
    bench->m_fieldAlone.emplace(std::move(*alone));
    bench->m_primary = primaryRays(setup.camera, plan.width, plan.height);
    auto points = picturePoints(*bench->m_tracer, bench->m_primary);
    if (!points) return points.error();
    bench->m_points = std::move(*points);
    bench->m_irradiance.resize(bench->m_points.size());
    return bench;
}

Result<void> Bench::warmUp() {
    for (Field* field : {&*m_field, &*m_fieldOfActive})
        if (const auto done = field->converge(probes(), m_setup.lighting, 1e-6f, kWarmUpUpdates); !done)
            return done.error();
    return round().transform([](const BenchRound&) {});
}

Result<BenchRound> Bench::round() {
    BenchRound round;
    {
        const std::vector<Ray> rays = probeRays(*m_field);
        round.floor = m_raw.trace(rays);
        round.robustFloor = m_robust.trace(rays);
    }
    const auto times = m_field->update(probes(), m_setup.lighting);
    if (!times) return times.error();
    round.update = *times;
    const auto ofActive = m_fieldOfActive->update(probes(), m_setup.lighting);
    if (!ofActive) return ofActive.error();
    round.updateOfActive = ofActive->total;

    const std::uint64_t fallbacks = m_field->fallbackQueries();
    auto start = Clock::now();
    const auto asked = m_field->irradiance(m_points, m_irradiance);
    if (!asked) return asked.error();
    round.query = millisecondsSince(start);
    round.fallbacks = double(m_field->fallbackQueries() - fallbacks);

    round.primaryFloor = m_raw.trace(m_primary);
    start = Clock::now();
    const auto picture = renderPicture(m_all, *m_tracer, m_setup.lighting, &*m_field,
                                       {m_setup.camera, m_plan.width, m_plan.height, 1, false});
    if (!picture) return picture.error();
    round.picture = millisecondsSince(start);

    const auto alone = m_fieldAlone->update(probes(), m_setup.lighting);
    if (!alone) return alone.error();
    round.updateAlone = alone->total;
    return round;
}

BenchResult Bench::facts() const {
    BenchResult result;
    result.threads = m_all.threads();
    result.probes = probeCount(m_setup);
    result.raysPerProbe = m_plan.raysPerProbe;
    result.activeProbes = int(m_fieldOfActive->control().tasks().size());
    result.fixedRays = int(m_field->control().fixedRayDirections().size());
    result.triangles = triangleCount(*m_setup.scene, m_setup.pose);
    result.points = m_points.size();
    result.pixels = m_primary.size();
    result.persistentBytes = m_field->memory().persistentBytes();
    result.scratchBytes = m_field->memory().scratchBytes;
    return result;
}

// Volumes of several sizes over the same scene, updated in turn.
Result<void> Bench::growth(BenchResult& result, const BenchProgress& progress) const {
    std::vector<Field> fields;
    for (const BenchPlan::Volume& volume : m_plan.growth) {
        PlacementDesc placement;
        placement.counts = volume.counts;
        placement.marginCells = 0;  // else coarse grids would have wide margins, where rays hit nothing
        const auto grid = placeVolume(m_setup.pose.bounds, placement);
        if (!grid) return grid.error();
        FieldDesc desc;
        desc.volumes = {*grid};
        desc.raysPerProbe = volume.raysPerProbe;
        auto field = Field::create(m_all, desc);
        if (!field) return field.error();
        fields.push_back(std::move(*field));
        result.growth.push_back({probeCount(*grid), volume.raysPerProbe, {}});
    }
    for (int round = 0; round <= m_plan.rounds; ++round) {
        progress("growth", round, m_plan.rounds);
        for (std::size_t i = 0; i < fields.size(); ++i) {
            const double rays = double(result.growth[i].probes) * result.growth[i].rays;
            const int repeats = std::max(1, int(kLeastGrowthRays / rays));
            const auto start = Clock::now();
            for (int k = 0; k < repeats; ++k)
                if (const auto done = fields[i].update(probes(), m_setup.lighting); !done) return done.error();
            if (round > 0) result.growth[i].ms.push_back(millisecondsSince(start) / repeats);
        }
    }
    return {};
}

}  // namespace

double BenchResult::median(const std::function<double(const BenchRound&)>& value) const {
    std::vector<double> values;
    for (const BenchRound& round : rounds) values.push_back(value(round));
    return tool::median(std::move(values));
}

Result<BenchResult> runBench(const LoadedSetup& setup, const BenchPlan& plan, const BenchProgress& progress) {
    progress("warming up", 0, plan.rounds);
    const auto bench = Bench::create(setup, plan);
    if (!bench) return bench.error();
    if (const auto done = (*bench)->warmUp(); !done) return done.error();
    BenchResult result = (*bench)->facts();
    for (int round = 1; round <= plan.rounds; ++round) {
        progress("stages", round, plan.rounds);
        const auto measured = (*bench)->round();
        if (!measured) return measured.error();
        result.rounds.push_back(*measured);
    }
    if (const auto done = (*bench)->growth(result, progress); !done) return done.error();
    return result;
}

}  // namespace probegi::tool

#include "budget.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <stdexcept>

#include "probegi/builtin_scenes.h"

namespace probegi::accuracy {

namespace {

constexpr int kPoints = 1000;
constexpr int kFilled = 100;       ///< updates before the lamp moves
constexpr int kMoves = 96;         ///< updates while it does
constexpr int kEvery = 12;         ///< of them, the light is compared
constexpr int kStands = 200;       ///< updates after that
constexpr int kStillUpdates = 60;  ///< of them the last, over which flicker is measured
constexpr float kTruthTolerance = 0.005f;
constexpr int kTruthUpdates = 200;

/// The value; throws the error's message, which measureBudget() catches.
template <class T>
T must(Result<T> result) {
    if (!result) throw std::runtime_error(result.error().message);
    if constexpr (!std::is_void_v<T>) return std::move(*result);
}

/// A lamp that goes from one place to the other and back, and the grid.
struct Stage {
    const char* scene;
    glm::vec3 from, to;   ///< metres
    glm::vec3 intensity;  ///< W/sr
    PlacementDesc placement;
};

Stage stageOf(const std::string& scene) {
    if (scene == "cornell")
        return {"cornell", {0.8f, 3.6f, -0.8f}, {4.7f, 3.6f, -4.7f}, glm::vec3(8), {.counts = {8, 8, 8}}};
    return {"house", {1.0f, 1.8f, 0.8f}, {5.2f, 1.8f, 6.2f}, glm::vec3(8), {.targetProbes = 1500}};
}

/// What the ways have in common.
struct World {
    World(const Context& context, const Stage& where)
        : stage(where), scene(must(makeBuiltinScene(where.scene))), pose(poseAt(scene)), sky{pose.lights, scene.sky} {
        tracer = must(makeEmbreeTracer(context, scene, pose));
        desc.volumes = {must(placeVolume(pose.bounds, stage.placement))};
        points = must(visiblePoints(*tracer, pose.bounds, kPoints));
    }
    /// With the lamp after so many updates of its way.
    Lighting lightingAt(int update) const {
        Lighting lighting = sky;
        PlacedLight lamp;
        lamp.type = LightType::point;
        lamp.position = glm::mix(stage.from, stage.to, 0.5f - 0.5f * std::cos(6.2831853f * float(update) / kMoves));
        lamp.intensity = stage.intensity;
        lighting.lights.push_back(lamp);
        return lighting;
    }

    Stage stage;
    Scene scene;
    ScenePose pose;
    Lighting sky;
    std::unique_ptr<Tracer> tracer;
    FieldDesc desc;
    std::vector<FieldQuery> points;
};

/// Chooses the probes of the coming update; `frame` counts them.
using Choose = std::function<void(FieldControl&, int frame)>;

struct Way {
    std::string name;
    Choose choose;
};

/// Every n-th probe, and the next ones in the next update.
Choose inTurn(int n) {
    return [n](FieldControl& control, int frame) {
        std::vector<std::uint32_t> slots;
        for (int slot = frame % n; slot < probeCount(control.desc()); slot += n) slots.push_back(std::uint32_t(slot));
        must(control.setTasks(slots));
    };
}

/// A share of the rays that an update of all probes takes.
Choose within(int part) {
    return [part](FieldControl& control, int) {
        const FieldDesc& desc = control.desc();
        const int each = desc.raysPerProbe + desc.fixedRays + desc.emitterSamples;
        UpdateBudget budget;
        budget.rays = std::int64_t(each) * probeCount(desc) / part;
        must(control.setBudget(budget));
    };
}

std::vector<Way> ways() {
    return {{"all probes", [](FieldControl&, int) {}}, {"a half, in turn", inTurn(2)},
            {"a quarter, in turn", inTurn(4)},         {"budget of a half", within(2)},
            {"budget of a quarter", within(4)},        {"budget of an eighth", within(8)}};
}

std::vector<std::vector<double>> truths(const Context& context, const World& world) {
    std::vector<std::vector<double>> goals;
    for (int update = kEvery; update <= kMoves; update += kEvery) {
        Field field = must(Field::create(context, world.desc));
        must(field.converge(*world.tracer, world.lightingAt(update), kTruthTolerance, kTruthUpdates));
        goals.push_back(must(lightAt(field, world.points)));
    }
    return goals;
}

/// A field that is updated in one way.
class Run {
public:
    Run(const Context& context, const World& world, const Way& way)
        : m_world(world), m_way(way), m_field(must(Field::create(context, world.desc))) {}

    /// So many updates with the lamp where `at` says; returns how many probes they had, on average.
    double update(int count, const std::function<int(int)>& at, const std::function<void(int)>& after) {
        double probes = 0;
        for (int k = 1; k <= count; ++k) {
            m_way.choose(m_field.control(), m_frame++);
            probes += double(m_field.control().tasks().size());
            must(m_field.update(*m_world.tracer, m_world.lightingAt(at(k))));
            after(k);
        }
        return probes / count;
    }
    std::vector<double> light() const { return must(lightAt(m_field, m_world.points)); }

private:
    const World& m_world;
    const Way& m_way;
    Field m_field;
    int m_frame = 0;
};

BudgetRow follow(const Context& context, const World& world, const Way& way,
                 const std::vector<std::vector<double>>& goals) {
    BudgetRow row{.scene = world.stage.scene, .way = way.name, .probes = probeCount(world.desc)};
    Run run(context, world, way);
    const auto stands = [](int) { return 0; };
    run.update(kFilled, stands, [](int) {});
    row.updatedMoving = run.update(
        kMoves, [](int k) { return k; },
        [&](int k) {
            if (k % kEvery == 0)
                row.error +=
                    must(compareLight(run.light(), goals[std::size_t(k / kEvery - 1)])).rms / double(goals.size());
        });
    std::vector<std::vector<double>> still;
    run.update(kStands - kStillUpdates, stands, [](int) {});
    row.updatedStill = run.update(kStillUpdates, stands, [&](int) { still.push_back(run.light()); });
    row.flicker = must(measureFlicker(still));
    row.settled = must(compareLight(still.back(), goals.back())).rms;  // it ends where it began
    return row;
}

}  // namespace

Result<std::vector<BudgetRow>> measureBudget(const Context& context, const std::string& scene) try {
    const World world(context, stageOf(scene));
    const std::vector<std::vector<double>> goals = truths(context, world);
    std::vector<BudgetRow> rows;
    for (const Way& way : ways()) rows.push_back(follow(context, world, way, goals));
    return rows;
} catch (const std::runtime_error& error) {
    return fail(ErrorCode::outOfMemory, error.what());
}

std::string budgetTable(const std::vector<BudgetRow>& rows) {
    std::string table = fmt::format(
        "\n### Budgets\n\n"
        "A lamp goes across a room and back in {} updates; 144 rays. In turn: each update has every n-th probe, and "
        "the "
        "next ones the next time. Budget: `UpdateBudget::rays`, a share of the rays of all probes, without a view. "
        "Updated: probes of an update, mean, while the lamp moves, and after it has stood for {} updates. Error: RMS "
        "difference from the converged light of the moment at surface points, over its mean, mean of {} moments; "
        "settled: the same at the end. Flicker: temporal standard deviation over mean, mean and 95th percentile of the "
        "points, over the last {} updates.\n\n"
        "| scene | probes | way | updated, moving | updated, still | error, moving | settled | flicker | 95th |\n"
        "|---|---:|---|---:|---:|---:|---:|---:|---:|\n",
        kMoves, kStands - kStillUpdates, kMoves / kEvery, kStillUpdates);
    for (const BudgetRow& row : rows)
        table += fmt::format("| {} | {} | {} | {:.0f} | {:.0f} | {:.1f} % | {:.1f} % | {:.2f} % | {:.2f} % |\n",
                             row.scene, row.probes, row.way, row.updatedMoving, row.updatedStill, 100 * row.error,
                             100 * row.settled, 100 * row.flicker.mean, 100 * row.flicker.high);
    return table;
}

}  // namespace probegi::accuracy

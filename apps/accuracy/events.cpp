#include "events.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <stdexcept>

#include "probegi/builtin_scenes.h"
#include "render_options.h"

namespace probegi::accuracy {

namespace {

constexpr int kPoints = 1000;
constexpr int kSettledBefore = 40;  ///< updates before the change
constexpr int kHorizon = 40;        ///< updates measured after it
constexpr double kLeft = 0.1;       ///< of the change
constexpr int kProbes = 700;
constexpr float kTruthTolerance = 0.004f;
constexpr int kTruthUpdates = 300;

/// The value; throws the error's message, which measureEvents() catches.
template <class T>
T must(Result<T> result) {
    if (!result) throw std::runtime_error(result.error().message);
    if constexpr (!std::is_void_v<T>) return std::move(*result);
}

/// A state of a scene, ready to be traced.
struct State {
    ScenePose pose;
    Lighting lighting;
    std::unique_ptr<Tracer> tracer;
};

/// A change of a built-in scene.
struct Change {
    const char* name;
    const char* scene;
    float seconds;  ///< of the pose that is changed
    std::function<void(const Scene&, ScenePose&, Lighting&)> before, after;
};

State stateOf(const Context& context, const Scene& scene, const Change& change, bool after) {
    State state{poseAt(scene, change.seconds), {}, nullptr};
    state.lighting = {state.pose.lights, scene.sky};
    if (const auto& edit = after ? change.after : change.before; edit) edit(scene, state.pose, state.lighting);
    state.tracer = must(makeEmbreeTracer(context, scene, state.pose));
    return state;
}

void lampsOff(const Scene&, ScenePose&, Lighting& lighting) {
    lighting.lights.clear();
}

void moveSun(const Scene&, ScenePose&, Lighting& lighting) {
    for (PlacedLight& light : lighting.lights)
        if (light.type == LightType::directional)
            light.direction = glm::normalize(light.direction + glm::vec3(0.35f, 0.0f, -0.35f));
}

bool isDoor(const Scene& scene, const Instance& instance) {
    return scene.nodes[std::size_t(instance.node)].name == "door";
}

void removeDoor(const Scene& scene, ScenePose& pose, Lighting&) {
    std::erase_if(pose.instances, [&](const Instance& instance) { return isDoor(scene, instance); });
}

void openDoor(const Scene& scene, ScenePose& pose, Lighting&) {
    const ScenePose open = poseAt(scene, 10.0f);
    for (Instance& instance : pose.instances)
        for (const Instance& moved : open.instances)
            if (isDoor(scene, instance) && moved.node == instance.node) instance = moved;
}

std::vector<Change> changes() {
    return {{"lamp on", "moving", 2, lampsOff, nullptr},   {"lamp off", "moving", 2, nullptr, lampsOff},
            {"sun jump", "door", 10, nullptr, moveSun},    {"wall removed", "door", 0, nullptr, removeDoor},
            {"door opened", "door", 0, nullptr, openDoor}, {"door closed", "door", 0, openDoor, nullptr}};
}

FieldSettings settingsFor(FieldRules rules) {
    FieldSettings settings;
    if (rules == FieldRules::paper) settings.visibilityExponent = tool::kPaperVisibilityExponent;
    return settings;
}

double shareInside(const FieldDesc& desc, const std::vector<SceneEdit>& edits) {
    int inside = 0;
    const VolumeDesc& volume = desc.volumes.front();
    for (int i = 0; i < probeCount(volume); ++i) {
        const glm::vec3 p = probePosition(volume, i);
        inside += std::any_of(edits.begin(), edits.end(), [&](const SceneEdit& edit) {
            return edit.everywhere || (glm::all(glm::greaterThanEqual(p, edit.region.lower)) &&
                                       glm::all(glm::lessThanEqual(p, edit.region.upper)));
        });
    }
    return double(inside) / probeCount(volume);
}

/// A change with what is known of it whatever the field does.
struct Experiment {
    const Change& change;
    FieldDesc desc;
    const State &before, &after;
    std::vector<SceneEdit> edits;
    std::vector<FieldQuery> points;
};

EventRow follow(const Context& context, const Experiment& e, const std::vector<double>& goal, bool told) {
    EventRow row{e.change.name, e.change.scene, e.desc.rules, told, int(e.edits.size()), shareInside(e.desc, e.edits)};
    Field field = must(Field::create(context, e.desc, settingsFor(e.desc.rules)));
    for (int k = 0; k < kSettledBefore; ++k) must(field.update(*e.before.tracer, e.before.lighting));
    const std::vector<double> start = must(lightAt(field, e.points));
    if (told) notify(field.control(), e.edits);
    row.arrives = -1;
    int lastOutside = 0;
    for (int k = 1; k <= kHorizon; ++k) {
        must(field.update(*e.after.tracer, e.after.lighting));
        const std::vector<double> now = must(lightAt(field, e.points));
        const bool inside = std::abs(must(shareLeft(now, start, goal))) <= kLeft;
        if (inside && row.arrives < 0) row.arrives = k;
        if (!inside) lastOutside = k;
        if (k == 10) row.errorAfterTen = must(compareLight(now, goal)).rms;
    }
    row.stays = lastOutside < kHorizon ? lastOutside + 1 : -1;
    return row;
}

std::vector<EventRow> measureChange(const Context& context, const Change& change) {
    const Scene scene = must(makeBuiltinScene(change.scene));
    const State before = stateOf(context, scene, change, false), after = stateOf(context, scene, change, true);
    Experiment experiment{change, {}, before, after, {}, {}};
    experiment.desc.volumes = {must(placeVolume(poseAt(scene).bounds, {.targetProbes = kProbes}))};
    experiment.edits = must(findEdits(scene, before.pose, before.lighting, after.pose, after.lighting, *after.tracer));
    experiment.points = must(visiblePoints(*after.tracer, after.pose.bounds, kPoints));
    std::vector<EventRow> rows;
    for (const FieldRules rules : {FieldRules::paper, FieldRules::measured}) {
        experiment.desc.rules = rules;
        Field field = must(Field::create(context, experiment.desc, settingsFor(rules)));
        must(field.converge(*after.tracer, after.lighting, kTruthTolerance, kTruthUpdates));
        const std::vector<double> goal = must(lightAt(field, experiment.points));
        for (const bool told : {false, true}) rows.push_back(follow(context, experiment, goal, told));
    }
    return rows;
}

std::string updates(int count) {
    return count < 0 ? fmt::format("over {}", kHorizon) : fmt::format("{}", count);
}

}  // namespace

Result<std::vector<EventRow>> measureEvents(const Context& context) try {
    std::vector<EventRow> rows;
    for (const Change& change : changes())
        for (EventRow& row : measureChange(context, change)) rows.push_back(std::move(row));
    return rows;
} catch (const std::runtime_error& error) {
    return fail(ErrorCode::outOfMemory, error.what());
}

std::string eventTable(const std::vector<EventRow>& rows) {
    std::string table =
        "\n### Events\n\n"
        "One change of a scene that was updated 40 times before, and the field is not told, or told of what "
        "`findEdits` found; about 700 probes, 144 rays. Probes told: the share of them inside the edits' regions. To "
        "90 "
        "%: updates until a tenth of the change in the light at surface points is left for the first time; within 10 "
        "%: the same for good. Error: RMS difference from the converged light after ten updates, over its mean.\n\n"
        "| change | scene | rules | told | probes told | to 90 % | within 10 % | error |\n"
        "|---|---|---|---|---:|---:|---:|---:|\n";
    for (const EventRow& row : rows)
        table += fmt::format("| {} | {} | {} | {} | {} | {} | {} | {:.1f} % |\n", row.change, row.scene,
                             row.rules == FieldRules::paper ? "paper" : "measured", row.told ? "yes" : "no",
                             row.told ? fmt::format("{:.0f} %", 100 * row.probesTold) : std::string("0 %"),
                             updates(row.arrives), updates(row.stays), 100 * row.errorAfterTen);
    return table;
}

}  // namespace probegi::accuracy

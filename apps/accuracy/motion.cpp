#include "motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>

namespace probegi::accuracy {

namespace {

constexpr int kPoints = 2000;
constexpr int kStillUpdates = 60;     ///< over which flicker is measured
constexpr int kReactionHorizon = 60;  ///< updates measured after a change
constexpr float kWithin = 0.1f;       ///< of the change
constexpr float kOff = 1e-6f;
constexpr std::array<float, 4> kFactors{0.1f, 0.8f, 10.0f, kOff};
constexpr std::array kChanges{"from empty", "x0.1", "x0.8", "x10", "off", "on", "sun jump"};
constexpr float kTruthTolerance = 0.002f;
constexpr int kTruthUpdates = 400;

/// A scene with its lights, ready to be traced.
struct World {
    World(const Context& context, Scene s)
        : scene(std::make_unique<Scene>(std::move(s))),
          pose(poseAt(*scene)),
          lighting{pose.lights, scene->sky},
          tracer(makeEmbreeTracer(context, *scene, pose).value()) {}

    std::unique_ptr<Scene> scene;
    ScenePose pose;
    Lighting lighting;
    std::unique_ptr<Tracer> tracer;
};

/// The value; throws the error's message, which measureMotion() catches.
template <class T>
T must(Result<T> result) {
    if (!result) throw std::runtime_error(result.error().message);
    if constexpr (!std::is_void_v<T>) return std::move(*result);
}

std::vector<double> converged(const Context& context, const World& world, const FieldDesc& desc,
                              const std::vector<FieldQuery>& points) {
    Field field = must(Field::create(context, desc));
    must(field.converge(*world.tracer, world.lighting, kTruthTolerance, kTruthUpdates));
    return must(lightAt(field, points));
}

Flicker flickerOf(Field& field, const World& world, const std::vector<FieldQuery>& points) {
    std::vector<std::vector<double>> updates;
    for (int k = 0; k < kStillUpdates; ++k) {
        must(field.update(*world.tracer, world.lighting));
        updates.push_back(must(lightAt(field, points)));
    }
    return must(measureFlicker(updates));
}

Scene scaled(Scene scene, float factor) {
    for (Light& light : scene.lights) light.intensity *= factor;
    for (Material& material : scene.materials) material.emission *= factor;
    scene.sky.radiance *= factor;
    return scene;
}

bool hasSun(const Scene& scene) {
    return std::any_of(scene.lights.begin(), scene.lights.end(),
                       [](const Light& light) { return light.type == LightType::directional; });
}

/// The sun an hour or two later.
World withSunMoved(const Context& context, const Scene& scene) {
    World world(context, scene);
    for (PlacedLight& light : world.lighting.lights)
        if (light.type == LightType::directional)
            light.direction = glm::normalize(light.direction + glm::vec3(0.35f, 0.0f, -0.35f));
    return world;
}

std::vector<double> times(std::vector<double> light, double factor) {
    for (double& e : light) e *= factor;
    return light;
}

/// Settles a field in `before` (null: a new field), then counts updates in `after` until at most a tenth of the
/// change is left for good.
int updatesToFollow(const Context& context, const World* before, const World& after, const std::vector<double>& goal,
                    const FieldDesc& desc, const std::vector<FieldQuery>& points) {
    Field field = must(Field::create(context, desc));
    std::vector<double> start(goal.size(), 0.0);
    if (before) {
        for (int k = 0; k < kStillUpdates; ++k) must(field.update(*before->tracer, before->lighting));
        start = must(lightAt(field, points));
    }
    int lastOutside = 0;
    for (int k = 1; k <= kReactionHorizon; ++k) {
        must(field.update(*after.tracer, after.lighting));
        if (!(std::abs(must(shareLeft(must(lightAt(field, points)), start, goal))) <= kWithin)) lastOutside = k;
    }
    return lastOutside < kReactionHorizon ? lastOutside + 1 : -1;
}

std::string cell(const MotionResult& row, const std::string& change) {
    for (const Reaction& r : row.reactions)
        if (r.change == change)
            return r.updates < 0 ? fmt::format("over {}", kReactionHorizon) : fmt::format("{}", r.updates);
    return "";
}

}  // namespace

Result<MotionResult> measureMotion(const Context& context, const std::string& name, const Scene& scene,
                                   const FieldDesc& desc, MotionScope scope) try {
    const World world(context, scene);
    const std::vector<FieldQuery> points = must(visiblePoints(*world.tracer, world.pose.bounds, kPoints));
    MotionResult result{name, desc.rules, probeCount(desc), desc.raysPerProbe, 0, {}, {}, {}};
    Field field = must(Field::create(context, desc));
    for (int k = 0; k < kSettledUpdates - kStillUpdates; ++k) must(field.update(*world.tracer, world.lighting));
    result.flicker = flickerOf(field, world, points);
    const std::vector<double> goal = converged(context, world, desc, points);
    result.settled = must(compareLight(must(lightAt(field, points)), goal)).mean;
    if (scope == MotionScope::still) return result;

    const auto follow = [&](const char* change, const World* before, const World& after,
                            const std::vector<double>& to) {
        result.reactions.push_back({change, updatesToFollow(context, before, after, to, desc, points)});
    };
    follow(kChanges[0], nullptr, world, goal);
    // Light is linear, so scaling the lights scales the goal.
    for (std::size_t i = 0; i < kFactors.size(); ++i)
        follow(kChanges[1 + i], &world, World(context, scaled(scene, kFactors[i])), times(goal, kFactors[i]));
    const World dark(context, scaled(scene, kOff));
    follow(kChanges[5], &dark, world, goal);
    if (hasSun(scene)) {
        const World moved = withSunMoved(context, scene);
        follow(kChanges[6], &world, moved, converged(context, moved, desc, points));
    }
    return result;
} catch (const std::runtime_error& error) {
    return fail(ErrorCode::outOfMemory, error.what());
}

std::string motionTable(const std::vector<MotionResult>& rows) {
    std::string table =
        "\n### Light in motion\n\n"
        "Only `update()`, and the field is not told of the change. Settled: mean irradiance at surface points after "
        "300 updates over that of `converge`. Flicker: temporal standard deviation over mean, mean and 95th percentile "
        "of the points, over 60 updates. Then the updates until no more than a tenth of a change is left, for good.\n\n"
        "| scene | rules | probes | rays | settled | flicker | 95th |";
    for (const char* change : kChanges) table += fmt::format(" {} |", change);
    table += "\n|---|---|---:|---:|---:|---:|---:|";
    for (std::size_t i = 0; i < kChanges.size(); ++i) table += "---:|";
    table += "\n";
    std::string missing;
    for (const MotionResult& row : rows) {
        if (!row.missing.empty()) {
            missing += fmt::format("\nNot measured: {} ({}).\n", row.scene, row.missing);
            continue;
        }
        table += fmt::format("| {} | {} | {} | {} | {:.3f} | {:.2f} % | {:.2f} % |", row.scene,
                             row.rules == FieldRules::paper ? "paper" : "measured", row.probes, row.rays, row.settled,
                             100 * row.flicker.mean, 100 * row.flicker.high);
        for (const char* change : kChanges) table += fmt::format(" {} |", cell(row, change));
        table += "\n";
    }
    return table + missing;
}

}  // namespace probegi::accuracy

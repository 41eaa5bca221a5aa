#include "motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <random>
#include <stdexcept>

namespace probegi::accuracy {

namespace {

constexpr int kPoints = 2000;
constexpr int kStillUpdates = 60;     ///< over which flicker is taken
constexpr int kReactionHorizon = 60;  ///< updates that are watched after a change
constexpr float kWithin = 0.1f;       ///< of the change
constexpr double kDark = 0.01;        ///< share of the mean light below which places count as one that has so much
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

/// A value, or an exception with the error's sentence for main() to print.
template <class T>
T must(Result<T> result) {
    if (!result) throw std::runtime_error(result.error().message);
    if constexpr (!std::is_void_v<T>) return std::move(*result);
}

/// What random rays from random places meet: surfaces that somebody in the scene can see.
std::vector<FieldQuery> surfacePoints(const World& world) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> uniform(0.0f, 1.0f);
    std::vector<Ray> rays;
    for (int i = 0; i < 8 * kPoints; ++i) {
        const Bounds& b = world.pose.bounds;
        const glm::vec3 origin = b.lower + glm::vec3(uniform(random), uniform(random), uniform(random)) * b.size();
        const float z = 2 * uniform(random) - 1, phi = 6.2831853f * uniform(random), r = std::sqrt(1 - z * z);
        rays.push_back({origin, 0, {r * std::cos(phi), r * std::sin(phi), z}, 1e30f});
    }
    std::vector<Hit> hits(rays.size());
    std::vector<Surface> surfaces(rays.size());
    must(world.tracer->closestHits(rays, hits));
    must(world.tracer->surfaces(rays, hits, surfaces));
    std::vector<FieldQuery> points;
    for (std::size_t i = 0; i < rays.size() && points.size() < kPoints; ++i)
        if (hits[i].valid() && !surfaces[i].backface)
            points.push_back({surfaces[i].position, surfaces[i].shadingNormal, -rays[i].direction});
    return points;
}

/// The field at the points.
class Watcher {
public:
    explicit Watcher(std::vector<FieldQuery> points) : m_points(std::move(points)), m_irradiance(m_points.size()) {}

    /// Mean over the channels of the irradiance at each point.
    std::vector<double> look(const Field& field) {
        if (const auto asked = field.irradiance(m_points, m_irradiance); !asked)
            throw std::runtime_error(asked.error().message);
        std::vector<double> light;
        for (const glm::vec3& e : m_irradiance) light.push_back((double(e.x) + e.y + e.z) / 3);
        return light;
    }

private:
    std::vector<FieldQuery> m_points;
    std::vector<glm::vec3> m_irradiance;
};

double meanOf(const std::vector<double>& light) {
    return std::accumulate(light.begin(), light.end(), 0.0) / double(light.size());
}

std::vector<double> converged(const Context& context, const World& world, const FieldDesc& desc, Watcher& watcher) {
    Field field = must(Field::create(context, desc));
    must(field.converge(*world.tracer, world.lighting, kTruthTolerance, kTruthUpdates));
    return watcher.look(field);
}

void measureFlicker(Field& field, const World& world, Watcher& watcher, MotionResult& result) {
    std::vector<double> sum, square;
    for (int k = 0; k < kStillUpdates; ++k) {
        must(field.update(*world.tracer, world.lighting));
        const std::vector<double> light = watcher.look(field);
        sum.resize(light.size());
        square.resize(light.size());
        for (std::size_t i = 0; i < light.size(); ++i) {
            sum[i] += light[i];
            square[i] += light[i] * light[i];
        }
    }
    // Where there is next to no light, a ratio means nothing.
    const double least = kDark * meanOf(sum) / kStillUpdates;
    std::vector<double> shares;
    for (std::size_t i = 0; i < sum.size(); ++i) {
        const double mean = sum[i] / kStillUpdates;
        if (mean > least) shares.push_back(std::sqrt(std::max(0.0, square[i] / kStillUpdates - mean * mean)) / mean);
    }
    if (shares.empty()) return;
    std::sort(shares.begin(), shares.end());
    result.flicker = std::accumulate(shares.begin(), shares.end(), 0.0) / double(shares.size());
    result.flicker95 = shares[shares.size() * 95 / 100];
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

/// How much of the way from `start` to `goal` is left: 1 at the start, 0 at the goal; every point counts by its own
/// light.
double shareLeft(const std::vector<double>& now, const std::vector<double>& start, const std::vector<double>& goal) {
    const double least = kDark * std::max(meanOf(start), meanOf(goal));
    double left = 0, whole = 0;
    for (std::size_t i = 0; i < now.size(); ++i) {
        const double level = std::max({start[i], goal[i], least});
        const double way = (start[i] - goal[i]) / level;
        left += way * (now[i] - goal[i]) / level;
        whole += way * way;
    }
    return left / whole;
}

/// Settled in `before` (null: new); updates in `after` until no more than a tenth of the way is left, nor ever again.
int updatesToFollow(const Context& context, const World* before, const World& after, const std::vector<double>& goal,
                    const FieldDesc& desc, Watcher& watcher) {
    Field field = must(Field::create(context, desc));
    std::vector<double> start(goal.size(), 0.0);
    if (before) {
        for (int k = 0; k < kStillUpdates; ++k) must(field.update(*before->tracer, before->lighting));
        start = watcher.look(field);
    }
    int lastOutside = 0;
    for (int k = 1; k <= kReactionHorizon; ++k) {
        must(field.update(*after.tracer, after.lighting));
        if (!(std::abs(shareLeft(watcher.look(field), start, goal)) <= kWithin)) lastOutside = k;
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
    Watcher watcher(surfacePoints(world));
    MotionResult result{name, desc.rules, probeCount(desc), desc.raysPerProbe, 0, 0, 0, {}, {}};
    Field field = must(Field::create(context, desc));
    for (int k = 0; k < kSettledUpdates - kStillUpdates; ++k) must(field.update(*world.tracer, world.lighting));
    measureFlicker(field, world, watcher, result);
    const std::vector<double> goal = converged(context, world, desc, watcher);
    result.settled = meanOf(watcher.look(field)) / meanOf(goal);
    if (scope == MotionScope::still) return result;

    const auto follow = [&](const char* change, const World* before, const World& after,
                            const std::vector<double>& to) {
        result.reactions.push_back({change, updatesToFollow(context, before, after, to, desc, watcher)});
    };
    follow(kChanges[0], nullptr, world, goal);
    // Light is linear: scaled lamps have scaled goals.
    for (std::size_t i = 0; i < kFactors.size(); ++i)
        follow(kChanges[1 + i], &world, World(context, scaled(scene, kFactors[i])), times(goal, kFactors[i]));
    const World dark(context, scaled(scene, kOff));
    follow(kChanges[5], &dark, world, goal);
    if (hasSun(scene)) {
        const World moved = withSunMoved(context, scene);
        follow(kChanges[6], &world, moved, converged(context, moved, desc, watcher));
    }
    return result;
} catch (const std::runtime_error& error) {
    return fail(ErrorCode::outOfMemory, error.what());
}

std::string motionTable(const std::vector<MotionResult>& rows) {
    std::string table =
        "\n### Light in motion\n\n"
        "Only `update()`, without a word to the field. Settled: mean irradiance at surface points after 300 updates "
        "over "
        "that of `converge`. Flicker: temporal standard deviation over mean, mean and 95th percentile of the points, "
        "over "
        "60 updates. Then updates after which no more than a tenth of a change is left, nor ever again.\n\n"
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
                             100 * row.flicker, 100 * row.flicker95);
        for (const char* change : kChanges) table += fmt::format(" {} |", cell(row, change));
        table += "\n";
    }
    return table + missing;
}

}  // namespace probegi::accuracy

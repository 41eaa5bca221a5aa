#include "motion.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <numeric>
#include <random>

namespace probegi::accuracy {

namespace {

constexpr int kPoints = 2000;
constexpr int kStillUpdates = 60;     ///< over which flicker is taken
constexpr int kReactionHorizon = 60;  ///< updates that are watched after a change
constexpr float kWithin = 0.1f;       ///< of the change
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
    world.tracer->closestHits(rays, hits);
    world.tracer->surfaces(rays, hits, surfaces);
    std::vector<FieldQuery> points;
    for (std::size_t i = 0; i < rays.size() && points.size() < kPoints; ++i)
        if (hits[i].valid() && !surfaces[i].backface)
            points.push_back({surfaces[i].position, surfaces[i].shadingNormal, -rays[i].direction});
    return points;
}

class Watcher {
public:
    explicit Watcher(std::vector<FieldQuery> points) : m_points(std::move(points)), m_irradiance(m_points.size()) {}

    /// Luminance, about, of the irradiance at each point.
    const std::vector<glm::vec3>& look(const Field& field) {
        (void)field.irradiance(m_points, m_irradiance);
        return m_irradiance;
    }
    double mean(const Field& field) {
        double sum = 0;
        for (const glm::vec3& e : look(field)) sum += (double(e.x) + e.y + e.z) / 3;
        return sum / double(m_points.size());
    }
    std::size_t size() const { return m_points.size(); }

private:
    std::vector<FieldQuery> m_points;
    std::vector<glm::vec3> m_irradiance;
};

double convergedMean(const Context& context, const World& world, const FieldDesc& desc, Watcher& watcher) {
    Field field = Field::create(context, desc).value();
    field.converge(*world.tracer, world.lighting, kTruthTolerance, kTruthUpdates).value();
    return watcher.mean(field);
}

void measureFlicker(Field& field, const World& world, Watcher& watcher, MotionResult& result) {
    std::vector<double> sum(watcher.size()), square(watcher.size());
    for (int k = 0; k < kStillUpdates; ++k) {
        field.update(*world.tracer, world.lighting).value();
        const auto& e = watcher.look(field);
        for (std::size_t i = 0; i < e.size(); ++i) {
            const double value = (double(e[i].x) + e[i].y + e[i].z) / 3;
            sum[i] += value;
            square[i] += value * value;
        }
    }
    std::vector<double> shares;
    for (std::size_t i = 0; i < sum.size(); ++i) {
        const double mean = sum[i] / kStillUpdates;
        if (mean > 0) shares.push_back(std::sqrt(std::max(0.0, square[i] / kStillUpdates - mean * mean)) / mean);
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

/// Settled in `before`; updates in `after` until the mean stays near its goal.
int updatesToFollow(const Context& context, const World* before, const World& after, double goal, const FieldDesc& desc,
                    Watcher& watcher) {
    Field field = Field::create(context, desc).value();
    double start = 0;
    if (before) {
        for (int k = 0; k < kStillUpdates; ++k) field.update(*before->tracer, before->lighting).value();
        start = watcher.mean(field);
    }
    int lastOutside = 0;
    for (int k = 1; k <= kReactionHorizon; ++k) {
        field.update(*after.tracer, after.lighting).value();
        if (!(std::abs(watcher.mean(field) - goal) <= kWithin * std::abs(goal - start))) lastOutside = k;
    }
    return lastOutside < kReactionHorizon ? lastOutside + 1 : -1;
}

}  // namespace

Result<MotionResult> measureMotion(const Context& context, const std::string& name, const Scene& scene,
                                   const GridDesc& grid, const FieldDesc& settings, bool reactions) {
    FieldDesc desc = settings;
    desc.grid = grid;
    const World world(context, scene);
    Watcher watcher(surfacePoints(world));
    MotionResult result{name, desc.raysPerProbe, 0, 0, 0, {}};
    Field field = Field::create(context, desc).value();
    for (int k = 0; k < kSettledUpdates - kStillUpdates; ++k) field.update(*world.tracer, world.lighting).value();
    measureFlicker(field, world, watcher, result);
    // Light is linear: scaled lamps have scaled goals.
    const double goal = convergedMean(context, world, desc, watcher);
    result.settled = watcher.mean(field) / goal;
    if (!reactions) return result;

    result.reactions.push_back({"from empty", updatesToFollow(context, nullptr, world, goal, desc, watcher)});
    for (const auto& [change, factor] : {std::pair("x0.1", 0.1f), {"x0.8", 0.8f}, {"x10", 10.0f}, {"off", 1e-6f}}) {
        const World after(context, scaled(scene, factor));
        result.reactions.push_back({change, updatesToFollow(context, &world, after, factor * goal, desc, watcher)});
    }
    const World dark(context, scaled(scene, 1e-6f));
    result.reactions.push_back({"on", updatesToFollow(context, &dark, world, goal, desc, watcher)});
    if (hasSun(scene)) {
        const World moved = withSunMoved(context, scene);
        const double movedGoal = convergedMean(context, moved, desc, watcher);
        result.reactions.push_back({"sun jump", updatesToFollow(context, &world, moved, movedGoal, desc, watcher)});
    }
    return result;
}

}  // namespace probegi::accuracy

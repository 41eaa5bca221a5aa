// Primitives by each way to trace them, one thread, against Embree on triangles: the columns of SDFDDGI's Table 3
// beside exact intersection. Boxes in the built-in atrium's bounds; origins outside of them.
#include <benchmark/benchmark.h>

#include <glm/gtc/quaternion.hpp>
#include <memory>
#include <random>

#include "core/float_mode.h"
#include "cpu/sdf_lanes.h"
#include "kernels/sdf/cluster.h"
#include "probegi/builtin_scenes.h"
#include "sdf/clusters.h"
#include "sdf/solid.h"

namespace probegi::kernels {
namespace {

SdfClusters clustered;

SdfSolid sdfSolid(int number) {
    return clustered.solids[std::size_t(number)];
}
SdfCluster sdfCluster(int number) {
    return clustered.clusters[std::size_t(number)];
}

}  // namespace
}  // namespace probegi::kernels

#include "kernels/sdf/sphere_trace.h"

namespace probegi::bench {
namespace {

constexpr std::size_t kRays = 1152;  // as in the tasks of an update
constexpr std::size_t kTogether = 16;

enum class Coherence { none, direction };

class World {
public:
    World(int count, bool turned, Coherence coherence) : m_bounds(poseAt(scene).bounds) {
        for (int i = 0; i < count; ++i) solids.push_back(makeSolid(randomBox(turned)));
        Ray first;
        while (rays.size() < kRays) {
            Ray ray;
            ray.far = glm::length(m_bounds.size());
            ray.origin = anywhere();
            if (distanceTo(ray.origin) < 0.05f) continue;
            ray.direction = direction();
            if (coherence == Coherence::direction && rays.size() % kTogether != 0) {
                ray.direction = first.direction;
                ray.origin = first.origin + 0.4f * glm::vec3(between(-1, 1), between(-1, 1), between(-1, 1));
            }
            if (rays.size() % kTogether == 0) first = ray;
            rays.push_back(ray);
        }
        hits.resize(rays.size());
    }

    Scene scene = *makeBuiltinScene("atrium");
    std::vector<kernels::SdfSolid> solids;
    std::vector<Ray> rays;
    std::vector<Hit> hits;

private:
    float between(float lower, float upper) {
        return lower + (upper - lower) * float(m_random() >> 8) * (1.0f / 16777216.0f);
    }
    glm::vec3 anywhere() {
        const float x = between(0, 1), y = between(0, 1), z = between(0, 1);
        return m_bounds.lower + m_bounds.size() * glm::vec3(x, y, z);
    }
    glm::vec3 direction() {
        for (;;) {
            const float x = between(-1, 1), y = between(-1, 1), z = between(-1, 1);
            const glm::vec3 v(x, y, z);
            if (glm::dot(v, v) > 0.01f && glm::dot(v, v) < 1) return glm::normalize(v);
        }
    }
    SdfPrimitive randomBox(bool turned) {
        SdfPrimitive box;
        box.centre = anywhere();
        box.halfSize = {between(0.1f, 1.5f), between(0.1f, 1.5f), between(0.1f, 1.5f)};
        if (turned) box.rotation = glm::angleAxis(between(0, 3), direction());
        return box;
    }
    float distanceTo(glm::vec3 point) const {
        float nearest = kernels::kSdfFar;
        for (const kernels::SdfSolid& solid : solids) nearest = std::min(nearest, kernels::sdfDistance(solid, point));
        return nearest;
    }

    std::mt19937 m_random{3};
    Bounds m_bounds;
};

void count(benchmark::State& state) {
    state.counters["rays/s"] =
        benchmark::Counter(double(kRays) * double(state.iterations()), benchmark::Counter::kIsRate);
}

void exact(benchmark::State& state, bool turned, Coherence coherence) {
    World world(int(state.range(0)), turned, coherence);
    const SdfLanes lanes(world.solids);
    const FloatMode floatMode;
    for (auto _ : state) {
        sdfClosestHits(lanes, world.rays, world.hits);
        benchmark::ClobberMemory();
    }
    count(state);
}

void occlusion(benchmark::State& state) {
    World world(int(state.range(0)), false, Coherence::none);
    const SdfLanes lanes(world.solids);
    std::vector<std::uint8_t> blocked(world.rays.size());
    const FloatMode floatMode;
    for (auto _ : state) {
        sdfOccluded(lanes, world.rays, blocked);
        benchmark::ClobberMemory();
    }
    count(state);
}

void sphereTracing(benchmark::State& state, bool clusters) {
    World world(int(state.range(0)), false, Coherence::none);
    kernels::clustered = clusters ? clusterSolids(world.solids) : oneCluster(world.solids);
    const FloatMode floatMode;
    for (auto _ : state)
        for (const Ray& ray : world.rays)
            benchmark::DoNotOptimize(kernels::sdfSphereTraced(ray.origin, 0, ray.direction, ray.far,
                                                              int(kernels::clustered.clusters.size())));
    count(state);
}

void embree(benchmark::State& state, Coherence coherence) {
    World world(1, false, coherence);
    const auto tracer = *makeEmbreeTracer(*Context::create({.threads = 1}), world.scene, poseAt(world.scene));
    for (auto _ : state) {
        tracer->closestHits(world.rays, world.hits).value();
        benchmark::ClobberMemory();
    }
    count(state);
}

#define NUMBERS Arg(43)->Arg(64)->Arg(92)->Arg(130)->Arg(200)
BENCHMARK_CAPTURE(sphereTracing, all, false)->NUMBERS;
BENCHMARK_CAPTURE(sphereTracing, clusters, true)->NUMBERS;
BENCHMARK_CAPTURE(exact, scattered, false, Coherence::none)->NUMBERS;
BENCHMARK_CAPTURE(exact, scatteredTurned, true, Coherence::none)->NUMBERS;
BENCHMARK_CAPTURE(exact, asUpdates, false, Coherence::direction)->NUMBERS;
BENCHMARK_CAPTURE(exact, asUpdatesTurned, true, Coherence::direction)->NUMBERS;
BENCHMARK(occlusion)->NUMBERS;
BENCHMARK_CAPTURE(embree, scattered, Coherence::none);
BENCHMARK_CAPTURE(embree, asUpdates, Coherence::direction);

}  // namespace
}  // namespace probegi::bench

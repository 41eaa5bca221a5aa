// Costs of a ray besides its traversal, in the built-in atrium with the rays of a probe volume.
#include <benchmark/benchmark.h>

#include "kernels/trace/ray_set.h"
#include "probegi/builtin_scenes.h"
#include "probegi/field.h"
#include "probegi/tracer.h"

namespace probegi::bench {
namespace {

constexpr std::size_t kBatch = 1152;  // as in the tasks of an update

struct Atrium {
    Atrium() {
        tracer = *makeEmbreeTracer(*Context::create({.threads = 2}), scene, pose);
        const VolumeDesc grid = *placeVolume(pose.bounds, {{12, 8, 12}});
        for (int probe = 0; probe < probeCount(grid); ++probe)
            for (std::uint32_t i = 0; i < 144; ++i)
                rays.push_back({probePosition(grid, probe), 0.0f, kernels::sphericalFibonacci(i, 144)});
        hits.resize(rays.size());
        tracer->closestHits(rays, hits).value();
    }

    Scene scene = *makeBuiltinScene("atrium");
    ScenePose pose = poseAt(scene);
    std::unique_ptr<Tracer> tracer;
    std::vector<Ray> rays;
    std::vector<Hit> hits;
};

template <class Body>
void inBatches(benchmark::State& state, const Atrium& atrium, const Body& body) {
    for (auto _ : state)
        for (std::size_t i = 0; i < atrium.rays.size(); i += kBatch) {
            body(i, std::min(kBatch, atrium.rays.size() - i));
            benchmark::ClobberMemory();
        }
    state.counters["a ray"] = benchmark::Counter(double(atrium.rays.size()) * double(state.iterations()),
                                                 benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void closestHits(benchmark::State& state) {
    const Atrium atrium;
    std::vector<Hit> hits(kBatch);
    inBatches(state, atrium, [&](std::size_t i, std::size_t n) {
        atrium.tracer->closestHits(std::span(atrium.rays).subspan(i, n), std::span(hits).first(n)).value();
    });
}

void occluded(benchmark::State& state) {
    const Atrium atrium;
    std::vector<std::uint8_t> blocked(kBatch);
    inBatches(state, atrium, [&](std::size_t i, std::size_t n) {
        atrium.tracer->occluded(std::span(atrium.rays).subspan(i, n), std::span(blocked).first(n)).value();
    });
}

void surfaces(benchmark::State& state) {
    const Atrium atrium;
    std::vector<Surface> surfaces(kBatch);
    inBatches(state, atrium, [&](std::size_t i, std::size_t n) {
        atrium.tracer
            ->surfaces(std::span(atrium.rays).subspan(i, n), std::span(atrium.hits).subspan(i, n),
                       std::span(surfaces).first(n))
            .value();
    });
}

BENCHMARK(closestHits)->Unit(benchmark::kMillisecond);
BENCHMARK(occluded)->Unit(benchmark::kMillisecond);
BENCHMARK(surfaces)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace probegi::bench

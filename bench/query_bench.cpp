// The query by leak guard and by order of the points, and the gain from SIMD: several points at a time against one.
#include <benchmark/benchmark.h>

#include <cstdlib>
#include <glm/common.hpp>

#include "room_field.h"
#include "scalar_query.h"

namespace probegi::bench {
namespace {

constexpr int kWidth = 480, kHeight = 270;

using Query = void (*)(const FieldView&, std::span<const FieldQuery>, std::span<glm::vec3>);

void query(benchmark::State& state, LeakGuard guard, bool coherent, Query function) {
    const RoomField field(guard);
    std::vector<FieldQuery> points = field.screenPoints(kWidth, kHeight);
    if (!coherent) points = shuffled(std::move(points));
    std::vector<glm::vec3> out(points.size());
    for (auto _ : state) {
        function(field.view(), points, out);
        benchmark::ClobberMemory();
    }
    state.counters["a point"] = benchmark::Counter(double(points.size()) * double(state.iterations()),
                                                   benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

// Checks that the baseline computes the same.
void sameAnswer(benchmark::State& state) {
    const RoomField field(LeakGuard::moments);
    const std::vector<FieldQuery> points = field.screenPoints(kWidth, kHeight);
    std::vector<glm::vec3> wide(points.size()), scalar(points.size());
    float worst = 0;
    for (auto _ : state) {
        queryIrradiance(field.view(), points, wide);
        queryScalar(field.view(), points, scalar);
        for (std::size_t i = 0; i < points.size(); ++i) {
            const glm::vec3 difference = glm::abs(wide[i] - scalar[i]) / glm::max(scalar[i], 1e-6f);
            worst = std::max({worst, difference.x, difference.y, difference.z});
        }
    }
    state.counters["worst relative difference"] = double(worst);
    if (!(worst < 1e-3f)) state.SkipWithError("the scalar query gives another answer than the SIMD one");
}

BENCHMARK_CAPTURE(query, none_coherent, LeakGuard::none, true, queryIrradiance)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(query, none_incoherent, LeakGuard::none, false, queryIrradiance)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(query, moments_coherent, LeakGuard::moments, true, queryIrradiance)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(query, moments_incoherent, LeakGuard::moments, false, queryIrradiance)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(query, moments_coherent_scalar, LeakGuard::moments, true, queryScalar)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(query, moments_incoherent_scalar, LeakGuard::moments, false, queryScalar)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(sameAnswer)->Iterations(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace probegi::bench

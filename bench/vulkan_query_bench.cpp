// The query of a picture's points on the GPU against two baselines: trilinear interpolation, which leaks, and the eight
// fetches with visibility of the DDGI paper. The three alternate; times are GPU timestamps.
#include <benchmark/benchmark.h>

#include <glm/common.hpp>

#include "bench_shaders.h"
#include "kernels/abi/gpu_passes.h"
#include "vulkan/device/errors.h"
#include "vulkan/device/staging.h"
#include "vulkan_room.h"

namespace probegi::bench {
namespace {

using namespace vulkan;

// Queries and results in GPU memory.
struct Points {
    Points(const Device& device, const std::vector<FieldQuery>& queries)
        : count(queries.size()),
          out(device.impl(), "irradiance", bytes(), kAddressed | vk::BufferUsageFlagBits::eTransferSrc),
          back(device.impl(), "readback", bytes(), vk::BufferUsageFlagBits::eTransferDst, MemoryUse::readback) {
        Staging staging;
        in = staging.add(device.impl(), "queries", queries);
        staging.fill(device.impl());
        submitAndWait(device, [&](const Recorder& recorder) { staging.record(recorder); });
    }
    std::size_t bytes() const { return count * sizeof(glm::vec3); }

    std::size_t count;
    Buffer in, out, back;
};

enum Way { kLibrary, kVisibility, kTrilinear, kWays };

class QueryBench {
public:
    QueryBench(VulkanRoom& room, const std::vector<FieldQuery>& queries)
        : m_room(room),
          m_points(room.device(), queries),
          m_trilinear(room.device(), k_query_trilinear),
          m_visibility(room.device(), k_query_visibility) {
        room.update();
    }

    double milliseconds(Way way) {
        return sumOf(
            m_room.run([&](const Recorder& recorder, Profiler& profiler) { record(recorder, profiler, way); }));
    }
    std::vector<glm::vec3> answers(Way way) {
        milliseconds(way);
        submitAndWait(m_room.device(), [&](const Recorder& recorder) {
            recorder.copy(m_points.out, m_points.back, m_points.bytes());
            recorder.transferToHost();
        });
        const auto values = m_points.back.mapped<glm::vec3>();
        return {values.begin(), values.end()};
    }

private:
    void record(const Recorder& recorder, Profiler& profiler, Way way) {
        const auto count = std::uint32_t(m_points.count);
        if (way == kLibrary)
            return m_room.volume().recordQuery(recorder, m_room.frame().settings, m_points.in.address(),
                                               m_points.out.address(), count, &profiler);
        const PassScope scope(recorder, m_room.device().impl(), &profiler, "query");
        recorder.bindVolume(m_room.volume().set());
        recorder.push(kernels::QueryPush{.queries = packAddress(m_points.in.address()),
                                         .irradiance = packAddress(m_points.out.address()),
                                         .count = count});
        (way == kTrilinear ? m_trilinear : m_visibility).record(recorder, count);
    }

    VulkanRoom& m_room;
    Points m_points;
    BenchPass m_trilinear, m_visibility;
};

double worstDifference(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b) {
    float worst = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            const float difference = std::abs(a[i][c] - b[i][c]) / std::max(std::abs(a[i][c]), 1e-6f);
            worst = std::max(worst, difference < 1e9f ? difference : 1e9f);  // NaN counts as a difference
        }
    return double(worst);
}

// In uniform light, leaks make no difference.
double worstDifferenceInFurnace(const RoomField& field) {
    const std::vector<RayDatum> same(field.rayData().size(), {glm::vec3(0.7f), 1.0f});
    VulkanRoom room(field, same);
    QueryBench bench(room, field.screenPoints(64, 64));
    return worstDifference(bench.answers(kLibrary), bench.answers(kTrilinear));
}

void measure(benchmark::State& state) {
    const RoomField field(LeakGuard::moments);
    VulkanRoom room(field, field.rayData());
    QueryBench bench(room, field.screenPoints(1920, 1080));
    if (!(worstDifference(bench.answers(kLibrary), bench.answers(kVisibility)) < 1e-3))
        return state.SkipWithError("the query with visibility gives another answer than the library");
    if (!(worstDifferenceInFurnace(field) < 0.01))
        return state.SkipWithError("trilinear interpolation gives another answer than the library in even light");
    std::vector<double> times[kWays], ratios[kWays];
    for (auto _ : state) {
        for (const Way way : {kLibrary, kVisibility, kTrilinear}) {
            times[way].push_back(bench.milliseconds(way));
            ratios[way].push_back(times[kLibrary].back() / times[way].back());
        }
        state.SetIterationTime(times[kLibrary].back() * 1e-3);
    }
    state.counters["query_ms"] = median(times[kLibrary]);
    state.counters["visibility_ms"] = median(times[kVisibility]);
    state.counters["trilinear_ms"] = median(times[kTrilinear]);
    state.counters["query/visibility"] = median(ratios[kVisibility]);
    state.counters["query/trilinear"] = median(ratios[kTrilinear]);
}

void vulkanQuery(benchmark::State& state) {
    if (const auto done = guarded("measuring the query", [&] { measure(state); }); !done)
        state.SkipWithError(done.error().message.c_str());
}

BENCHMARK(vulkanQuery)->Iterations(5)->UseManualTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace probegi::bench

// The blend of all probes on the GPU against its baseline, a thread per texel that computes its own weights
// (shaders/blend_direct.comp). Times are GPU timestamps. Runs alternate, so that the ratio holds on a busy machine.
#include <benchmark/benchmark.h>

#include "bench_shaders.h"
#include "kernels/abi/gpu_passes.h"
#include "vulkan/device/errors.h"
#include "vulkan_room.h"

namespace probegi::bench {
namespace {

using namespace vulkan;

struct DirectPush {
    kernels::BlendPush blend;
    glm::uvec2 directions;
    float visibilityExponent;
};

void recordDirect(const Recorder& recorder, VulkanRoom& room, const BenchPass& pass, Profiler& profiler) {
    const UpdateFrame frame = room.frame();
    const FieldLayout& layout = room.volume().layout();
    const PassScope scope(recorder, room.device().impl(), &profiler, "direct");
    recorder.bindVolume(room.volume().set());
    DirectPush push{};
    push.blend.rayData = packAddress(room.rayData());
    push.blend.rays = int(layout.rays);
    push.blend.irradianceHysteresis = frame.hysteresis.irradiance;
    push.blend.visibilityHysteresis = frame.hysteresis.visibility;
    push.blend.significantChange = frame.settings.significantChange;
    push.blend.newDistribution = frame.settings.newDistribution;
    push.blend.ditherSeed = frame.ditherSeed;
    push.directions = packAddress(room.directions());
    push.visibilityExponent = frame.settings.visibilityExponent;
    recorder.push(push);
    pass.record(recorder, layout.probes * (layout.irradianceTexels + layout.visibilityTexels));
}

// Greatest difference between two volumes, in steps of the storage format. Includes borders, which look-ups read too.
struct Difference {
    float irradiance = 0, visibility = 0;
};

Difference differenceOf(const FieldPasses& a, const FieldPasses& b) {
    const FieldMirror one(a), other(b);
    Difference worst;
    for (int probe = 0; probe < int(a.layout().probes); ++probe) {
        const int irradiance = a.desc().irradianceTexels, visibility = a.desc().visibilityTexels;
        for (int y = -1; y <= irradiance; ++y)
            for (int x = -1; x <= irradiance; ++x) {
                const glm::vec3 p = one.irradianceTexel(probe, {x, y}), q = other.irradianceTexel(probe, {x, y});
                for (int c = 0; c < 3; ++c)  // a half float's step is 2^-10 of a power of two
                    worst.irradiance = std::max(worst.irradiance, 1024 * std::abs(p[c] - q[c]) / std::max(p[c], 1e-4f));
            }
        for (int y = -1; y <= visibility; ++y)
            for (int x = -1; x <= visibility; ++x) {
                const glm::vec2 d = one.visibilityTexel(probe, {x, y}) - other.visibilityTexel(probe, {x, y});
                worst.visibility = std::max({worst.visibility, 65535 * std::abs(d.x), 65535 * std::abs(d.y)});
            }
    }
    return worst;
}

void measure(benchmark::State& state) {
    const RoomField field(LeakGuard::moments, {22, 14, 32}, int(state.range(0)));
    VulkanRoom room(field, field.rayData()), baseline(field, field.rayData());
    const BenchPass direct(baseline.device(), k_blend_direct);
    std::vector<double> products, directs, ratios, parts[3];
    const auto turn = [&] {
        const std::vector<PassTime> passes = room.update();
        const double other = sumOf(baseline.run(
            [&](const Recorder& recorder, Profiler& profiler) { recordDirect(recorder, baseline, direct, profiler); }));
        for (std::size_t i = 0; i < 3; ++i) parts[i].push_back(passes.at(i).milliseconds);
        products.push_back(sumOf(passes));
        directs.push_back(other);
        ratios.push_back(other / products.back());
    };
    turn();
    const Difference difference = differenceOf(room.volume(), baseline.volume());
    if (difference.irradiance > 1.01f || difference.visibility > 1.01f)
        return state.SkipWithError("the direct form stores other texels than the library");
    for (auto* values : {&products, &directs, &ratios, &parts[0], &parts[1], &parts[2]}) values->clear();
    for (auto _ : state) {
        turn();
        state.SetIterationTime(products.back() * 1e-3);
    }
    state.counters["weights_ms"] = median(parts[0]);
    state.counters["irradiance_ms"] = median(parts[1]);
    state.counters["visibility_ms"] = median(parts[2]);
    state.counters["blend_ms"] = median(products);
    state.counters["direct_ms"] = median(directs);
    state.counters["direct/blend"] = median(ratios);
}

void vulkanBlend(benchmark::State& state) {
    if (const auto done = guarded("measuring the blend", [&] { measure(state); }); !done)
        state.SkipWithError(done.error().message.c_str());
}

BENCHMARK(vulkanBlend)->Arg(144)->Iterations(5)->UseManualTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace probegi::bench

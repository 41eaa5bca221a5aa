// The blend of all probes as a matrix product, its parts, and the direct loop over texels and rays as a baseline.
#include <benchmark/benchmark.h>

#include <glm/common.hpp>

#include "cpu/matrix_product.h"
#include "field/layout.h"
#include "kernels/blend/probe_blend.h"
#include "kernels/probe/octahedral_texel.h"
#include "room_field.h"

namespace probegi::bench {
namespace {

constexpr glm::ivec3 kCounts{8, 8, 8};  // the direct loop is slow

benchmark::Counter perProbe(const RoomField& field, const benchmark::State& state) {
    return {double(field.layout().probes) * double(state.iterations()),
            benchmark::Counter::kIsRate | benchmark::Counter::kInvert};
}

void blendAll(benchmark::State& state) {
    RoomField field(LeakGuard::moments, kCounts, int(state.range(0)));
    BlendWeights weights;
    makeBlendWeights(field.context(), field.desc(), field.settings().visibilityExponent, field.directions(), weights);
    for (auto _ : state) {
        blendProbes(field.context(), field.desc(), makeVolumes(field.desc()), field.settings(), weights,
                    field.rayData(), {field.tasks(), {0.97f, 0.97f}}, field.storage());
        benchmark::ClobberMemory();
    }
    state.counters["a probe"] = perProbe(field, state);
}

// Computed once per frame, for all probes.
void frameWeights(benchmark::State& state) {
    RoomField field(LeakGuard::moments, {2, 2, 2}, int(state.range(0)));
    BlendWeights weights;
    for (auto _ : state) {
        makeBlendWeights(field.context(), field.desc(), field.settings().visibilityExponent, field.directions(),
                         weights);
        benchmark::ClobberMemory();
    }
}

// The two products for 32 probes, without gathering and storing.
void products(benchmark::State& state) {
    constexpr std::size_t kProbes = 32;
    RoomField field(LeakGuard::moments, {2, 2, 2}, int(state.range(0)));
    BlendWeights weights;
    makeBlendWeights(field.context(), field.desc(), field.settings().visibilityExponent, field.directions(), weights);
    Matrix radiance, distance, irradiance, visibility;
    radiance.resize(3 * kProbes, field.layout().rays);
    distance.resize(2 * kProbes, field.layout().rays);
    for (float& value : radiance.values) value = 0.5f;
    for (float& value : distance.values) value = 0.5f;
    for (auto _ : state) {
        multiply(radiance, weights.irradiance, irradiance);
        multiply(distance, weights.visibility, visibility);
        benchmark::ClobberMemory();
    }
    const auto& layout = field.layout();
    const double multiplications =
        double(layout.rays) * double(3 * layout.irradianceTexels + 2 * layout.visibilityTexels);
    const double done = double(kProbes) * double(state.iterations());
    state.counters["a probe"] = benchmark::Counter(done, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
    state.counters["FLOP/s"] = benchmark::Counter(2 * multiplications * done, benchmark::Counter::kIsRate);
}

// Eq. 1 as in the paper: each texel loops over the rays and computes their weights on the fly.
template <class Mean, class Weight, class Value>
void directMeans(std::span<const glm::vec3> directions, int size, std::span<Mean> means, const Weight& weight,
                 const Value& value) {
    for (int texel = 0; texel < size * size; ++texel) {
        const glm::vec3 n = kernels::octTexelDirection(texel % size, texel / size, size);
        Mean sum(0.0f);
        float weights = 0;
        for (std::size_t ray = 0; ray < directions.size(); ++ray) {
            const float w = weight(n, directions[ray]);
            sum += w * value(ray);
            weights += w;
        }
        means[std::size_t(texel)] = sum / std::max(weights, 1e-20f);
    }
}

// The baseline of the products, without hysteresis and storage.
void directLoop(benchmark::State& state) {
    const RoomField field(LeakGuard::moments, kCounts, int(state.range(0)));
    const FieldDesc& desc = field.desc();
    const auto directions = field.directions();
    std::vector<glm::vec3> irradiance(field.layout().irradianceTexels);
    std::vector<glm::vec2> visibility(field.layout().visibilityTexels);
    const auto cosine = [](glm::vec3 n, glm::vec3 w) { return kernels::irradianceWeight(n, w); };
    const auto power = [&](glm::vec3 n, glm::vec3 w) {
        return kernels::visibilityWeight(n, w, field.settings().visibilityExponent);
    };
    for (auto _ : state)
        for (std::size_t probe = 0; probe < field.layout().probes; ++probe) {
            const auto data = field.rayData().subspan(probe * directions.size(), directions.size());
            const auto moments = [&](std::size_t ray) {
                const float d = kernels::visibilityDistance(data[ray].distance, visibilityRange(desc.volumes[0]));
                return glm::vec2(d, d * d);
            };
            directMeans(directions, desc.irradianceTexels, std::span(irradiance), cosine,
                        [&](std::size_t ray) { return data[ray].radiance; });
            directMeans(directions, desc.visibilityTexels, std::span(visibility), power, moments);
            benchmark::ClobberMemory();
        }
    state.counters["a probe"] = perProbe(field, state);
}

BENCHMARK(blendAll)->Arg(32)->Arg(144)->Arg(256)->Unit(benchmark::kMillisecond);
BENCHMARK(products)->Arg(144)->Unit(benchmark::kMicrosecond);
BENCHMARK(frameWeights)->Arg(144)->Unit(benchmark::kMicrosecond);
BENCHMARK(directLoop)->Arg(144)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace probegi::bench

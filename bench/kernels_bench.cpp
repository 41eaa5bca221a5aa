// Single formulas over arrays that fit into the first-level cache, vectorised by the compiler.
#include <benchmark/benchmark.h>

#include <glm/geometric.hpp>
#include <vector>

#include "kernels/blend/probe_blend.h"
#include "kernels/probe/irradiance_encoding.h"
#include "kernels/probe/octahedral_texel.h"
#include "kernels/probe/storage.h"
#include "kernels/trace/ray_set.h"

namespace probegi::bench {
namespace {

constexpr std::size_t kCount = 1024;

std::vector<glm::vec3> directions() {
    std::vector<glm::vec3> result;
    for (std::uint32_t i = 0; i < kCount; ++i) result.push_back(kernels::sphericalFibonacci(i, kCount));
    return result;
}

std::vector<float> values() {
    std::vector<float> result;
    for (std::size_t i = 0; i < kCount; ++i) result.push_back(0.001f + float(i) * 0.01f);
    return result;
}

// Measures out[i] = function(in[i]).
template <class In, class Function>
void each(benchmark::State& state, const std::vector<In>& in, const Function& function) {
    std::vector<decltype(function(in[0]))> out(in.size(), function(in[0]));
    for (auto _ : state) {
        for (std::size_t i = 0; i < in.size(); ++i) out[i] = function(in[i]);
        benchmark::ClobberMemory();
    }
    state.counters["one"] = benchmark::Counter(double(in.size()) * double(state.iterations()),
                                               benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void octEncode(benchmark::State& state) {
    each(state, directions(), [](glm::vec3 d) { return kernels::octEncode(d); });
}

void octDecode(benchmark::State& state) {
    std::vector<glm::vec2> in;
    for (const glm::vec3& d : directions()) in.push_back(kernels::octEncode(d));
    each(state, in, [](glm::vec2 p) { return kernels::octDecode(p); });
}

void encodeIrradiance(benchmark::State& state) {
    each(state, values(), [](float x) { return kernels::encodeIrradiance(x); });
}

// The encoding with std::pow, for comparison.
void encodeByPow(benchmark::State& state) {
    each(state, values(), [](float x) { return std::pow(x, 0.2f); });
}

void decodeToBlendSpace(benchmark::State& state) {
    each(state, values(), [](float x) { return kernels::decodeToBlendSpace(x); });
}

void packHalfDithered(benchmark::State& state) {
    each(state, values(), [](float x) { return kernels::packHalfDithered(x, 4000u); });
}

// A power of the cosine per texel and ray, which makes the direct blend slow.
void visibilityWeight(benchmark::State& state) {
    const glm::vec3 n = glm::normalize(glm::vec3(1, 2, 3));
    each(state, directions(), [n](glm::vec3 d) { return kernels::visibilityWeight(n, d, 50.0f); });
}

BENCHMARK(octEncode);
BENCHMARK(octDecode);
BENCHMARK(encodeIrradiance);
BENCHMARK(encodeByPow);
BENCHMARK(decodeToBlendSpace);
BENCHMARK(packHalfDithered);
BENCHMARK(visibilityWeight);

}  // namespace
}  // namespace probegi::bench

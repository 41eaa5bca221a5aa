#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <span>

#include "kernels/volume/volume.h"
#include "probegi/field.h"

namespace probegi {

/// Nanoseconds, summed over threads.
struct TraceTimes {
    using Clock = std::chrono::steady_clock;

    std::atomic<std::int64_t> traceNs{0};
    std::atomic<std::int64_t> shadeNs{0};

    /// Of a batch whose rays were traced by `traced` and whose hits are shaded now.
    void add(Clock::time_point start, Clock::time_point traced) noexcept {
        const auto nanoseconds = [](Clock::duration d) {
            return std::chrono::duration_cast<std::chrono::nanoseconds>(d).count();
        };
        traceNs += nanoseconds(traced - start);
        shadeNs += nanoseconds(Clock::now() - traced);
    }
};

/// The field of the last update at points: E in W m^-2. Called from several threads at once.
using BounceQuery = std::function<Result<void>(std::span<const FieldQuery>, std::span<glm::vec3>)>;

struct EmitterSearch;

/// Directions of a probe's rays, the same for all probes.
struct ProbeRayDirections {
    std::span<const glm::vec3> update;  ///< of the blended rays
    std::span<const glm::vec3> fixed;   ///< of the rays that measure lag; may be empty
};

/// Their results: [task][ray] of each kind.
struct ProbeRayData {
    std::span<RayDatum> update;
    std::span<FixedRayDatum> fixed;
};

/// Traces and shades the rays of the tasks on the context's threads, with any tracer: closest hits, surfaces, punctual
/// lights with shadow rays, emission (of update rays as far as `emitters` leaves it to them), sky, and the light of
/// earlier bounces (empty: none). Fills `out`. Errors: those of the tracer and of `bounces`.
Result<void> traceProbes(const Context& context, std::span<const kernels::Volume> volumes,
                         std::span<const ProbeTask> tasks, const ProbeRayDirections& directions, const Tracer& tracer,
                         const Lighting& lighting, const BounceQuery& bounces, const EmitterSearch& emitters,
                         const ProbeRayData& out, TraceTimes& times);

}  // namespace probegi

#pragma once

#include <atomic>
#include <functional>
#include <span>

#include "probegi/field.h"

namespace probegi {

/// Nanoseconds summed over threads.
struct TraceTimes {
    std::atomic<std::int64_t> traceNs{0};
    std::atomic<std::int64_t> shadeNs{0};
};

/// The field of the last update at points: E in W m^-2. Called from several threads at once.
using BounceQuery = std::function<void(std::span<const FieldQuery>, std::span<glm::vec3>)>;

struct EmitterSearch;

/// Traces and shades the rays of all probes on the context's threads, with any tracer: closest hits, surfaces, punctual
/// lights with shadow rays, emission (as far as `emitters` leaves it to rays), sky, and the light of earlier bounces
/// (empty: none). Fills rayData as [probe][ray].
void traceProbes(const Context& context, const GridDesc& grid, std::span<const glm::vec3> directions,
                 const Tracer& tracer, const Lighting& lighting, const BounceQuery& bounces,
                 const EmitterSearch& emitters, std::span<RayDatum> rayData, TraceTimes& times);

}  // namespace probegi

#pragma once

#include <atomic>
#include <span>

#include "cpu/probe_query.h"
#include "probegi/tracer.h"

namespace probegi {

/// Nanoseconds summed over threads.
struct TraceTimes {
    std::atomic<std::int64_t> traceNs{0};
    std::atomic<std::int64_t> shadeNs{0};
};

/// Traces and shades the rays of all probes: closest hits, surfaces, punctual lights with shadow rays, emission, sky,
/// and the light of earlier bounces from `lastFrame` (null: none). Fills rayData as [probe][ray].
void traceProbes(const Context& context, const GridDesc& grid, std::span<const glm::vec3> directions,
                 const Tracer& tracer, const Lighting& lighting, const FieldView* lastFrame,
                 std::span<RayDatum> rayData, TraceTimes& times);

}  // namespace probegi

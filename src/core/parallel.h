#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <cstddef>

#include "core/context_impl.h"
#include "core/float_mode.h"

namespace probegi {

/// Calls body(begin, end) on disjoint ranges that cover 0..count, on the context's threads. Ranges are multiples of
/// `grain` (but for the last), so what a body computes per range does not depend on the number of threads. Denormal
/// numbers count as zero in all of them.
template <class Body>
void parallelFor(const Context& context, std::size_t count, std::size_t grain, const Body& body) {
    const std::size_t chunks = (count + grain - 1) / grain;
    const auto run = [&](std::size_t chunk) {
        const FloatMode floatMode;
        body(chunk * grain, chunk + 1 == chunks ? count : (chunk + 1) * grain);
    };
    if (context.threads() == 1 || chunks <= 1) {
        for (std::size_t chunk = 0; chunk < chunks; ++chunk) run(chunk);
        return;
    }
    context.impl().arena.execute([&] {
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, chunks, 1), [&](const auto& range) {
            for (std::size_t chunk = range.begin(); chunk < range.end(); ++chunk) run(chunk);
        });
    });
}

}  // namespace probegi

#pragma once

#include <cstddef>

#include "core/context_impl.h"
#include "core/first_error.h"
#include "core/float_mode.h"

namespace probegi {

/// Calls task(i) for every i in 0..count-1 on the context's threads or the engine's jobs. Rethrows a task's exception.
void runTasks(const Context& context, std::size_t count, const std::function<void(std::size_t)>& task);

/// Calls body such that Embree's loops use the context's threads, if these are the library's own.
void runInside(const Context& context, const std::function<void()>& body);

/// Calls body(begin, end) on disjoint ranges that cover 0..count, on the context's threads. Range sizes are multiples
/// of `grain` (except the last), so what a body computes per range does not depend on the number of threads. Denormals
/// are flushed to zero.
template <class Body>
void parallelFor(const Context& context, std::size_t count, std::size_t grain, const Body& body) {
    const std::size_t chunks = (count + grain - 1) / grain;
    runTasks(context, chunks, [&](std::size_t chunk) {
        const FloatMode floatMode;
        body(chunk * grain, chunk + 1 == chunks ? count : (chunk + 1) * grain);
    });
}

/// The same for a body that returns a Result<void>. Returns the first error; ranges not yet begun are then skipped.
template <class Body>
Result<void> tryParallelFor(const Context& context, std::size_t count, std::size_t grain, const Body& body) {
    FirstError error;
    parallelFor(context, count, grain, [&](std::size_t begin, std::size_t end) {
        if (!error.happened()) error.passes(body(begin, end));
    });
    return error.result();
}

}  // namespace probegi

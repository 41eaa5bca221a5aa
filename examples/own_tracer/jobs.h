#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <thread>
#include <vector>

/// Stand-in for an engine's job system: a loop whose steps any thread may run, as probegi::ContextDesc::parallelFor
/// requires. An engine would use its existing threads.
inline void runJobs(std::size_t count, const std::function<void(std::size_t)>& step) {
    std::atomic<std::size_t> next{0};
    const auto work = [&] {
        for (std::size_t i = next++; i < count; i = next++) step(i);
    };
    std::vector<std::jthread> others;
    for (unsigned i = 1; i < std::thread::hardware_concurrency() && i < count; ++i) others.emplace_back(work);
    work();
}

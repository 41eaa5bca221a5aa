#pragma once

#include <atomic>
#include <functional>
#include <thread>
#include <vector>

namespace probegi::test {

/// An engine's job system: every loop on threads of its own, steps in any order. Counts what it was asked.
struct Jobs {
    std::atomic<int> loops{0};
    std::atomic<int> inside{0};       ///< loops that run now
    std::atomic<bool> nested{false};  ///< whether a loop was ever asked for within another

    void run(std::size_t count, const std::function<void(std::size_t)>& task) {
        ++loops;
        if (inside++) nested = true;
        std::atomic<std::size_t> next{0};
        std::vector<std::jthread> threads;
        for (int t = 0; t < 3; ++t)
            threads.emplace_back([&] {
                for (std::size_t i = next++; i < count; i = next++) task(count - 1 - i);
            });
        threads.clear();
        --inside;
    }
    std::function<void(std::size_t, const std::function<void(std::size_t)>&)> callback() {
        return [this](std::size_t count, const std::function<void(std::size_t)>& task) { run(count, task); };
    }
};

}  // namespace probegi::test

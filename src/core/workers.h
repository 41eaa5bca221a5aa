#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace probegi {

/// The library's own threads. There is one implementation (oneTBB), or none.
class Workers {
public:
    virtual ~Workers() = default;
    /// Calls task(i) for every i in 0..count-1. A thread that waits for a nested loop takes up no other task, so
    /// thread_local data belongs to one task at a time.
    virtual void run(std::size_t count, const std::function<void(std::size_t)>& task) = 0;
    /// Calls body such that a library on the same threads (Embree) keeps to their number.
    virtual void inside(const std::function<void()>& body) = 0;
};

/// Null if the library was built without threads.
std::unique_ptr<Workers> makeWorkers(int threads);
/// Whether makeWorkers() returns any.
bool workersExist() noexcept;

}  // namespace probegi

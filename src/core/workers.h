#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace probegi {

/// Threads of the library's own. There is one implementation (oneTBB), or none.
class Workers {
public:
    virtual ~Workers() = default;
    /// Calls task(i) for every i of 0..count. A thread that waits for a loop within a task takes up nothing else, so
    /// what is thread_local belongs to one task at a time.
    virtual void run(std::size_t count, const std::function<void(std::size_t)>& task) = 0;
    /// Calls body where loops of a library that uses the same threads (Embree) keep to their number.
    virtual void inside(const std::function<void()>& body) = 0;
};

/// Null where the library was built without.
std::unique_ptr<Workers> makeWorkers(int threads);
/// Whether makeWorkers() makes any.
bool workersExist() noexcept;

}  // namespace probegi

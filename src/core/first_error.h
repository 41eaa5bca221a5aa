#pragma once

#include <atomic>
#include <mutex>

#include "probegi/result.h"

namespace probegi {

/// The first error on any of several threads.
class FirstError {
public:
    /// Keeps the error of a failed Result. Returns whether it succeeded.
    bool passes(const Result<void>& result) {
        if (result) return true;
        const std::scoped_lock lock(m_mutex);
        if (!m_happened.exchange(true)) m_error = result.error();
        return false;
    }
    /// Whether anything failed, so that the rest can be skipped.
    bool happened() const noexcept { return m_happened.load(std::memory_order_relaxed); }
    /// Call when all threads are done.
    Result<void> result() const {
        if (m_happened) return m_error;
        return {};
    }

private:
    std::mutex m_mutex;
    std::atomic<bool> m_happened{false};
    Error m_error;
};

}  // namespace probegi

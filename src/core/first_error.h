#pragma once

#include <atomic>
#include <mutex>

#include "probegi/result.h"

namespace probegi {

/// What went wrong first on any of several threads.
class FirstError {
public:
    /// Keeps the error of a Result that failed. Returns whether it did not.
    bool passes(const Result<void>& result) {
        if (result) return true;
        const std::scoped_lock lock(m_mutex);
        if (!m_happened.exchange(true)) m_error = result.error();
        return false;
    }
    /// Whether anything went wrong: the rest need not be done.
    bool happened() const noexcept { return m_happened.load(std::memory_order_relaxed); }
    /// Once the threads are done.
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

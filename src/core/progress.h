#pragma once

#include <atomic>
#include <chrono>
#include <string>

#include "core/context_impl.h"

namespace probegi {

/// Reports one long-running stage to the context's progress callback. Workers call advance() from any thread;
/// the callback is rate-limited and never entered concurrently.
class Progress {
public:
    Progress(const Context& context, std::string stage, double totalUnits);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// Adds finished units. Returns false once the callback has asked to stop; the caller then returns quickly.
    bool advance(double units = 1);
    /// Sets the completed share directly (for stages limited by time or error rather than count).
    bool set(double fraction);
    bool cancelled() const noexcept { return m_cancelled.load(std::memory_order_relaxed); }

private:
    void report(double fraction);

    Context m_context;
    std::string m_stage;
    double m_total;
    std::atomic<double> m_done{0};
    std::atomic<bool> m_cancelled{false};
    std::atomic<std::int64_t> m_nextReportNs{0};
    std::chrono::steady_clock::time_point m_start;
    std::mutex m_mutex;
};

}  // namespace probegi

#include "core/progress.h"

#include <algorithm>

namespace probegi {

namespace {
constexpr std::int64_t kReportIntervalNs = 100'000'000;
}

Progress::Progress(const Context& context, std::string stage, double totalUnits)
    : m_context(context), m_stage(std::move(stage)), m_total(totalUnits), m_start(std::chrono::steady_clock::now()) {
    m_nextReportNs = kReportIntervalNs;
}

Progress::~Progress() {
    if (!cancelled()) report(1.0);
}

bool Progress::advance(double units) {
    const double done = m_done.fetch_add(units) + units;
    return set(m_total > 0 ? done / m_total : 0);
}

bool Progress::set(double fraction) {
    if (!m_context.impl().desc.progress) return true;
    if (cancelled()) return false;
    const auto elapsed = std::chrono::steady_clock::now() - m_start;
    const std::int64_t now = std::chrono::duration_cast<std::chrono::nanoseconds>(elapsed).count();
    std::int64_t due = m_nextReportNs.load();
    if (now >= due && m_nextReportNs.compare_exchange_strong(due, now + kReportIntervalNs))
        report(std::min(fraction, 0.999));
    return !cancelled();
}

void Progress::report(double fraction) {
    const auto& callback = m_context.impl().desc.progress;
    if (!callback) return;
    const std::lock_guard lock(m_mutex);
    const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - m_start).count();
    const double left = fraction > 0 ? elapsed * (1 - fraction) / fraction : -1;
    if (!callback({m_stage, fraction, elapsed, left})) m_cancelled = true;
}

}  // namespace probegi

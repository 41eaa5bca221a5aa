#include "field/probe_cost.h"

#include <algorithm>
#include <cmath>

namespace probegi {

namespace {

constexpr std::size_t kFirst = 64;
// Share of a new measurement, so that one slow update among many changes little.
constexpr double kFollow = 0.25;
// A measurement is at most so many times more or less than those before.
constexpr double kOutlier = 4;
constexpr double kMost = 1e9;  // probes

}  // namespace

void ProbeCost::report(double milliseconds, std::size_t probes) noexcept {
    if (!(milliseconds > 0) || !std::isfinite(milliseconds) || probes == 0) return;
    const double each = milliseconds / double(probes);
    m_last = probes;
    if (m_each > 0)
        m_each += kFollow * (std::clamp(each, m_each / kOutlier, m_each * kOutlier) - m_each);
    else
        m_each = each;
}

std::size_t ProbeCost::affordable(double milliseconds) const noexcept {
    if (m_each <= 0) return kFirst;
    const auto paid = std::size_t(std::clamp(milliseconds / m_each, 1.0, kMost));
    return std::min(paid, 2 * m_last);
}

}  // namespace probegi

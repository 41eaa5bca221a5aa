#pragma once

#include <cstddef>

namespace probegi {

/// What a probe's update costs, in milliseconds, as updates show: so many probes a budget of time pays for.
class ProbeCost {
public:
    /// After an update of so many probes. Counts nothing where either is not above 0.
    void report(double milliseconds, std::size_t probes) noexcept;
    /// Probes that the coming update may have, at least 1: at most twice as many as the last one had, or 64 before the
    /// first.
    std::size_t affordable(double milliseconds) const noexcept;

private:
    double m_each = 0;  // 0: unknown
    std::size_t m_last = 0;
};

}  // namespace probegi

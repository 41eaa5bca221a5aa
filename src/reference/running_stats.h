#pragma once

#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/vec3.hpp>

namespace probegi {

/// Mean and variance of a stream of colours (Welford 1962), mergeable (Chan, Golub and LeVeque 1979).
struct RunningStats {
    std::int64_t count = 0;
    glm::dvec3 mean{0.0};
    glm::dvec3 squares{0.0};  ///< sum of squared deviations from the mean

    void add(glm::dvec3 value) noexcept {
        ++count;
        const glm::dvec3 before = value - mean;
        mean += before / double(count);
        squares += before * (value - mean);
    }

    void merge(const RunningStats& other) noexcept {
        if (other.count == 0) return;
        const double total = double(count + other.count);
        const glm::dvec3 apart = other.mean - mean;
        mean += apart * (double(other.count) / total);
        squares += other.squares + apart * apart * (double(count) * double(other.count) / total);
        count += other.count;
    }

    /// Of the mean. For a single sample, its value is used.
    glm::dvec3 standardError() const noexcept {
        if (count < 2) return glm::abs(mean);
        return glm::sqrt(squares / (double(count) * double(count - 1)));
    }
};

}  // namespace probegi

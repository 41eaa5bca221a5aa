#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace probegi {

/// One channel of a picture, row-major.
struct Plane {
    int width = 0;
    int height = 0;
    std::vector<float> values;

    Plane(int w, int h) : width(w), height(h), values(std::size_t(w) * std::size_t(h)) {}
    float* row(int y) { return values.data() + std::size_t(y) * std::size_t(width); }
    const float* row(int y) const { return values.data() + std::size_t(y) * std::size_t(width); }
};

/// Correlates the plane's rows with an odd number of taps, the middle one at offset 0. Beyond its edges the plane
/// continues with the value at the edge.
Plane filterRows(const Plane& plane, std::span<const float> taps);

/// The same along columns.
Plane filterColumns(const Plane& plane, std::span<const float> taps);

}  // namespace probegi

#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace probegi {

/// A dense row-major matrix that keeps its memory when shrunk.
struct Matrix {
    std::size_t rows = 0;
    std::size_t columns = 0;
    std::vector<float> values;

    void resize(std::size_t r, std::size_t c) {
        rows = r;
        columns = c;
        if (values.size() < r * c) values.resize(r * c);
    }
    float& operator()(std::size_t r, std::size_t c) { return values[r * columns + c]; }
    const float& operator()(std::size_t r, std::size_t c) const { return values[r * columns + c]; }
};

/// result = left x right, on the calling thread. `right` is row-major with left.columns rows.
void multiply(const Matrix& left, std::span<const float> right, Matrix& result);

}  // namespace probegi

// A matrix product for the shapes of the blend, compiled by Highway for each instruction set: a few hundred rows,
// columns and terms, so that the right side stays in cache and no panels are copied.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cpu/matrix_product.cpp"  // NOLINT
#include <hwy/foreach_target.h>                      // IWYU pragma: keep
//
#include <hwy/highway.h>

#include "cpu/matrix_product.h"

HWY_BEFORE_NAMESPACE();
namespace probegi::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

constexpr hn::ScalableTag<float> kFloats;
constexpr std::size_t kLanes = HWY_LANES(float);
/// Rows and column vectors whose sums stay in registers: 12 sums, and room for the factors.
constexpr std::size_t kRows = 6, kVectors = 2;

struct Shape {
    std::size_t terms, columns;  // of the right side
};

/// `rows` rows of the left side times `vectors` column vectors of the right one.
template <std::size_t rows, std::size_t vectors>
HWY_INLINE void multiplyTile(const float* HWY_RESTRICT left, const float* HWY_RESTRICT right, Shape shape,
                             float* HWY_RESTRICT out) {
    hn::Vec<decltype(kFloats)> sums[rows][vectors];
    for (auto& row : sums)
        for (auto& sum : row) sum = hn::Zero(kFloats);
    for (std::size_t k = 0; k < shape.terms; ++k)
        for (std::size_t v = 0; v < vectors; ++v) {
            const auto b = hn::LoadU(kFloats, right + k * shape.columns + v * kLanes);
            for (std::size_t r = 0; r < rows; ++r)
                sums[r][v] = hn::MulAdd(hn::Set(kFloats, left[r * shape.terms + k]), b, sums[r][v]);
        }
    for (std::size_t r = 0; r < rows; ++r)
        for (std::size_t v = 0; v < vectors; ++v) hn::StoreU(sums[r][v], kFloats, out + r * shape.columns + v * kLanes);
}

/// `rows` rows of the result.
template <std::size_t rows>
HWY_INLINE void multiplyRows(const float* left, const float* right, Shape shape, float* out) {
    std::size_t column = 0;
    for (; column + kVectors * kLanes <= shape.columns; column += kVectors * kLanes)
        multiplyTile<rows, kVectors>(left, right + column, shape, out + column);
    for (; column + kLanes <= shape.columns; column += kLanes)
        multiplyTile<rows, 1>(left, right + column, shape, out + column);
    for (; column < shape.columns; ++column)
        for (std::size_t r = 0; r < rows; ++r) {
            float sum = 0;
            for (std::size_t k = 0; k < shape.terms; ++k)
                sum += left[r * shape.terms + k] * right[k * shape.columns + column];
            out[r * shape.columns + column] = sum;
        }
}

}  // namespace

void multiplyAll(const float* left, std::size_t rows, const float* right, std::size_t terms, std::size_t columns,
                 float* out) {
    const Shape shape{terms, columns};
    std::size_t row = 0;
    for (; row + kRows <= rows; row += kRows)
        multiplyRows<kRows>(left + row * terms, right, shape, out + row * columns);
    for (; row < rows; ++row) multiplyRows<1>(left + row * terms, right, shape, out + row * columns);
}

}  // namespace probegi::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace probegi {

HWY_EXPORT(multiplyAll);

void multiply(const Matrix& left, std::span<const float> right, Matrix& result) {
    const std::size_t columns = right.size() / left.columns;
    result.resize(left.rows, columns);
    HWY_DYNAMIC_DISPATCH(multiplyAll)
    (left.values.data(), left.rows, right.data(), left.columns, columns, result.values.data());
}

}  // namespace probegi
#endif

#include "cpu/matrix_product.h"

#include <gtest/gtest.h>

#include <hwy/highway.h>
#include <cmath>

#include "kernels/random.h"

namespace probegi {
namespace {

// Sizes around those of the tiles, against sums in double precision.
void expectSums(std::size_t rows, std::size_t terms, std::size_t columns, const char* instructions) {
    std::uint32_t state = 3;
    Matrix left, result;
    left.resize(rows, terms);
    for (float& value : left.values) value = 2 * kernels::nextRandom(state) - 1;
    std::vector<float> right(terms * columns);
    for (float& value : right) value = 2 * kernels::nextRandom(state) - 1;
    multiply(left, right, result);
    ASSERT_EQ(result.rows, rows);
    ASSERT_EQ(result.columns, columns);
    for (std::size_t r = 0; r < rows; ++r)
        for (std::size_t c = 0; c < columns; ++c) {
            double sum = 0;
            for (std::size_t k = 0; k < terms; ++k) sum += double(left(r, k)) * double(right[k * columns + c]);
            EXPECT_NEAR(result(r, c), sum, 1e-6 * double(terms))
                << rows << "x" << terms << "x" << columns << " at " << r << "," << c << " with " << instructions;
        }
}

TEST(MatrixProduct, isTheSumOfProductsForEveryShape) {
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        hwy::SetSupportedTargetsForTest(target);
        for (const std::size_t rows : {1, 5, 6, 7, 13})
            for (const std::size_t columns : {1, 3, 16, 36, 64, 100})
                expectSums(rows, 17, columns, hwy::TargetName(target));
    }
    hwy::SetSupportedTargetsForTest(0);
}

}  // namespace
}  // namespace probegi

#include "cpu/matrix_product.h"

#include <Eigen/Core>

namespace probegi {

void multiply(const Matrix& left, std::span<const float> right, Matrix& result) {
    using RowMajor = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const auto rows = Eigen::Index(left.rows), inner = Eigen::Index(left.columns);
    const auto columns = Eigen::Index(right.size() / left.columns);
    result.resize(left.rows, right.size() / left.columns);
    const Eigen::Map<const RowMajor> a(left.values.data(), rows, inner);
    const Eigen::Map<const RowMajor> b(right.data(), inner, columns);
    Eigen::Map<RowMajor>(result.values.data(), rows, columns).noalias() = a * b;
}

}  // namespace probegi

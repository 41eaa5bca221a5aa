#include <algorithm>
#include <cmath>

#include "probegi/measure.h"

namespace probegi {

Percentiles percentiles(std::vector<double> values) {
    if (values.empty()) return {};
    std::sort(values.begin(), values.end());
    const auto at = [&](double share) {
        const double position = share * double(values.size() - 1);
        const std::size_t below = std::size_t(position);
        const std::size_t above = std::min(below + 1, values.size() - 1);
        return std::lerp(values[below], values[above], position - double(below));
    };
    return {at(0.05), at(0.5), at(0.95)};
}

}  // namespace probegi

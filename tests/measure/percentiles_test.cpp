#include <gtest/gtest.h>

#include "probegi/measure.h"

namespace probegi {
namespace {

TEST(Percentiles, byHand) {
    std::vector<double> values;
    for (int i = 100; i >= 0; --i) values.push_back(i);
    const Percentiles p = percentiles(values);
    EXPECT_DOUBLE_EQ(p.low, 5);
    EXPECT_DOUBLE_EQ(p.median, 50);
    EXPECT_DOUBLE_EQ(p.high, 95);
}

TEST(Percentiles, betweenAndFew) {
    EXPECT_DOUBLE_EQ(percentiles({1, 2}).median, 1.5);
    EXPECT_DOUBLE_EQ(percentiles({7}).low, 7);
    EXPECT_DOUBLE_EQ(percentiles({}).median, 0);
}

}  // namespace
}  // namespace probegi

#include "kernels/lanes.h"

#include <gtest/gtest.h>

namespace probegi::kernels {
namespace {

TEST(Lanes, selectIsTheConditionalOperator) {
    EXPECT_EQ(select(true, 1.5f, 2.5f), 1.5f);
    EXPECT_EQ(select(false, 1.5f, 2.5f), 2.5f);
    EXPECT_EQ(select(true, 1, 2), 1);
    EXPECT_EQ(select(false, 1, 2), 2);
}

TEST(Lanes, zeroHasASign) {
    EXPECT_EQ(signNotZero(3.0f), 1.0f);
    EXPECT_EQ(signNotZero(0.0f), 1.0f);
    EXPECT_EQ(signNotZero(-0.0f), 1.0f);
    EXPECT_EQ(signNotZero(-1e-30f), -1.0f);
}

}  // namespace
}  // namespace probegi::kernels

#include "console/whole_progress.h"

#include <gtest/gtest.h>

namespace probegi::tool {
namespace {

TEST(WholeProgress, PiecesTakeTheirShares) {
    WholeProgress progress({1, 3, 0, 4});
    EXPECT_EQ(progress.fraction(0.5), 0) << "nothing has begun";
    progress.begin();
    EXPECT_DOUBLE_EQ(progress.fraction(0.5), 0.0625);
    EXPECT_DOUBLE_EQ(progress.fraction(1), 0.125);
    progress.begin();
    EXPECT_DOUBLE_EQ(progress.fraction(0), 0.125);
    EXPECT_DOUBLE_EQ(progress.fraction(0.5), 0.3125);
    progress.begin();
    EXPECT_DOUBLE_EQ(progress.fraction(1), 0.5);
    progress.begin();
    EXPECT_DOUBLE_EQ(progress.fraction(1), 1);
}

TEST(WholeProgress, NeverFalls) {
    WholeProgress progress({1, 1});
    progress.begin();
    progress.fraction(0.8);
    EXPECT_DOUBLE_EQ(progress.fraction(0.1), 0.4) << "a second stage of the same piece";
    progress.begin();
    EXPECT_DOUBLE_EQ(progress.fraction(-1), 0.5);
    EXPECT_DOUBLE_EQ(progress.fraction(7), 1);
    progress.begin();  // more than planned
    EXPECT_DOUBLE_EQ(progress.fraction(0), 1);
    WholeProgress nothing({});
    nothing.begin();
    EXPECT_EQ(nothing.fraction(1), 0);
}

}  // namespace
}  // namespace probegi::tool

#include <gtest/gtest.h>

#include "kernels/sdf/union_hit.h"

namespace probegi::kernels {
namespace {

TEST(SdfUnionHit, entersTheNearestFromNearOn) {
    SdfFound found = sdfFoundNone(10);
    sdfEnter(found, sdfSpan(5, 6), 1, 0);
    sdfEnter(found, sdfSpan(3, 9), 1, 1);
    sdfEnter(found, sdfSpan(3, 4), 1, 2);     // as near: the first counts
    sdfEnter(found, sdfSpan(0, 2), 1, 3);     // begins before
    sdfEnter(found, sdfSpan(2, 1.5f), 1, 4);  // missed
    EXPECT_EQ(found.solid, 1);
    EXPECT_EQ(found.distance, 3);
    found = sdfFoundNone(10);
    sdfEnter(found, sdfSpan(11, 12), 1, 0);
    EXPECT_EQ(found.solid, -1);
    sdfEnter(found, sdfSpan(10, 12), 1, 1);
    EXPECT_EQ(found.solid, 1);
    found = sdfFoundNone(10);
    sdfEnter(found, sdfSpan(1, 12), 1, 2);
    EXPECT_EQ(found.solid, 2);
}

TEST(SdfUnionHit, leavesWhatItIsIn) {
    EXPECT_TRUE(sdfStartsInside(sdfSpan(0, 2), 1));
    EXPECT_FALSE(sdfStartsInside(sdfSpan(1, 2), 1));
    EXPECT_FALSE(sdfStartsInside(sdfSpan(0, 1), 1));
    SdfFound found = sdfFoundNone(1);
    EXPECT_FALSE(sdfLeave(found, sdfSpan(1, 4), 0, 0));
    EXPECT_FALSE(sdfLeave(found, sdfSpan(0, 1), 0, 1));
    EXPECT_TRUE(sdfLeave(found, sdfSpan(0, 2), 0, 2));
    EXPECT_EQ(found.distance, 2);
    EXPECT_EQ(found.solid, 2);
    EXPECT_FALSE(sdfLeave(found, sdfSpan(2 + 2 * kSdfSeam, 3), kSdfSeam, 3));
    EXPECT_TRUE(sdfLeave(found, sdfSpan(2 + 0.5f * kSdfSeam, 3), kSdfSeam, 4));
    EXPECT_EQ(found.distance, 3);
}

}  // namespace
}  // namespace probegi::kernels

#include "kernels/random.h"

#include <gtest/gtest.h>

namespace probegi::kernels {
namespace {

// Values computed independently from the paper's definition, since changing a constant would change every picture.
TEST(Hash, isPcg) {
    EXPECT_EQ(hashUint(0), 129708002u);
    EXPECT_EQ(hashUint(1), 2831084092u);
    EXPECT_EQ(hashUint(12345), 4099845390u);
    EXPECT_EQ(hashUint(0xffffffffu), 3861530882u);
}

TEST(Hash, combinesInOrder) {
    EXPECT_EQ(hashCombine(0, 0), 2419168863u);
    EXPECT_EQ(hashCombine(1, 2), 1327536496u);
    EXPECT_EQ(hashCombine(2, 1), 2459409249u);
}

TEST(Random, unitNumbersAreTheTopBits) {
    EXPECT_EQ(uintToUnit(0), 0.0f);
    EXPECT_EQ(uintToUnit(0x80000000u), 0.5f);
    EXPECT_EQ(uintToUnit(0xffffffffu), 1 - 0x1p-24f);
    EXPECT_EQ(uintToUnit(0xffu), 0.0f);
    EXPECT_EQ(uintToUnit(0x100u), 0x1p-24f);
}

TEST(Random, aStreamIsPcgToo) {
    uint state = 7;
    EXPECT_EQ(nextRandom(state), 8283922 * 0x1p-24f);
    EXPECT_EQ(nextRandom(state), 5960103 * 0x1p-24f);
    EXPECT_EQ(nextRandom(state), 8094610 * 0x1p-24f);
}

}  // namespace
}  // namespace probegi::kernels

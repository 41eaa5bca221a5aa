#include "kernels/volume/pool.h"

#include <gtest/gtest.h>

#include <set>
#include <tuple>

namespace probegi::kernels {
namespace {

// Maps of 8 texels with a border of one lie 10 apart.
TEST(Pool, tilesHaveABorder) {
    EXPECT_EQ(tileOrigin({0, 0, 9}, 8), ivec2(1, 1));
    EXPECT_EQ(tileOrigin({2, 3, 9}, 8), ivec2(21, 31));
    // The centre of texel (4, 5) of that tile in an atlas of 100 x 50.
    const vec2 at = atlasCoordinates({2, 3, 0}, {4, 5}, 8, {0.01f, 0.02f});
    EXPECT_NEAR(at.x, 0.255f, 1e-6f);
    EXPECT_NEAR(at.y, 0.73f, 1e-6f);
}

TEST(Pool, everySlotHasATileOfItsOwn) {
    const PoolTiles tiles{3, 5};  // rows of 8, layers of 4 rows
    std::set<std::tuple<int, int, int>> seen;
    for (int slot = 0; slot < 100; ++slot) {
        const ivec3 tile = poolTile(tiles, slot);
        EXPECT_EQ(tile.x + 8 * (tile.y + 4 * tile.z), slot);
        EXPECT_TRUE(seen.insert({tile.x, tile.y, tile.z}).second);
    }
}

}  // namespace
}  // namespace probegi::kernels

// Compression of section 3.4.2.
#include "mask/mask_cubes.h"

#include <gtest/gtest.h>

#include <random>

namespace probegi::test {
namespace {

std::uint32_t texelIn(const MaskCubes& cubes, bool packed, std::size_t cell, std::size_t texel) {
    const std::size_t first = cubes.of[cell] * cubes.cubeWords;
    return packed ? cubes.words[first + texel / 2] >> (16 * (texel % 2)) & 0xffffu : cubes.words[first + texel];
}

TEST(MaskCubes, loseNothing) {
    for (const bool packed : {false, true})
        for (const int factor : {2, 3, 8}) {
            const std::size_t texels = std::size_t(factor * factor * factor);
            std::mt19937 random(7);
            std::vector<std::uint32_t> all(20 * texels);
            for (std::uint32_t& texel : all) texel = std::uint32_t(random()) & (packed ? 0xffffu : 0xfffffu);
            const MaskCubes cubes = mergeCubes(all, factor, packed);
            EXPECT_EQ(cubes.count(), 21u);
            EXPECT_EQ(cubes.cubeWords, packed ? (texels + 1) / 2 : texels);
            for (std::size_t i = 0; i < all.size(); ++i)
                ASSERT_EQ(texelIn(cubes, packed, i / texels, i % texels), all[i]);
        }
}

TEST(MaskCubes, mergeEqualOnes) {
    std::vector<std::uint32_t> texels;
    for (int cell = 0; cell < 30; ++cell)
        texels.insert(texels.end(), 27, cell % 3 == 0 ? kOpenTexel : std::uint32_t(cell % 3));
    texels.back() ^= 1;  // the last texel of cell 29: 2 -> 3
    const MaskCubes cubes = mergeCubes(texels, 3, false);
    EXPECT_EQ(cubes.count(), 4u);
    EXPECT_EQ(cubes.of[0], cubes.of.back()) << "the cube that sees all is one of them";
    EXPECT_EQ(cubes.of[1], cubes.of[4]);
    EXPECT_NE(cubes.of[2], cubes.of[29]);
    EXPECT_EQ(texelIn(cubes, false, 29, 26), 3u);
}

TEST(MaskCubes, ofNothingAreOne) {
    const MaskCubes cubes = mergeCubes({}, 8, true);
    EXPECT_EQ(cubes.count(), 1u);
    EXPECT_EQ(cubes.of.size(), 1u);
    EXPECT_EQ(cubes.words[77], 0x000f000fu);
}

}  // namespace
}  // namespace probegi::test

// Compression of section 3.4.2.
#include "mask/mask_cubes.h"

#include <gtest/gtest.h>

#include <random>

namespace probegi::test {
namespace {

std::uint8_t texelOf(const MaskCubes& cubes, std::size_t cell, std::size_t texel) {
    const std::size_t first = cubes.of[cell] * cubes.cubeWords;
    return std::uint8_t(cubes.words[first + texel / 4] >> (8 * (texel % 4)));
}

TEST(MaskCubes, loseNothing) {
    for (const int factor : {2, 3, 8}) {
        const std::size_t texels = std::size_t(factor * factor * factor);
        std::mt19937 random(7);
        std::vector<std::uint8_t> masks(20 * texels);
        for (std::uint8_t& mask : masks) mask = std::uint8_t(random());
        const MaskCubes cubes = mergeCubes(masks, factor);
        EXPECT_EQ(cubes.count(), 21u);
        for (std::size_t i = 0; i < masks.size(); ++i) ASSERT_EQ(texelOf(cubes, i / texels, i % texels), masks[i]);
    }
}

TEST(MaskCubes, mergeEqualOnes) {
    std::vector<std::uint8_t> masks;
    for (int cell = 0; cell < 30; ++cell) masks.insert(masks.end(), 27, std::uint8_t(cell % 3 == 0 ? 255 : cell % 3));
    masks.back() ^= 1;  // the last texel of cell 29: 2 -> 3
    const MaskCubes cubes = mergeCubes(masks, 3);
    EXPECT_EQ(cubes.count(), 4u);
    EXPECT_EQ(cubes.of[0], cubes.of.back()) << "the cube that sees all is one of them";
    EXPECT_EQ(cubes.of[1], cubes.of[4]);
    EXPECT_NE(cubes.of[2], cubes.of[29]);
    EXPECT_EQ(texelOf(cubes, 29, 26), 3);
}

TEST(MaskCubes, ofNothingAreOne) {
    const MaskCubes cubes = mergeCubes({}, 8);
    EXPECT_EQ(cubes.count(), 1u);
    EXPECT_EQ(cubes.of.size(), 1u);
    EXPECT_EQ(cubes.words[77], 0xffffffffu);
}

}  // namespace
}  // namespace probegi::test

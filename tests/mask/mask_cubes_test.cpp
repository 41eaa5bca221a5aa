// Compression of section 3.4.2.
#include "mask/mask_cubes.h"

#include <gtest/gtest.h>

#include <random>

namespace probegi::test {
namespace {

std::uint32_t texelIn(const MaskCubes& cubes, bool packed, std::uint32_t cube, std::size_t texel) {
    const std::size_t first = cube * cubes.cubeWords();
    return packed ? cubes.words()[first + texel / 2] >> (16 * (texel % 2)) & 0xffffu : cubes.words()[first + texel];
}

std::vector<std::uint32_t> cubeOf(std::uint32_t texel) {
    return std::vector<std::uint32_t>(27, texel);
}

TEST(MaskCubes, loseNothing) {
    for (const bool packed : {false, true})
        for (const int factor : {2, 3, 8}) {
            const std::size_t texels = std::size_t(factor * factor * factor);
            std::mt19937 random(7);
            std::vector<std::uint32_t> all(20 * texels);
            for (std::uint32_t& texel : all) texel = std::uint32_t(random()) & (packed ? 0xffffu : 0xfffffu);
            MaskCubes cubes(factor, packed);
            std::vector<std::uint32_t> of;
            for (std::size_t c = 0; c < 20; ++c) of.push_back(cubes.add(std::span(all).subspan(c * texels, texels)));
            EXPECT_EQ(cubes.count(), 20u);
            EXPECT_EQ(cubes.cubeWords(), packed ? (texels + 1) / 2 : texels);
            for (std::size_t i = 0; i < all.size(); ++i)
                ASSERT_EQ(texelIn(cubes, packed, of[i / texels], i % texels), all[i]);
        }
}

TEST(MaskCubes, mergeEqualOnes) {
    MaskCubes cubes(3, false);
    std::vector<std::uint32_t> of;
    for (std::uint32_t cell = 0; cell < 30; ++cell) of.push_back(cubes.add(cubeOf(cell % 3)));
    std::vector<std::uint32_t> other = cubeOf(2);
    other.back() = 3;
    const std::uint32_t last = cubes.add(other);
    EXPECT_EQ(cubes.count(), 4u);
    EXPECT_EQ(of[1], of[4]);
    EXPECT_NE(of[2], last);
    EXPECT_EQ(texelIn(cubes, false, last, 26), 3u);
}

TEST(MaskCubes, thatNoCellHasGiveTheirPlace) {
    MaskCubes cubes(3, true);
    const std::uint32_t one = cubes.add(cubeOf(1)), two = cubes.add(cubeOf(2));
    EXPECT_EQ(cubes.add(cubeOf(1)), one);
    cubes.release(one);
    EXPECT_EQ(cubes.count(), 2u) << "another cell still has it";
    cubes.release(one);
    EXPECT_EQ(cubes.count(), 1u);
    EXPECT_EQ(cubes.add(cubeOf(3)), one);
    EXPECT_EQ(cubes.words().size(), 2 * cubes.cubeWords());
    EXPECT_EQ(texelIn(cubes, true, one, 13), 3u);
    EXPECT_EQ(texelIn(cubes, true, two, 13), 2u);
    EXPECT_NE(cubes.add(cubeOf(1)), one) << "it was forgotten with its last cell";
}

// That of cells without geometry, which comes last, is one of those of the others if they have it.
TEST(MaskCubes, thatSeesAllIsNoOtherThanTheirs) {
    MaskCubes cubes(8, true);
    const std::vector<std::uint32_t> open(512, kOpenTexel);
    const std::uint32_t ofACell = cubes.add(open);
    EXPECT_EQ(cubes.add(open), ofACell);
    EXPECT_EQ(cubes.count(), 1u);
    EXPECT_EQ(cubes.words()[77], 0x000f000fu);
}

// Random cells come and go: each has what it was last given, and no two cubes are the same.
TEST(MaskCubes, staySoundAsCellsChange) {
    MaskCubes cubes(3, false);
    std::mt19937 random(3);
    std::vector<std::uint32_t> texel(40), of;
    for (std::uint32_t& t : texel) of.push_back(cubes.add(cubeOf(t = std::uint32_t(random() % 7))));
    for (int i = 0; i < 2000; ++i) {
        const std::size_t cell = random() % 40;
        cubes.release(of[cell]);
        of[cell] = cubes.add(cubeOf(texel[cell] = std::uint32_t(random() % 7)));
        std::vector<bool> there(7);
        for (std::size_t c = 0; c < 40; ++c) {
            ASSERT_EQ(texelIn(cubes, false, of[c], 26), texel[c]);
            there[texel[c]] = true;
        }
        ASSERT_EQ(cubes.count(), std::size_t(std::count(there.begin(), there.end(), true)));
    }
}

}  // namespace
}  // namespace probegi::test

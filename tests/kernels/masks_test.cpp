// The look-up of baked masks, in cubes of closed form.
#include "kernels/guards/masks.h"

#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <vector>

namespace probegi::kernels {
namespace {

constexpr int kTexels = 4, kCube = 16, kCubeWords = 64;

// One cell whose cube is a function of the texel; moments that see nothing.
struct CubeField {
    using MapPoint = vec3;
    int rules = kRulesMeasured;
    int maskTexels = kTexels, maskPacked = 0;
    std::vector<std::uint32_t> words = std::vector<std::uint32_t>(kCube + kCubeWords);
    mutable int asked = 0;

    explicit CubeField(
        const std::function<unsigned(ivec3)>& mask,
        const std::function<unsigned(ivec3)>& walls = [](ivec3) { return 0u; }) {
        for (int slot = 0; slot < 8; ++slot) {
            words[std::size_t(2 * slot)] = kCube;
            words[std::size_t(2 * slot + 1)] = std::uint32_t(slot);  // by parity
        }
        for (int t = 0; t < kCubeWords; ++t) {
            const ivec3 texel(t & 3, t >> 2 & 3, t >> 4);
            words[std::size_t(kCube + t)] = (mask(texel) & 15u) | (mask(texel) >> 4 & 15u) << 16 | walls(texel);
        }
    }
    // The same with two texels to a word, which then have four clusters.
    CubeField packed() const {
        CubeField field = *this;
        field.maskPacked = 1;
        for (int t = 0; t < kCubeWords; t += 2)
            field.words[std::size_t(kCube + t / 2)] =
                (words[std::size_t(kCube + t)] & 0xffffu) | words[std::size_t(kCube + t + 1)] << 16;
        field.words.resize(kCube + kCubeWords / 2);
        return field;
    }
    friend int maskWord(const CubeField& f, int number) { return int(f.words.at(std::size_t(number))); }
    friend vec3 visibilityPoint(const CubeField&, vec3 direction) { return direction; }
    friend void storedMoments(const CubeField& f, int, vec3, float& mean, float& meanSquare) {
        ++f.asked;
        mean = meanSquare = 0.0f;
    }
};

Volume oneCell() {
    Volume v{};
    v.spacing = v.inverseSpacing = vec3(1.0f);
    v.minSpacing = 1.0f;
    v.inverseMaxDistance = 0.5f;
    v.counts = ivec3(2);
    v.orientation = vec4(0, 0, 0, 1);
    return v;
}

std::array<float, 8> shares(const GuardPoint& point) {
    std::array<float, 8> all;
    for (int k = 0; k < 8; ++k) all[std::size_t(k)] = maskOf(point, k);
    return all;
}

TEST(Masks, bitsSpreadOverBytes) {
    for (int bits = 0; bits < 16; ++bits)
        for (int k = 0; k < 4; ++k) EXPECT_EQ(spreadBits(bits) >> (8 * k) & 255, bits >> k & 1) << bits;
}

TEST(Masks, aTexelIsWhatItHolds) {
    for (unsigned mask = 0; mask < 256; ++mask) {
        const CubeField field([&](ivec3 t) { return t == ivec3(1, 2, 3) ? mask : ~mask & 255u; });
        const auto found = shares(maskPointAt(field, kCube, vec3(1, 2, 3)));
        for (unsigned k = 0; k < 8; ++k) ASSERT_EQ(found[k], float(mask >> k & 1u)) << mask;
    }
}

TEST(Masks, betweenTexelsTheyAreTrilinear) {
    // Cluster k at the texels with x = k, so that shares are the weights along x; and the same along z.
    const CubeField alongX([](ivec3 t) { return 1u << t.x; });
    const CubeField alongZ([](ivec3 t) { return 16u << t.z; });
    for (float at = 0; at <= 3.0f; at += 0.05f) {
        const auto x = shares(maskPointAt(alongX, kCube, vec3(at, 0.3f, 2.9f)));
        const auto z = shares(maskPointAt(alongZ, kCube, vec3(2.7f, 1.4f, at)));
        for (int k = 0; k < 4; ++k) {
            const float weight = std::max(0.0f, 1.0f - std::abs(at - float(k)));
            EXPECT_NEAR(x[std::size_t(k)], weight, 0.04f) << at;
            EXPECT_NEAR(z[std::size_t(4 + k)], weight, 0.04f) << at;
        }
    }
}

TEST(Masks, eightSharesOfOneFitTheirBytes) {
    // Each weight is rounded up: the sums must neither overflow nor spill into the next byte.
    const CubeField all([](ivec3) { return 255u; }), some([](ivec3) { return 0x55u; });
    for (float x = 0; x <= 3; x += 0.037f)
        for (float y = 0; y <= 3; y += 0.41f) {
            for (const float share : shares(maskPointAt(all, kCube, vec3(x, y, 3 - x)))) EXPECT_NEAR(share, 1, 0.04f);
            const auto found = shares(maskPointAt(some, kCube, vec3(x, y, 3 - x)));
            for (std::size_t k = 0; k < 8; ++k) EXPECT_NEAR(found[k], k % 2 == 0 ? 1 : 0, 0.04f);
        }
}

TEST(Masks, twoTexelsShareAWord) {
    const CubeField field([](ivec3 t) { return unsigned(t.x + 3 * t.y + 7 * t.z) & 15u; },
                          [](ivec3 t) { return t.y == 1 ? 0x0500u : 0u; });
    const CubeField packed = field.packed();
    for (float x = 0; x <= 3; x += 0.23f)
        for (float y = 0; y <= 3; y += 0.31f) {
            const auto one = shares(maskPointAt(field, kCube, vec3(x, y, 3 - y)));
            EXPECT_EQ(shares(maskPointAt(packed, kCube, vec3(x, y, 3 - y))), one);
        }
}

// A wall across an axis between the texels 1 and 2; its two sides see clusters 0 and 1.
CubeField withWall(int axis, unsigned place) {
    return CubeField([axis](ivec3 t) { return t[axis] < 2 ? 1u : 2u; },
                     [=](ivec3 t) { return t[axis] == 1 ? place << (4 + 4 * axis) : 0u; });
}

TEST(Masks, aWallPartsItsSides) {
    for (int axis = 0; axis < 3; ++axis)
        for (unsigned place = 1; place <= 15; ++place) {
            const CubeField field = withWall(axis, place);
            const float wall = 1 + (float(place) - 1) / 14;
            for (float at = 0; at <= 3; at += 0.013f) {
                if (std::abs(at - wall) < 1e-4f) continue;
                vec3 texel(0.7f, 1.4f, 2.8f);
                texel[axis] = at;
                const auto found = shares(maskPointAt(field, kCube, texel));
                ASSERT_EQ(found[0] > 0, at < wall) << axis << " " << place << " " << at;
                ASSERT_EQ(found[1] > 0, at > wall) << axis << " " << place << " " << at;
            }
        }
}

TEST(Masks, aSlantedWallPartsItsSides) {
    const vec3 normal(1.0f, 0.4f, 0.2f);
    const auto apart = [&](vec3 at) { return dot(at, normal) - 2.2f; };
    const CubeField field([&](ivec3 t) { return apart(vec3(t)) < 0 ? 1u : 2u; },
                          [&](ivec3 t) {
                              unsigned walls = 0;
                              for (int axis = 0; axis < 3; ++axis) {
                                  const float place = -apart(vec3(t)) / normal[axis];
                                  if (place > 0 && place < 1)
                                      walls |= (1 + unsigned(place * 14 + 0.5f)) << (4 + 4 * axis);
                              }
                              return walls;
                          });
    double wrong = 0;
    int all = 0;
    for (float x = 0; x <= 3; x += 0.11f)
        for (float y = 0; y <= 3; y += 0.13f)
            for (float z = 0; z <= 3; z += 0.17f) {
                const float distance = apart(vec3(x, y, z));
                if (std::abs(distance) < 0.04f) continue;  // the places are rounded
                wrong += double(shares(maskPointAt(field, kCube, vec3(x, y, z)))[distance < 0 ? 1 : 0]);
                ++all;
            }
    EXPECT_LT(wrong, 0.04 * all) << "blending over the wall mixes 11 %";
}

TEST(Masks, aSurfaceLooksAheadOfItself) {
    // The wall is half-way between the texels, and a surface of it may be rounded to either side.
    const CubeField field = withWall(0, 8);
    const Volume v = oneCell();
    for (const float rounding : {-1e-6f, 0.0f, 1e-6f}) {
        const vec3 point(0.5f + rounding, 0.4f, 0.6f);
        const Cage right = cageAround(v, point, vec3(1, 0, 0), vec3(0), 0.3f, kRulesMeasured);
        EXPECT_EQ(shares(masksPoint(field, v, right, cageSlots(v, right.base)))[0], 0);
        const Cage left = cageAround(v, point, vec3(-1, 0, 0), vec3(0), 0.3f, kRulesMeasured);
        EXPECT_EQ(shares(masksPoint(field, v, left, cageSlots(v, left.base)))[1], 0);
    }
    // At the cell's last face there is no texel ahead.
    const Cage last = cageAround(v, vec3(1, 0.5f, 0.5f), vec3(1, 0, 0), vec3(0), 0.3f, kRulesMeasured);
    EXPECT_GT(shares(masksPoint(field, v, last, cageSlots(v, last.base)))[1], 0.9f);
}

TEST(Masks, decideForTheProbesOfTheirCluster) {
    const CubeField field([](ivec3) { return 0x26u; });
    const Volume v = oneCell();
    const Cage cage = cageAround(v, vec3(0.4f), vec3(0, 1, 0), vec3(0), 0.3f, kRulesMeasured);
    const GuardPoint point = masksPoint(field, v, cage, cageSlots(v, cage.base));
    for (int slot = 0; slot < 8; ++slot)
        EXPECT_NEAR(masksSeen(field, v, slot, slot, vec3(1, 0, 0), point), 0x26 >> slot & 1, 0.04f) << slot;
    EXPECT_EQ(field.asked, 0) << "moments are not needed";
    EXPECT_EQ(maskCluster(0x7f05), 5);
}

TEST(Masks, blindPointsAskTheMoments) {
    const CubeField field([](ivec3) { return 0u; });
    const Volume v = oneCell();
    const Cage cage = cageAround(v, vec3(0.4f), vec3(0, 1, 0), vec3(0), 0.3f, kRulesMeasured);
    const GuardPoint point = masksPoint(field, v, cage, cageSlots(v, cage.base));
    EXPECT_EQ(masksSeen(field, v, 3, 3, vec3(1, 0, 0), point), momentsSeen(field, v, 3, 3, vec3(1, 0, 0), point));
    const vec3 begin = masksBegin(field, v, cage);
    EXPECT_EQ(masksFar(field, v, 3, vec3(1, 0, 0), begin), momentsFar(field, v, 3, vec3(1, 0, 0), begin));
    EXPECT_GT(field.asked, 0);
}

TEST(Masks, blindTexelsDoNotCount) {
    // Only the texels with x = 2 see, cluster 3: between 1 and 2 they alone tell.
    const CubeField field([](ivec3 t) { return t.x == 2 ? 8u : 0u; });
    for (float x = 1.1f; x < 2.9f; x += 0.1f)
        EXPECT_EQ(maskOf(maskPointAt(field, kCube, vec3(x, 0.5f, 1.5f)), 3), 1.0f) << x;
    EXPECT_EQ(maskPointAt(field, kCube, vec3(0.5f, 0, 0)).scale, 0.0f);
}

TEST(Masks, linksAreBitsOfTheProbe) {
    CubeField field([](ivec3) { return 255u; });
    const Volume v = oneCell();
    field.words[2 * 5 + 1] |= 0b100101u << 8;
    for (int side = 0; side < 6; ++side)
        EXPECT_EQ(masksBetween(field, v, 5, side, vec3(1, 0, 0), 1.0f, vec3(0.0f)), float(0b100101 >> side & 1));
}

}  // namespace
}  // namespace probegi::kernels

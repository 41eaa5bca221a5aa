#include "kernels/probe/placing.h"

#include <gtest/gtest.h>

namespace probegi::kernels {
namespace {

Volume unitVolume() {
    Volume v{};
    v.spacing = v.inverseSpacing = vec3(1.0f);
    v.minSpacing = 1.0f;
    v.counts = ivec3(4);
    v.relocated = 1;
    return v;
}

// All rays on backs `distance` away, the nearest along +x.
PlaceSight inMatter(float distance) {
    PlaceSight sight = nothingSeen();
    addToPlaceSight(sight, vec3(1, 0, 0), -distance, true);
    addToPlaceSight(sight, vec3(-1, 0, 0), -9.0f, true);
    return sight;
}

TEST(Placing, isDoneAfterItsLooks) {
    for (const bool relocates : {false, true}) {
        uint placement = beginPlacing(0xffffff00u | kLookBits | kInsideBit | kSurfaceBit);
        EXPECT_EQ(placement, 0xffffff00u | kSurfaceBit);
        placement &= 0xffu;
        for (uint look = 0; look < looksOfPlacement(relocates); ++look) {
            EXPECT_FALSE(isPlaced(placement, relocates)) << look;
            placement = lookedAround(unitVolume(), placement, nothingSeen(), 64, relocates, kRulesMeasured);
        }
        EXPECT_TRUE(isPlaced(placement, relocates));
        EXPECT_EQ(stateOf(placement), kUninitialized) << "its state comes by the event";
    }
}

TEST(Placing, theLastLookMovesNoProbe) {
    const Volume v = unitVolume();
    uint placement = 0;
    for (uint look = 0; look + 1 < looksOfPlacement(true); ++look)
        placement = lookedAround(v, placement, nothingSeen(), 2, true, kRulesMeasured);
    const uint last = lookedAround(v, placement, inMatter(0.1f), 2, true, kRulesMeasured);
    EXPECT_EQ(probeOffset(v, int(last)), vec3(0));
    EXPECT_NE(last & kInsideBit, 0u);
    const uint first = lookedAround(v, 0, inMatter(0.1f), 2, true, kRulesMeasured);
    EXPECT_GT(probeOffset(v, int(first)).x, 0.1f);
}

TEST(Placing, whatTheLastRaysToldDecides) {
    const Volume v = unitVolume();
    const uint inside = lookedAround(v, 0, inMatter(0.1f), 2, true, kRulesMeasured);
    EXPECT_EQ(lookedAround(v, inside, nothingSeen(), 2, true, kRulesMeasured) & kInsideBit, 0u) << "it moved out";
    EXPECT_EQ(placedEvent(kInsideBit, true, true), kPlacedInside);
    EXPECT_EQ(placedEvent(0, true, true), kSurfaceFound);
    EXPECT_EQ(placedEvent(0, false, true), kPlacedInOpen);
    EXPECT_EQ(placedEvent(kInsideBit, false, false), kSurfaceFound) << "without states all are updated";
}

}  // namespace
}  // namespace probegi::kernels

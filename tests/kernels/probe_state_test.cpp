#include "kernels/probe/probe_state.h"

#include <gtest/gtest.h>

namespace probegi::kernels {
namespace {

struct Transition {
    uint from, event, to;
};

// Figure 7, with what its caption and section 6 say of each edge; all else leaves a probe as it is.
constexpr Transition kTransitions[] = {
    {kUninitialized, kPlacedInside, kOff},
    {kUninitialized, kPlacedInOpen, kSleeping},
    {kUninitialized, kSurfaceFound, kNewlyVigilant},
    {kSleeping, kMoverNear, kNewlyAwake},
    {kSleeping, kSurfaceFound, kNewlyVigilant},
    {kNewlyAwake, kUpdated, kAwake},
    {kNewlyAwake, kMoverGone, kSleeping},
    {kNewlyAwake, kSurfaceFound, kNewlyVigilant},
    {kAwake, kMoverGone, kSleeping},
    {kAwake, kSurfaceFound, kVigilant},
    {kNewlyVigilant, kUpdated, kVigilant},
    {kOff, kEntered, kUninitialized},
    {kSleeping, kEntered, kUninitialized},
    {kNewlyAwake, kEntered, kUninitialized},
    {kNewlyVigilant, kEntered, kUninitialized},
    {kAwake, kEntered, kUninitialized},
    {kVigilant, kEntered, kUninitialized},
};

TEST(ProbeState, everyTransitionIsInTheTable) {
    for (uint from = 0; from < kProbeStates; ++from)
        for (uint event = 0; event < kProbeEvents; ++event) {
            uint expected = from;
            for (const Transition& t : kTransitions)
                if (t.from == from && t.event == event) expected = t.to;
            EXPECT_EQ(nextProbeState(from, event), expected) << "state " << from << ", event " << event;
        }
}

TEST(ProbeState, eachStateIsEitherUpdatedOrPassedOver) {
    for (uint state = 0; state < kProbeStates; ++state) EXPECT_NE(isActive(state), isUnused(state)) << state;
    EXPECT_TRUE(isUnused(kUninitialized));
    EXPECT_TRUE(isUnused(kSleeping));
    EXPECT_TRUE(isActive(kNewlyAwake));
    EXPECT_TRUE(isActive(kVigilant));
}

TEST(ProbeState, theWordKeepsWhatIsBesideTheState) {
    const uint word = 0xa5c37fe8u;
    for (uint state = 0; state < kProbeStates; ++state) {
        const uint changed = withState(word, state);
        EXPECT_EQ(stateOf(changed), state);
        EXPECT_EQ(changed & ~7u, word & ~7u);
    }
    uint placing = kUninitialized;
    for (uint look = 0; look < 7; ++look) {
        EXPECT_EQ(looksOf(placing | kInsideBit | kSurfaceBit), look);
        placing += kOneLook;
    }
    EXPECT_EQ(stateOf(placing), kUninitialized);
    EXPECT_EQ(kStateBits | kPlacingBits, 0xffu);
    EXPECT_EQ(kLookBits | kInsideBit | kSurfaceBit, kPlacingBits);
}

}  // namespace
}  // namespace probegi::kernels

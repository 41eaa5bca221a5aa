#include "kernels/screen/contact_slice.h"

#include <gtest/gtest.h>

#include <random>

#include "kernels/sampling.h"

namespace probegi::kernels {
namespace {

constexpr float kFar = 1e9f;  // a reach within which all is near

// The share of E that a horizon takes: the mean over slices. `offsetOf(slice, sign)`: what is on a side.
template <class OffsetOf>
double takenShare(vec3 toViewer, vec3 normal, const OffsetOf& offsetOf, int slices = 720) {
    const mat3 frame = orthonormalBasis(toViewer);
    double taken = 0, whole = 0;
    for (int i = 0; i < slices; ++i) {
        const float angle = kPi * (float(i) + 0.5f) / float(slices);
        const ContactSlice slice =
            contactSlice(toViewer, frame[0] * cos(angle) + frame[1] * sin(angle), normal, normal);
        whole += contactWhole(slice);
        for (const float sign : {-1.0f, 1.0f}) {
            ContactSide side = contactSide(slice, sign);
            taken += slice.weight * raiseHorizon(side, slice, normal, offsetOf(slice, sign), kFar, 1.0f);
        }
    }
    EXPECT_NEAR(whole / slices, 1.0, 1e-4);
    return taken / whole;
}

TEST(ContactSlice, anArcIsItsIntegral) {
    for (const float tilt : {-1.2f, -0.3f, 0.0f, 0.8f})
        for (const float angle : {0.2f, 1.0f, 1.5f}) {
            double sum = 0;
            constexpr int kParts = 10000;
            for (int i = 0; i < kParts; ++i) {
                const double a = angle * (i + 0.5) / kParts;
                sum += std::sin(a) * std::cos(a - tilt) * angle / kParts;
            }
            EXPECT_NEAR(contactArc(angle, tilt), sum, 1e-5) << tilt << ' ' << angle;
        }
}

TEST(ContactSlice, bothSidesWithoutAHorizonAreTheWhole) {
    const vec3 view = normalize(vec3(0.3f, 0.8f, -0.2f));
    for (const vec3 normal : {vec3(0, 1, 0), normalize(vec3(1, 1, 0)), normalize(vec3(-0.4f, 0.3f, 0.6f))}) {
        const ContactSlice slice = contactSlice(view, vec3(0.2f, 0.1f, 1), normal, normal);
        const float both = contactSide(slice, 1.0f).below + contactSide(slice, -1.0f).below;
        EXPECT_NEAR(slice.weight * both, contactWhole(slice), 1e-5f);
    }
}

// The form factor from a floor to a wall that stands `distance` away and is infinitely long.
TEST(ContactSlice, aWallTakesItsFormFactor) {
    for (const float distance : {0.5f, 1.0f, 3.0f})
        for (const float height : {0.25f, 1.0f, 20.0f}) {
            const double wanted = 0.5 * (1 - distance / std::sqrt(distance * distance + height * height));
            const double share = takenShare({0, 1, 0}, {0, 1, 0}, [&](const ContactSlice& slice, float sign) {
                const vec3 along = slice.tangent * sign;
                if (along.x <= 1e-3f) return vec3(0.0f, -1.0f, 0.0f);  // no wall there
                return along * (distance / along.x) + vec3(0, height, 0);
            });
            EXPECT_NEAR(share, wanted, 2e-3) << distance << ' ' << height;
        }
}

// At the bottom of a round pit, from which one sees `elevation` up in all directions, sin^2 of E is taken: whatever the
// viewer's direction, and though slices of an oblique one are not the azimuths.
TEST(ContactSlice, aPitTakesTheSquareOfItsSine) {
    for (const vec3 view : {vec3(0, 1, 0), normalize(vec3(0.5f, 1, 0.2f)), normalize(vec3(-0.8f, 1, 0.1f))})
        for (const float elevation : {0.1f, 0.3f, 0.6f}) {
            const float sine = sin(elevation);
            const double share = takenShare(view, {0, 1, 0}, [&](const ContactSlice& slice, float sign) {
                // The first direction, from the viewer's on, that is as low as the rim.
                float high = 0.0f, low = sign * slice.ground + 0.5f * kPi;
                for (int i = 0; i < 40; ++i) {
                    const float middle = 0.5f * (high + low);
                    const vec3 to = slice.toViewer * cos(middle) + slice.tangent * (sign * sin(middle));
                    (to.y > sine ? high : low) = middle;
                }
                return slice.toViewer * cos(low) + slice.tangent * (sign * sin(low));
            });
            EXPECT_NEAR(share, sine * sine, 2e-3) << view.x << ' ' << elevation;
        }
}

// Slants of the shading normal turn the cosine, not the ground: what is below the surface takes nothing.
TEST(ContactSlice, whatLiesInOrBelowThePlaneTakesNothing) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> unit(-1.0f, 1.0f);
    for (int i = 0; i < 200; ++i) {
        const vec3 ground(0, 1, 0), shading = normalize(vec3(0.4f * unit(random), 1, 0.4f * unit(random)));
        const vec3 view = normalize(vec3(unit(random), 0.6f, unit(random)));
        const ContactSlice slice = contactSlice(view, vec3(unit(random), unit(random), unit(random)), shading, ground);
        for (const float sign : {-1.0f, 1.0f}) {
            ContactSide side = contactSide(slice, sign);
            const vec3 offset(3 * unit(random), -0.01f * std::abs(unit(random)), 3 * unit(random));
            EXPECT_EQ(raiseHorizon(side, slice, ground, offset, kFar, 1.0f), 0.0f);
            EXPECT_EQ(side.horizon, side.ground);
        }
    }
}

TEST(ContactSlice, onlyWhatRisesAboveTheHorizonIsSeen) {
    const vec3 up(0, 1, 0);
    const ContactSlice slice = contactSlice(up, {1, 0, 0}, up, up);
    ContactSide side = contactSide(slice, 1.0f);
    const float first = raiseHorizon(side, slice, up, {1, 1, 0}, kFar, 1.0f);
    EXPECT_GT(first, 0.0f);
    EXPECT_EQ(raiseHorizon(side, slice, up, {2, 1.5f, 0}, kFar, 1.0f), 0.0f);  // hidden behind it
    EXPECT_EQ(raiseHorizon(side, slice, up, {-1, 5, 0}, kFar, 1.0f), 0.0f);    // on the other side
    const float second = raiseHorizon(side, slice, up, {1, 2, 0}, kFar, 1.0f);
    ContactSide once = contactSide(slice, 1.0f);
    ContactSide nothing = contactSide(slice, 1.0f);
    EXPECT_EQ(raiseHorizon(nothing, slice, up, {1, 2, 0}, kFar, 0.0f), 0.0f);
    EXPECT_NEAR(first + second, raiseHorizon(once, slice, up, {1, 2, 0}, kFar, 1.0f), 1e-6f);
}

TEST(ContactSlice, whatIsFarIsTheProbesOwn) {
    EXPECT_EQ(contactNearness(0.0f, 2.0f), 1.0f);
    EXPECT_EQ(contactNearness(2.0f, 2.0f), 0.0f);
    EXPECT_EQ(contactNearness(9.0f, 2.0f), 0.0f);
    EXPECT_GT(contactNearness(0.5f, 2.0f), contactNearness(1.0f, 2.0f));
    // Scale does not matter.
    EXPECT_NEAR(contactNearness(0.3f, 1.0f), contactNearness(300.0f, 1000.0f), 1e-6f);
    const vec3 up(0, 1, 0);
    const ContactSlice slice = contactSlice(up, {1, 0, 0}, up, up);
    ContactSide side = contactSide(slice, 1.0f);
    EXPECT_EQ(raiseHorizon(side, slice, up, {2, 2, 0}, 2.0f, 1.0f), 0.0f);
    EXPECT_EQ(side.horizon, side.ground);
}

}  // namespace
}  // namespace probegi::kernels

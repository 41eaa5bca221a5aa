#include "kernels/screen/contact_way.h"

#include <gtest/gtest.h>

#include <limits>
#include <utility>
#include <vector>

#include "kernels/screen/contact_slice.h"

namespace probegi::kernels {
namespace {

constexpr int kWidth = 1920, kHeight = 1080;
constexpr int kTurns = 256;

// 91 x 60 degrees.
PinholeCamera wideCamera() {
    const vec3 forward = normalize(vec3(0.3f, -0.4f, -1)), right = normalize(cross(forward, vec3(0, 1, 0)));
    return makePinhole({1, 2, 3}, forward, cross(right, forward), kPi / 3, kWidth, kHeight);
}

vec3 directionAt(const PinholeCamera& camera, vec2 pixel) {
    return pinholeDirection(camera, pixel.x, pixel.y);
}

// The middle, half way to the right, the right edge, and the lower right corner.
const std::vector<vec2> kPixels = {{960, 540}, {1440, 540}, {1919.5f, 540}, {1919.5f, 1079.5f}};

float turnOf(int i) {
    return (float(i) + 0.5f) / float(kTurns);
}

TEST(ContactWay, slicesAreEvenlyTurned) {
    const vec2 a = contactAcross(0, 0.3f), b = contactAcross(kContactSlices - 1, 0.3f);
    EXPECT_NEAR(length(a), 1.0f, 1e-6f);
    EXPECT_NEAR(dot(a, b), cos(kPi * float(kContactSlices - 1) / float(kContactSlices)), 1e-6f);
}

TEST(ContactWay, stepsGoOutAndLeaveTheSample) {
    for (const float widest : {0.5f, 5.0f, 300.0f}) {
        float last = 0;
        for (int i = 0; i < kContactSteps; ++i) {
            const float step = contactStep(i, 0.4f, widest);
            EXPECT_GE(step, last + 0.99f) << i;
            last = step;
        }
        EXPECT_LE(last, std::max(widest, float(kContactSteps)));
    }
}

TEST(ContactWay, isOfPixelsInTheMiddle) {
    const PinholeCamera camera = wideCamera();
    for (const float turn : {0.0f, 0.3f, 0.9f}) {
        const ContactWay way = contactWay(camera, directionAt(camera, kPixels[0]), 1, turn);
        EXPECT_LT(distance(way.across, contactAcross(1, turn)), 1e-5f);
        EXPECT_NEAR(way.pixels * pinholeSpread(camera, 1), 1.0f, 1e-5f);
    }
}

// Its tangents are even around the viewer's direction: the mean of their products is that of a circle.
TEST(ContactWay, isEvenAroundTheViewersDirection) {
    const PinholeCamera camera = wideCamera();
    for (const vec2 pixel : kPixels) {
        const vec3 view = directionAt(camera, pixel);
        mat3 sum(0.0f);
        for (int i = 0; i < kTurns; ++i)
            for (int slice = 0; slice < kContactSlices; ++slice) {
                const vec3 tangent = contactWay(camera, view, slice, turnOf(i)).tangent;
                EXPECT_NEAR(length(tangent), 1.0f, 1e-5f);
                EXPECT_NEAR(dot(tangent, view), 0.0f, 1e-5f);
                for (int k = 0; k < 3; ++k) sum[k] += tangent * (tangent[k] / float(kTurns * kContactSlices));
            }
        for (int k = 0; k < 3; ++k)
            for (int j = 0; j < 3; ++j) EXPECT_NEAR(sum[k][j], 0.5f * (float(j == k) - view[j] * view[k]), 1e-4f);
    }
}

// What one sees along it is in the slice's plane, on the side at hand.
TEST(ContactWay, showsItsSlice) {
    const PinholeCamera camera = wideCamera();
    for (const vec2 pixel : kPixels)
        for (int i = 0; i < kTurns; i += 5) {
            const vec3 view = directionAt(camera, pixel);
            const ContactWay way = contactWay(camera, view, 0, turnOf(i));
            EXPECT_NEAR(length(way.across), 1.0f, 1e-5f);
            for (const float step : {-200.0f, -20.0f, 20.0f, 200.0f}) {
                const vec3 seen = directionAt(camera, pixel + step * way.across);
                EXPECT_NEAR(dot(seen, cross(view, way.tangent)), 0.0f, 1e-5f) << step;
                EXPECT_GT(dot(seen, way.tangent) * step, 0.0f) << step;
            }
        }
}

// The share of E that a wall as high as it is far takes of a floor in front of the camera, by the slices of a search:
// the mean over turns. `normal`: the floor's; `to`: unit, from the sample to the wall's foot.
double wallShare(const PinholeCamera& camera, vec2 pixel, vec3 normal, vec3 to) {
    const vec3 view = directionAt(camera, pixel);
    double sum = 0;
    for (int i = 0; i < kTurns; ++i) {
        double taken = 0, whole = 0;
        for (int number = 0; number < kContactSlices; ++number) {
            const ContactSlice slice =
                contactSlice(-view, contactWay(camera, view, number, turnOf(i)).tangent, normal, normal);
            whole += contactWhole(slice);
            for (const float sign : {-1.0f, 1.0f}) {
                // The first direction, from the viewer's on, that meets the wall: those do that are as near to `to`
                // as to the normal.
                const float angle = atan(dot(slice.toViewer, normal - to), sign * dot(slice.tangent, to - normal));
                const vec3 edge = slice.toViewer * cos(angle) + slice.tangent * (sign * sin(angle));
                ContactSide side = contactSide(slice, sign);
                taken += slice.weight * raiseHorizon(side, slice, normal, edge, 1e9f, 1.0f);
            }
        }
        sum += taken / whole;
    }
    return sum / kTurns;
}

// Two slices, as in the pictures. With even ways on the screen it is up to 22 % more or 15 % less at the edge.
TEST(ContactWay, aWallTakesItsFormFactorAllOverThePicture) {
    const PinholeCamera camera = wideCamera();
    const double wanted = 0.5 * (1 - std::sqrt(0.5));
    const vec3 back = normalize(cross(camera.pixelDown, camera.pixelRight));
    for (const vec2 pixel : kPixels)
        for (const vec3 normal : {back, -directionAt(camera, pixel)}) {
            const vec3 down = normalize(cross(camera.pixelRight, normal)), right = cross(normal, down);
            for (const vec3 to : {right, down, -down}) {
                // Not what hides the sample.
                if (dot(-directionAt(camera, pixel), to - normal) > 0) continue;
                EXPECT_NEAR(wallShare(camera, pixel, normal, to), wanted, 0.02 * wanted) << pixel.x << ' ' << pixel.y;
            }
        }
}

// The last step meets the reach, on a plane across the viewer's direction.
TEST(ContactWay, theLastStepMeetsTheReachAllOverThePicture) {
    const PinholeCamera camera = wideCamera();
    const vec3 axis = normalize(cross(camera.pixelRight, camera.pixelDown));
    for (const vec2 pixel : kPixels)
        for (const float share : {0.01f, 0.1f, 0.3f}) {
            const vec3 view = directionAt(camera, pixel);
            const float cosine = dot(view, axis), part = share * std::sqrt(1 / (cosine * cosine) - 1);
            for (int i = 0; i < kTurns; i += 5) {
                const ContactWay way = contactWay(camera, view, 0, turnOf(i));
                const float last = contactStep(kContactSteps - 1, 1.0f, contactWidest(way, 5.0f, 5.0f * share));
                for (const float sign : {-1.0f, 1.0f}) {
                    const vec3 seen = directionAt(camera, pixel + sign * last * way.across);
                    const float met = length(seen / dot(seen, view) - view) / share;
                    EXPECT_NEAR(met, 1.0f, part / (1 - part) + 1e-3f) << pixel.x << ' ' << pixel.y << ' ' << share;
                }
            }
        }
}

// A camera on a surface: steps leave the picture, and stay integers.
TEST(ContactWay, isNeverWiderThanPicturesAre) {
    const PinholeCamera camera = wideCamera();
    const ContactWay way = contactWay(camera, directionAt(camera, {1919, 3}), 1, 0.7f);
    using Limits = std::numeric_limits<float>;
    for (const float near : {0.0f, Limits::denorm_min(), Limits::min(), 1e-9f}) {
        EXPECT_EQ(contactWidest(way, near, 1.0f), kContactWidest) << near;
        EXPECT_EQ(contactStep(kContactSteps - 1, 1.0f, contactWidest(way, near, 1.0f)), kContactWidest) << near;
    }
    EXPECT_EQ(contactWidest(way, 2.0f, 0.01f), 0.01f * way.pixels / 2.0f);
}

}  // namespace
}  // namespace probegi::kernels

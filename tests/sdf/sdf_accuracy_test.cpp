#include <gmock/gmock.h>

#include "sdf/fit_scenes.h"

namespace probegi {
namespace {

using test::BoxScene;

Result<SdfAccuracy> measure(const BoxScene& world, const SdfScene& sdf, int rays = 20'000) {
    return measureSdf(Context::create().value(), world.scene, world.pose, *world.tracer, sdf, rays);
}

/// A cube of a metre on a floor.
Scene cubeOnFloor() {
    Scene scene;
    const int material = test::addMaterial(scene, "", glm::vec3(0.5f));
    test::addSolidBox(scene, material, {-4, -1, -4}, {4, 0, 4});
    test::addSolidBox(scene, material, {-0.5f, 0, -0.5f}, {0.5f, 1, 0.5f});
    return scene;
}
SdfScene sameInPrimitives() {
    return {{test::boxBetween({-4, -1, -4}, {4, 0, 4}), test::boxBetween({-0.5f, 0, -0.5f}, {0.5f, 1, 0.5f})}};
}

TEST(MeasureSdf, findsNoFaultInTheSceneItself) {
    const SdfAccuracy a = measure(BoxScene(cubeOnFloor()), sameInPrimitives()).value();
    EXPECT_EQ(a.rays, 20'000);
    EXPECT_LT(a.toPrimitives, 1e-5);
    EXPECT_LT(a.toScene, 1e-5);
    EXPECT_EQ(a.leaking, 0);
    EXPECT_LT(a.blockedSky, 2e-4);
    EXPECT_EQ(a.startInside, 0);
    EXPECT_GT(a.skyRays, 0.2);
    EXPECT_LT(a.skyRays, 0.9);
}

// The walls of a room, which is seen from inside only, 0.1 m too far out.
TEST(MeasureSdf, findsAnOffsetBothWays) {
    const SdfScene farther{{test::boxBetween({-2, -2, -2}, {-0.1f, 5, 7}), test::boxBetween({6.1f, -2, -2}, {8, 5, 7}),
                            test::boxBetween({-2, -2, -2}, {8, -0.1f, 7}), test::boxBetween({-2, 3.1f, -2}, {8, 5, 7}),
                            test::boxBetween({-2, -2, -2}, {8, 5, -0.1f}),
                            test::boxBetween({-2, -2, 5.1f}, {8, 5, 7})}};
    const SdfAccuracy a = measure(BoxScene(test::roomScene(false)), farther).value();
    EXPECT_NEAR(a.toPrimitives, 0.1, 1e-4);
    EXPECT_NEAR(a.toScene, 0.1, 1e-3);
    EXPECT_EQ(a.leaking, 0);
}

// All within its bounds is matter.
TEST(MeasureSdf, looksAtASingleBodyFromAround) {
    Scene scene;
    test::addSolidBox(scene, test::addMaterial(scene, "", glm::vec3(0.5f)), {3, 4, 5}, {4, 6, 5.5f});
    const SdfAccuracy a = measure(BoxScene(scene), {{test::boxBetween({3, 4, 5}, {4, 6, 5.5f})}}).value();
    EXPECT_GT(a.rays, 1000);
    EXPECT_LT(a.toPrimitives, 1e-5);
    EXPECT_EQ(a.leaking, 0);
}

TEST(MeasureSdf, tellsWhatIsMissingAndWhatIsInTheWay) {
    const BoxScene world(cubeOnFloor());
    const SdfAccuracy nothing = measure(world, {}).value();
    EXPECT_NEAR(nothing.leaking, 1 - nothing.skyRays, 1e-9);
    EXPECT_EQ(nothing.toScene, 0);
    const SdfAccuracy all = measure(world, {{test::boxBetween(glm::vec3(-10), glm::vec3(10))}}).value();
    EXPECT_EQ(all.startInside, 1);
    EXPECT_EQ(all.blockedSky, 1);
    EXPECT_EQ(all.leaking, 0);
}

/// The room of test::roomScene(true), exactly; but with its window closed, or without its ceiling.
SdfScene roomInPrimitives(bool window, bool ceiling) {
    SdfScene room{{test::boxBetween({-0.2f, -0.2f, -0.2f}, {6.2f, 0, 5.2f}),
                   test::boxBetween({-0.2f, 0, -0.2f}, {0, 3, 5.2f}), test::boxBetween({0, 0, -0.2f}, {6.2f, 3, 0}),
                   test::boxBetween({0, 0, 5}, {6.2f, 3, 5.2f}), test::boxBetween({6, 0, 0}, {6.2f, 1, 5}),
                   test::boxBetween({6, 2, 0}, {6.2f, 3, 5}), test::boxBetween({6, 1, 0}, {6.2f, 2, 1.5f}),
                   test::boxBetween({6, 1, 3.5f}, {6.2f, 2, 5})}};
    if (!window) room.primitives.push_back(test::boxBetween({6, 1, 1.5f}, {6.2f, 2, 3.5f}));
    if (ceiling) room.primitives.push_back(test::boxBetween({-0.2f, 3, -0.2f}, {6.2f, 3.2f, 5.2f}));
    return room;
}

// Of all rays few leave a room, but they are its light.
TEST(MeasureSdf, tellsHowMuchOfItsSkyARoomLosesAndGains) {
    const BoxScene world(test::roomScene(true));
    const SdfAccuracy same = measure(world, roomInPrimitives(true, true)).value();
    EXPECT_GT(same.dimRays, 0.3);
    EXPECT_GT(same.dimSkyRays, 0);
    EXPECT_LT(same.dimSkyRays, 0.1 * same.dimRays);
    EXPECT_LT(same.dimBlockedSky, 0.02);
    EXPECT_LT(same.dimLeaking, 0.02);
    const SdfAccuracy closed = measure(world, roomInPrimitives(false, true)).value();
    EXPECT_EQ(closed.dimSkyRays, same.dimSkyRays);
    EXPECT_GT(closed.dimBlockedSky, 0.9);
    EXPECT_LT(closed.dimLeaking, 0.02);
    const SdfAccuracy open = measure(world, roomInPrimitives(true, false)).value();
    EXPECT_LT(open.dimBlockedSky, 0.02);
    EXPECT_GT(open.dimLeaking, 1);
}

TEST(MeasureSdf, knowsNoDimSkyWhereThereIsNone) {
    const SdfAccuracy a = measure(BoxScene(test::roomScene(false)), roomInPrimitives(true, true)).value();
    EXPECT_EQ(a.dimSkyRays, 0);
    EXPECT_EQ(a.dimBlockedSky, 0);
    EXPECT_EQ(a.dimLeaking, 0);
}

TEST(MeasureSdf, refusesANumberOfRaysOutOfRange) {
    const BoxScene world(cubeOnFloor());
    EXPECT_THAT(measure(world, {}, 10).error().message, testing::HasSubstr("rays is 10"));
}

}  // namespace
}  // namespace probegi

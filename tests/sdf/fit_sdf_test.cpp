#include <gmock/gmock.h>

#include <atomic>

#include "sdf/fit_scenes.h"

namespace probegi {
namespace {

using test::BoxScene;
using test::quickFit;
using test::roomScene;
using testing::HasSubstr;

Context context(int threads = 2) {
    return Context::create({.threads = threads}).value();
}

Result<SdfFit> fit(const BoxScene& world, const SdfFitDesc& desc) {
    return fitSdf(context(), world.scene, world.pose, *world.tracer, desc);
}

TEST(FitSdf, findsTheWallsOfASealedRoomWhichStaysSealed) {
    const BoxScene world(roomScene(false));
    const SdfFit found = fit(world, quickFit(12)).value();
    EXPECT_LT(found.accuracy.toPrimitives, 0.005);
    EXPECT_LT(found.accuracy.toScene, 0.005);
    EXPECT_LE(found.accuracy.leaking, 1e-4);
    // From inside nothing is seen but walls, whatever the direction.
    for (int i = 0; i < 1000; ++i) {
        const float z = -1 + 2 * (float(i) + 0.5f) / 1000, phi = 2.399963f * float(i), r = std::sqrt(1 - z * z);
        const glm::vec3 direction(r * std::cos(phi), z, r * std::sin(phi));
        float t = 0;
        for (int step = 0; step < 256 && t < 20; ++step)
            t += std::max(signedDistance(found.sdf, glm::vec3(3, 1.5f, 2.5f) + t * direction), 1e-4f);
        ASSERT_LT(t, 20) << i;
    }
}

/// More rays, for a window is a small part of all that they see.
SdfFitDesc windowFit() {
    SdfFitDesc desc = quickFit(16);
    desc.rays = 40'000;
    return desc;
}

TEST(FitSdf, leavesAWindowOpen) {
    const BoxScene world(roomScene(true));
    const SdfFit found = fit(world, windowFit()).value();
    EXPECT_LT(found.accuracy.toPrimitives, 0.01);
    EXPECT_LT(found.accuracy.leaking, 1e-3);
    EXPECT_LT(found.accuracy.blockedSky, 0.02);
    EXPECT_GT(signedDistance(found.sdf, {6.1f, 1.5f, 2.5f}), 0.4f);
    EXPECT_LT(signedDistance(found.sdf, {6.1f, 0.5f, 2.5f}), 0.0f);
}

// Without the estimate of the walls' axes the error grows many times over.
TEST(FitSdf, fitsARoomThatStandsObliquelyAsWell) {
    const BoxScene upright(roomScene(true)), oblique(test::turned(roomScene(true), 30));
    const SdfFit a = fit(upright, windowFit()).value(), b = fit(oblique, windowFit()).value();
    EXPECT_LT(b.accuracy.toPrimitives, 1.1 * a.accuracy.toPrimitives + 0.002);
    EXPECT_LT(b.accuracy.blockedSky, 0.02);
}

TEST(FitSdf, givesColoursEmissionAndNames) {
    Scene scene = roomScene(false);
    const int lamp = test::addMaterial(scene, "lamp", {0, 0, 0}, {5, 4, 3});
    test::addSolidBox(scene, lamp, {2.5f, 2.9f, 2}, {3.5f, 3, 3});
    const SdfFit found = fit(BoxScene(scene), quickFit(12)).value();
    const auto named = [&](const char* name) {
        const auto& all = found.sdf.primitives;
        return std::find_if(all.begin(), all.end(), [&](const SdfPrimitive& p) { return p.name == name; });
    };
    ASSERT_NE(named("lamp 1"), found.sdf.primitives.end());
    ASSERT_NE(named("floor 1"), found.sdf.primitives.end());
    EXPECT_NEAR(named("floor 1")->albedo.y, 0.3f, 0.01f);
    EXPECT_NEAR(named("lamp 1")->emission.x, 5.0f, 0.2f);
    EXPECT_NEAR(named("floor 1")->emission.x, 0.0f, 0.05f);
}

TEST(FitSdf, takesNoMorePrimitivesThanHelp) {
    const BoxScene world(roomScene(false));
    const std::size_t many = fit(world, quickFit(200)).value().sdf.primitives.size();
    EXPECT_GE(many, 6u);
    EXPECT_LE(many, 60u);
    EXPECT_EQ(fit(world, quickFit(1)).value().sdf.primitives.size(), 1u);
}

TEST(FitSdf, keepsWhatIsPinnedAndFitsTheRestAroundIt) {
    const BoxScene world(roomScene(false));
    SdfScene keep;
    keep.primitives.push_back(test::boxBetween({-0.2f, -0.2f, -0.2f}, {6.2f, 0, 5.2f}));
    keep.primitives.push_back(test::boxBetween({100, 100, 100}, {101, 101, 101}));
    keep.primitives[0].name = "my floor";
    keep.primitives[0].albedo = {0.9f, 0.1f, 0.2f};
    keep.primitives[0].pinned = true;
    SdfFitDesc desc = quickFit(12);
    desc.keep = &keep;
    const SdfFit found = fit(world, desc).value();
    ASSERT_FALSE(found.sdf.primitives.empty());
    const SdfPrimitive& floor = found.sdf.primitives.front();
    EXPECT_EQ(floor.name, "my floor");
    EXPECT_TRUE(floor.pinned);
    EXPECT_EQ(floor.albedo, glm::vec3(0.9f, 0.1f, 0.2f));
    EXPECT_EQ(floor.halfSize, keep.primitives[0].halfSize);
    EXPECT_LT(found.accuracy.toPrimitives, 0.005);
    EXPECT_LE(found.sdf.primitives.size(), 12u);
    for (const SdfPrimitive& p : found.sdf.primitives) {
        EXPECT_LT(p.centre.x, 50.0f);  // what is not pinned goes
        if (!p.pinned) {
            EXPECT_FALSE(p.centre.y + p.halfSize.y < 0.01f) << p.name << " lies under the floor";
        }
    }
}

TEST(FitSdf, isTheSameForAnyNumberOfThreads) {
    const BoxScene world(roomScene(true));
    const SdfFitDesc desc = quickFit(8);
    const SdfFit one = fitSdf(context(1), world.scene, world.pose, *world.tracer, desc).value();
    const SdfFit four = fitSdf(context(4), world.scene, world.pose, *world.tracer, desc).value();
    ASSERT_EQ(one.sdf.primitives.size(), four.sdf.primitives.size());
    for (std::size_t i = 0; i < one.sdf.primitives.size(); ++i) {
        EXPECT_EQ(one.sdf.primitives[i].centre, four.sdf.primitives[i].centre);
        EXPECT_EQ(one.sdf.primitives[i].halfSize, four.sdf.primitives[i].halfSize);
        EXPECT_EQ(one.sdf.primitives[i].albedo, four.sdf.primitives[i].albedo);
    }
    EXPECT_EQ(one.accuracy.toPrimitives, four.accuracy.toPrimitives);
}

TEST(FitSdf, refusesWhatIsOutOfRangeByName) {
    const BoxScene world(roomScene(false));
    const auto refused = [&](auto change) {
        SdfFitDesc desc = quickFit(4);
        change(desc);
        const auto done = fit(world, desc);
        EXPECT_FALSE(done);
        return done ? std::string() : done.error().message;
    };
    EXPECT_THAT(refused([](SdfFitDesc& d) { d.maxPrimitives = 0; }), HasSubstr("maxPrimitives is 0"));
    EXPECT_THAT(refused([](SdfFitDesc& d) { d.maxPrimitives = 1025; }), HasSubstr("1 to 1024"));
    EXPECT_THAT(refused([](SdfFitDesc& d) { d.rays = 999; }), HasSubstr("rays is 999"));
    EXPECT_THAT(refused([](SdfFitDesc& d) { d.rounds = -1; }), HasSubstr("rounds is -1"));
    SdfScene keep;
    keep.primitives.assign(5, test::boxBetween(glm::vec3(0), glm::vec3(1)));
    for (SdfPrimitive& p : keep.primitives) p.pinned = true;
    EXPECT_THAT(refused([&](SdfFitDesc& d) { d.keep = &keep; }), HasSubstr("5 primitives are pinned"));
    keep.primitives.resize(1);
    keep.primitives[0].node = "no such node";
    EXPECT_THAT(refused([&](SdfFitDesc& d) { d.keep = &keep; }), HasSubstr("no such node"));
}

TEST(FitSdf, refusesASceneWithoutSurfaces) {
    const BoxScene world{Scene{}};
    const auto done = fit(world, quickFit(4));
    ASSERT_FALSE(done);
    EXPECT_EQ(done.error().code, ErrorCode::invalidArgument);
    EXPECT_THAT(done.error().message, HasSubstr("no surface"));
}

TEST(FitSdf, canBeCancelled) {
    const BoxScene world(roomScene(false));
    ContextDesc desc;
    desc.progress = [](const ProgressReport&) { return false; };
    const auto done = fitSdf(Context::create(desc).value(), world.scene, world.pose, *world.tracer, quickFit(8));
    ASSERT_FALSE(done);
    EXPECT_EQ(done.error().code, ErrorCode::cancelled);
}

}  // namespace
}  // namespace probegi

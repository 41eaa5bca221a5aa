// The guide as a density: whatever its contents, it must integrate to one and be the density of sample().
#include "reference/path_guide.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "kernels/sampling.h"
#include "probegi/builtin_scenes.h"
#include "support/reference_world.h"

namespace probegi {
namespace {

using namespace test;

/// Three boxes of different shape and strength around the origin; the other lanes have the first box with strength 0.
PathGuide::Block threeBoxes() {
    const glm::vec3 lower[3] = {{2, -1, -1}, {-1, 2, 0}, {-3, -0.5f, -2}};
    const glm::vec3 upper[3] = {{2.5f, 1, 0.5f}, {1, 2.2f, 1.5f}, {-2, 0.5f, 2}};
    const float strength[3] = {1, 4, 0.5f};
    PathGuide::Block block{};
    for (int lane = 0; lane < PathGuide::kLanes; ++lane) {
        const int i = lane < 3 ? lane : 0;
        for (int axis = 0; axis < 3; ++axis) {
            block.lower[axis][lane] = lower[i][axis];
            block.upper[axis][lane] = upper[i][axis];
        }
        block.strength[lane] = lane < 3 ? strength[i] : 0.0f;
    }
    return block;
}

PathGuide threeBoxGuide(float background) {
    PathGuide guide(VolumeDesc{.origin = glm::vec3(-5.0f), .spacing = glm::vec3(10.0f), .counts = glm::ivec3(2)});
    for (std::size_t i = 0; i < guide.regionCount(); ++i) guide.setRegion(i, {threeBoxes()}, background);
    return guide;
}

TEST(PathGuide, densityIntegratesToOne) {
    const PathGuide guide = threeBoxGuide(0.1f);
    PathGuide::Mixture mixture;
    // Outside all boxes, and inside one.
    for (const glm::vec3 position : {glm::vec3(0.1f, 0.2f, -0.3f), glm::vec3(-2.5f, 0.1f, 0.2f)}) {
        guide.mixtureAt(position, glm::normalize(glm::vec3(0.3f, 1, 0.2f)), mixture);
        ASSERT_GT(mixture.share, 0);
        Random random(7, 0);
        double sum = 0;
        constexpr int kSamples = 400000;
        for (int i = 0; i < kSamples; ++i)
            sum += double(PathGuide::pdf(mixture, position, kernels::sampleSphere(random.nextPair())));
        EXPECT_NEAR(sum / kSamples * 4 * 3.14159265, 1.0, 0.02);
    }
}

/// The mean of g / density over samples is the integral of g over the directions that boxes cover.
TEST(PathGuide, samplesFollowTheDensity) {
    const PathGuide guide = threeBoxGuide(0.1f);
    const glm::vec3 position(0.1f, 0.2f, -0.3f);
    PathGuide::Mixture mixture;
    guide.mixtureAt(position, glm::vec3(0, 1, 0), mixture);
    ASSERT_GT(mixture.share, 0);
    const auto g = [&](glm::vec3 d) {
        const double p = double(PathGuide::pdf(mixture, position, d));
        return p * (1.5 + double(d.x) + 2 * double(d.y) * double(d.z));  // 0 where the density is 0
    };
    Random random(3, 1);
    double expected = 0, found = 0;
    constexpr int kSamples = 400000;
    for (int i = 0; i < kSamples; ++i) {
        expected += g(kernels::sampleSphere(random.nextPair())) * 4 * 3.14159265 / kSamples;
        const glm::vec3 d = PathGuide::sample(mixture, position, random.next(), random.nextPair(), random.next());
        EXPECT_NEAR(glm::length(d), 1.0f, 1e-5f);
        const double p = double(PathGuide::pdf(mixture, position, d));
        if (p > 0) found += g(d) / p / kSamples;
    }
    EXPECT_NEAR(found, expected, 0.03 * expected);
}

TEST(PathGuide, seenShareOfABoxFarAwayIsItsSolidAngle) {
    PathGuide::Block block = threeBoxes();
    for (int axis = 0; axis < 3; ++axis) {
        block.lower[axis][0] = axis == 1 ? 20.0f : -1.0f;
        block.upper[axis][0] = axis == 1 ? 20.1f : 1.0f;
    }
    float shares[PathGuide::kLanes];
    PathGuide::seenShares(block, glm::vec3(0.0f), glm::vec3(0, 1, 0), shares);
    EXPECT_NEAR(shares[0], 4.0f / (20.05f * 20.05f) / 3.14159265f, 5e-5f);
    PathGuide::seenShares(block, glm::vec3(0.0f), glm::vec3(0, -1, 0), shares);
    EXPECT_EQ(shares[0], 0.0f);  // below the horizon
}

TEST(PathGuide, withoutBoxesOrInTheDarkThereIsNothingToFollow) {
    PathGuide guide(VolumeDesc{});
    PathGuide::Mixture mixture;
    guide.mixtureAt({1e6f, -1e6f, 0}, {0, 0, -1}, mixture);  // far outside the grid
    EXPECT_EQ(mixture.share, 0);
    PathGuide::Block dark = threeBoxes();
    for (float& strength : dark.strength) strength = 0;
    guide.setRegion(guide.regionOf({0, 0, 0}, {0, 1, 0}), {dark}, 0.0f);
    guide.mixtureAt({0, 0, 0}, {0, 1, 0}, mixture);
    EXPECT_EQ(mixture.share, 0);
}

/// A field over a scene, updated a few times.
Field fieldOver(const ReferenceWorld& world, int updates, VolumeDesc grid) {
    Field field = std::move(*Field::create(world.context, {.volumes = {grid}, .raysPerProbe = 64}));
    for (int i = 0; i < updates; ++i) EXPECT_TRUE(field.update(*world.tracer, world.lighting));
    return field;
}

/// Mean of the picture's 8x5 blocks and its variance, by luminance of the red channel.
void expectBlocksAgree(const ReferencePicture& a, const ReferencePicture& b) {
    const HdrImage& image = a.picture.color;
    int apart = 0;
    for (int by = 0; by < 5; ++by)
        for (int bx = 0; bx < 8; ++bx) {
            double difference = 0, variance = 0;
            for (int y = by * image.height / 5; y < (by + 1) * image.height / 5; ++y)
                for (int x = bx * image.width / 8; x < (bx + 1) * image.width / 8; ++x) {
                    const std::size_t i = std::size_t(y) * std::size_t(image.width) + std::size_t(x);
                    difference += double(b.picture.color.pixels[i].x) - double(a.picture.color.pixels[i].x);
                    variance += std::pow(double(a.standardError.pixels[i].x), 2) +
                                std::pow(double(b.standardError.pixels[i].x), 2);
                }
            if (std::abs(difference) > 3 * std::sqrt(variance)) ++apart;
        }
    // Of 40 independent blocks, 0.11 are expected beyond 3 standard errors, and two or more in one of 200 runs.
    EXPECT_LE(apart, 1);
}

/// Mean over the pixels of the variance relative to the pixel's own square.
double relativeVariance(const ReferencePicture& picture) {
    double sum = 0;
    for (std::size_t i = 0; i < picture.standardError.pixels.size(); ++i) {
        const double own = double(picture.picture.color.pixels[i].x), error = double(picture.standardError.pixels[i].x);
        sum += error * error / (own * own + 1e-4);
    }
    return sum / double(picture.standardError.pixels.size());
}

ReferenceDesc pictureOf(const ReferenceWorld& world, int samples) {
    ReferenceDesc desc;
    desc.picture = {.camera = world.pose.cameras.front(), .width = 64, .height = 40};
    desc.samplesPerPixel = samples;
    return desc;
}

class GuidedPicture : public testing::TestWithParam<const char*> {};

TEST_P(GuidedPicture, agreesWithTheUnguidedInEveryBlock) {
    const ReferenceWorld world(std::move(*makeBuiltinScene(GetParam())), 2);
    const Field field = fieldOver(world, 4, *placeVolume(world.pose.bounds, {.targetProbes = 1024}));
    const PathTracer tracer = world.pathTracer();
    ReferenceDesc desc = pictureOf(world, 64);
    const auto plain = tracer.render(desc);
    desc.guide = &field;
    desc.seed = 2;
    const auto guided = tracer.render(desc);
    ASSERT_TRUE(plain && guided);
    EXPECT_EQ(plain->guideSeconds, 0);
    EXPECT_GT(guided->guideSeconds, 0);
    for (const glm::vec3& c : guided->picture.color.pixels) ASSERT_TRUE(std::isfinite(c.x + c.y + c.z));
    expectBlocksAgree(*plain, *guided);
    // Measured 0.67 (house) and 0.63 (two-rooms).
    EXPECT_LT(relativeVariance(*guided), 0.8 * relativeVariance(*plain));
}

INSTANTIATE_TEST_SUITE_P(scenes, GuidedPicture, testing::Values("house", "two-rooms"),
                         [](const auto& scene) { return scene.index == 0 ? "house" : "twoRooms"; });

TEST(Guided, sameBitsForOneAndTwoThreads) {
    std::vector<glm::vec3> pictures[2];
    for (int i = 0; i < 2; ++i) {
        const ReferenceWorld world(std::move(*makeBuiltinScene("two-rooms")), i + 1);
        const Field field = fieldOver(world, 2, *placeVolume(world.pose.bounds, {.targetProbes = 512}));
        ReferenceDesc desc = pictureOf(world, 4);
        desc.guide = &field;
        pictures[i] = world.pathTracer().render(desc)->picture.color.pixels;
    }
    EXPECT_EQ(pictures[0], pictures[1]);
}

/// A field that was never updated, and one whose grid is elsewhere, are bad guides but change no mean.
TEST(Guided, aBlackOrMisplacedFieldIsHarmless) {
    const ReferenceWorld world(std::move(*makeBuiltinScene("two-rooms")), 2);
    const VolumeDesc placed = *placeVolume(world.pose.bounds, {.targetProbes = 512});
    VolumeDesc elsewhere = placed;
    elsewhere.origin += glm::vec3(1000.0f);
    const PathTracer tracer = world.pathTracer();
    ReferenceDesc desc = pictureOf(world, 64);
    const auto plain = tracer.render(desc);
    desc.seed = 2;
    for (const VolumeDesc& grid : {placed, elsewhere}) {
        const Field field = fieldOver(world, grid.origin == placed.origin ? 0 : 2, grid);
        desc.guide = &field;
        const auto guided = tracer.render(desc);
        ASSERT_TRUE(plain && guided);
        for (const glm::vec3& c : guided->picture.color.pixels) ASSERT_TRUE(std::isfinite(c.x + c.y + c.z));
        expectBlocksAgree(*plain, *guided);
    }
}

/// A field of different light expects it in the wrong places: bright where it is dark, and vice versa.
TEST(Guided, aFieldOfOtherLightIsHarmless) {
    const ReferenceWorld world(std::move(*makeBuiltinScene("house")), 2);
    Lighting other;
    other.sky.radiance = glm::vec3(0.001f, 0, 0);
    other.lights.push_back(world.lighting.lights.front());
    other.lights.front().direction = {0, 1, 0};
    Field field = std::move(*Field::create(
        world.context, {.volumes = {*placeVolume(world.pose.bounds, {.targetProbes = 1024})}, .raysPerProbe = 64}));
    for (int i = 0; i < 3; ++i) ASSERT_TRUE(field.update(*world.tracer, other));
    const PathTracer tracer = world.pathTracer();
    ReferenceDesc desc = pictureOf(world, 64);
    const auto plain = tracer.render(desc);
    desc.guide = &field;
    desc.seed = 2;
    const auto guided = tracer.render(desc);
    ASSERT_TRUE(plain && guided);
    for (const glm::vec3& c : guided->picture.color.pixels) ASSERT_TRUE(std::isfinite(c.x + c.y + c.z));
    expectBlocksAgree(*plain, *guided);
}

}  // namespace
}  // namespace probegi

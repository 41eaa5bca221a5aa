#include "sdf/fit/fit_light.h"

#include <gtest/gtest.h>

#include "kernels/random.h"

namespace probegi {
namespace {

const glm::mat3 kWorld(1.0f);

/// Rays from all over a cube of 2 m around the origin that meet a surface 1 cm away; but for a share of them, which
/// see the sky: `dim` of those where x < 0, `bright` of the others.
std::vector<FitRay> raysOfTwoHalves(float dim, float bright) {
    std::vector<FitRay> rays;
    std::uint32_t state = 3;
    const auto random = [&] { return kernels::nextRandom(state); };
    for (int i = 0; i < 20'000; ++i) {
        FitRay ray;
        ray.origin.x = 2 * random() - 1;
        ray.origin.y = 2 * random() - 1;
        ray.origin.z = 2 * random() - 1;
        ray.direction = {0, 1, 0};
        ray.distance = random() < (ray.origin.x < 0 ? dim : bright) ? kFitSky : 0.01f;
        rays.push_back(ray);
    }
    return rays;
}

double meanLight(std::span<const FitRay> rays, std::span<const float> light, bool dim) {
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if ((rays[i].origin.x < 0) != dim) continue;
        sum += double(light[i]);
        ++count;
    }
    return sum / count;
}

/// The light L where a share s of all rays sees the sky, and the others the same place: L = s + (1 - s) L / 2.
double lightWhere(double sky) {
    return sky / (1 - (1 - sky) / 2);
}

TEST(FitLight, isWhatSkyAndBouncesBring) {
    const auto rays = raysOfTwoHalves(0.1f, 0.6f);
    const auto light = lightOfStarts(rays, kWorld);
    ASSERT_EQ(light.size(), rays.size());
    EXPECT_NEAR(meanLight(rays, light, true), lightWhere(0.1), 0.02);
    EXPECT_NEAR(meanLight(rays, light, false), lightWhere(0.6), 0.02);
}

TEST(FitLight, isTheSameInAnyFrame) {
    const glm::mat3 frame(glm::vec3(0.6f, 0, 0.8f), glm::vec3(0, 1, 0), glm::vec3(-0.8f, 0, 0.6f));
    const auto rays = raysOfTwoHalves(0.05f, 0.9f);
    const auto turned = raysIn(glm::transpose(frame), rays);
    const auto light = lightOfStarts(turned, frame);
    EXPECT_NEAR(meanLight(rays, light, true), lightWhere(0.05), 0.02);
    EXPECT_NEAR(meanLight(rays, light, false), lightWhere(0.9), 0.02);
}

TEST(FitLight, isNoneWhereNoSkyIsSeen) {
    for (const float light : lightOfStarts(raysOfTwoHalves(0, 0), kWorld)) ASSERT_EQ(light, 0);
}

TEST(FitLight, doesWithoutRays) {
    EXPECT_TRUE(lightOfStarts({}, kWorld).empty());
}

}  // namespace
}  // namespace probegi

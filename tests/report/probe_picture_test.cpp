#include "report/probe_picture.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace probegi::tool {
namespace {

TEST(ProbeStates, ByWhatTheProbesSee) {
    std::vector<ProbeSight> probes(20, {0.0f, 10.0f});
    probes[1] = {0.31f, 0.0f};
    probes[2] = {0.1f, 10.0f};
    probes[3] = {0.0f, 1e-5f};
    const std::vector<ProbeState> states = probeStates(probes);
    EXPECT_EQ(states[0], ProbeState::open);
    EXPECT_EQ(states[1], ProbeState::inWall);
    EXPECT_EQ(states[2], ProbeState::besideWall);
    EXPECT_EQ(states[3], ProbeState::dark);
    EXPECT_EQ(probeStates(std::vector<ProbeSight>(2))[0], ProbeState::dark) << "no light at all";
}

/// One probe, 5 m ahead of a camera that looks along -Z, in front of or behind a wall.
class DrawProbes : public testing::Test {
protected:
    HdrImage draw(float wallDistance, ProbeState state) const {
        Picture picture;
        picture.color = HdrImage(65, 65, glm::vec3(0.2f));
        picture.depth = HdrImage(65, 65, glm::vec3(wallDistance));
        PlacedCamera camera = lookAt({0, 0, 5}, {0, 0, 0}, 0.5f);
        const VolumeDesc grid{{0, 0, 0}, glm::vec3(2), {1, 1, 1}};
        return drawProbes(picture, 1, camera, grid, std::span(&state, 1));
    }
    /// Pixels that differ from the corner, where there is no probe.
    static int drawn(const HdrImage& image) {
        return int(std::count_if(image.pixels.begin(), image.pixels.end(),
                                 [&](const glm::vec3& p) { return glm::distance(p, image.at(0, 0)) > 1e-4f; }));
    }
};

TEST_F(DrawProbes, ABallOfItsStatesColourInTheMiddle) {
    const HdrImage open = draw(8, ProbeState::open), wall = draw(8, ProbeState::inWall);
    EXPECT_GT(open.at(32, 32).y, 2 * open.at(32, 32).x);
    EXPECT_GT(wall.at(32, 32).x, 2 * wall.at(32, 32).y);
    // Radius 0.09 of 2 m at 5 m: 0.18 / 5 * 32.5 / tan(0.25) pixels = 4.58, area 66.
    EXPECT_NEAR(drawn(open), 66, 8);
}

TEST_F(DrawProbes, SurfacesHideAllButThoseInWalls) {
    EXPECT_EQ(drawn(draw(3, ProbeState::open)), 0);
    EXPECT_EQ(drawn(draw(3, ProbeState::dark)), 0);
    const HdrImage through = draw(3, ProbeState::inWall), front = draw(8, ProbeState::inWall);
    EXPECT_GT(drawn(through), 50);
    EXPECT_LT(through.at(32, 32).x, front.at(32, 32).x);
    EXPECT_GT(drawn(draw(0, ProbeState::open)), 50) << "depth 0 is the sky";
}

}  // namespace
}  // namespace probegi::tool

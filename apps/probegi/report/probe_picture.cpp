#include "report/probe_picture.h"

#include <algorithm>
#include <vector>

#include "probe_balls.h"
#include "probegi/measure.h"

namespace probegi::tool {

namespace {

constexpr float kInWall = 0.3f, kBesideWall = 0.02f, kDark = 1e-4f;

struct Look {
    const char* name;
    const char* css;
    glm::vec3 display;
};

const Look& lookOf(ProbeState state) {
    static constexpr Look kLooks[kProbeStates] = {{"in the open", "#35c46a", {0.21f, 0.77f, 0.42f}},
                                                  {"beside a wall", "#f2c530", {0.95f, 0.77f, 0.19f}},
                                                  {"in the dark", "#4f7dff", {0.31f, 0.49f, 1.0f}},
                                                  {"in a wall, not used", "#ef4136", {0.94f, 0.25f, 0.21f}}};
    return kLooks[std::size_t(state)];
}

}  // namespace

const char* nameOf(ProbeState state) {
    return lookOf(state).name;
}

const char* colourOf(ProbeState state) {
    return lookOf(state).css;
}

std::vector<ProbeState> probeStates(std::span<const ProbeSight> probes) {
    double sum = 0;
    std::size_t lit = 0;
    for (const ProbeSight& probe : probes)
        if (probe.irradiance > 0 && probe.backfaceShare <= kInWall) sum += probe.irradiance, ++lit;
    const float dark = lit > 0 ? kDark * float(sum / double(lit)) : 0;
    std::vector<ProbeState> states;
    for (const ProbeSight& probe : probes)
        states.push_back(probe.backfaceShare > kInWall       ? ProbeState::inWall
                         : probe.irradiance <= dark          ? ProbeState::dark
                         : probe.backfaceShare > kBesideWall ? ProbeState::besideWall
                                                             : ProbeState::open);
    return states;
}

HdrImage drawProbes(const Picture& picture, float exposure, const PlacedCamera& camera, const VolumeDesc& grid,
                    std::span<const ProbeState> states) {
    HdrImage shown = picture.color;
    for (glm::vec3& pixel : shown.pixels) pixel = 0.55f * toDisplay(pixel, {exposure, true});
    const float radius = kBallRadius * std::min({grid.spacing.x, grid.spacing.y, grid.spacing.z});
    std::vector<Ball> balls;
    for (std::size_t probe = 0; probe < states.size(); ++probe)
        balls.push_back({probePosition(grid, int(probe)), radius, lookOf(states[probe]).display,
                         states[probe] == ProbeState::inWall});
    drawBalls(shown, picture.depth, camera, balls);
    return linearFromDisplay(shown);
}

}  // namespace probegi::tool

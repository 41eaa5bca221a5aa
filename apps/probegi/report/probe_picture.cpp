#include "report/probe_picture.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "probegi/measure.h"

namespace probegi::tool {

namespace {

constexpr float kInWall = 0.3f, kBesideWall = 0.02f, kDark = 1e-4f;
constexpr float kRadius = 0.09f;        // of the spacing
constexpr float kLeastPixels = 1.5f;    // radius of a ball far away
constexpr float kThroughWalls = 0.35f;  // opacity of a probe seen through a wall

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

/// A pinhole camera as PictureDesc describes it.
class View {
public:
    View(const PlacedCamera& camera, int width, int height)
        : m_camera(camera),
          m_right(glm::cross(camera.forward, camera.up)),
          m_pixels(0.5f * float(height) / std::tan(0.5f * camera.yfov)),
          m_centre(0.5f * float(width), 0.5f * float(height)) {}

    /// Pixel, and distance along the viewing direction.
    glm::vec3 project(glm::vec3 point) const {
        const glm::vec3 p = point - m_camera.position;
        const float ahead = glm::dot(p, m_camera.forward);
        const float scale = m_pixels / std::max(ahead, 1e-6f);
        return {m_centre.x + scale * glm::dot(p, m_right), m_centre.y - scale * glm::dot(p, m_camera.up), ahead};
    }
    float pixelsPerMetre(float ahead) const { return m_pixels / ahead; }

private:
    PlacedCamera m_camera;
    glm::vec3 m_right;
    float m_pixels;
    glm::vec2 m_centre;
};

/// Draws a disc shaded as a ball in front of what is farther away.
void drawBall(HdrImage& shown, HdrImage& nearest, glm::vec3 centre, float radius, float distance, ProbeState state) {
    const int left = std::max(0, int(centre.x - radius)), right = std::min(shown.width - 1, int(centre.x + radius) + 1);
    const int top = std::max(0, int(centre.y - radius)),
              bottom = std::min(shown.height - 1, int(centre.y + radius) + 1);
    for (int y = top; y <= bottom; ++y)
        for (int x = left; x <= right; ++x) {
            const glm::vec2 off = (glm::vec2(x, y) + 0.5f - glm::vec2(centre)) / radius;
            const float inside = 1 - glm::dot(off, off);
            if (inside <= 0) continue;
            float& front = nearest.at(x, y).x;
            const bool hidden = distance >= front;
            if (hidden && state != ProbeState::inWall) continue;
            const glm::vec3 ball = lookOf(state).display * (0.45f + 0.55f * std::sqrt(inside));
            shown.at(x, y) = glm::mix(shown.at(x, y), ball, hidden ? kThroughWalls : 1.0f);
            if (!hidden) front = distance;
        }
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
    HdrImage shown = picture.color, nearest = picture.depth;
    for (glm::vec3& pixel : shown.pixels) pixel = 0.55f * toDisplay(pixel, {exposure, true});
    for (glm::vec3& depth : nearest.pixels)
        if (depth.x <= 0) depth.x = std::numeric_limits<float>::max();  // the sky
    const View view(camera, shown.width, shown.height);
    const float radius = kRadius * std::min({grid.spacing.x, grid.spacing.y, grid.spacing.z});
    for (std::size_t probe = 0; probe < states.size(); ++probe) {
        const glm::vec3 position = probePosition(grid, int(probe));
        const glm::vec3 centre = view.project(position);
        if (centre.z < 2 * radius) continue;
        const float pixels = std::max(radius * view.pixelsPerMetre(centre.z), kLeastPixels);
        drawBall(shown, nearest, centre, pixels, glm::distance(position, camera.position), states[probe]);
    }
    return linearFromDisplay(shown);
}

}  // namespace probegi::tool

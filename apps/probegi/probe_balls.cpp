#include "probe_balls.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

namespace probegi::tool {

namespace {

constexpr float kLeastPixels = 1.5f;    // radius of a ball far away
constexpr float kThroughWalls = 0.35f;  // opacity of a ball seen through a wall

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
void drawBall(HdrImage& shown, HdrImage& nearest, glm::vec3 centre, float radius, float distance, const Ball& ball) {
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
            if (hidden && !ball.showsThroughWalls) continue;
            const glm::vec3 colour = ball.display * (0.45f + 0.55f * std::sqrt(inside));
            shown.at(x, y) = glm::mix(shown.at(x, y), colour, hidden ? kThroughWalls : 1.0f);
            if (!hidden) front = distance;
        }
}

}  // namespace

void drawBalls(HdrImage& shown, HdrImage depth, const PlacedCamera& camera, std::span<const Ball> balls) {
    for (glm::vec3& d : depth.pixels)
        if (d.x <= 0) d.x = std::numeric_limits<float>::max();  // the sky
    const View view(camera, shown.width, shown.height);
    for (const Ball& ball : balls) {
        const glm::vec3 centre = view.project(ball.centre);
        if (centre.z < 2 * ball.radius) continue;
        const float pixels = std::max(ball.radius * view.pixelsPerMetre(centre.z), kLeastPixels);
        drawBall(shown, depth, centre, pixels, glm::distance(ball.centre, camera.position), ball);
    }
}

}  // namespace probegi::tool

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "probegi/scene.h"

namespace probegi {

PlacedCamera lookAt(glm::vec3 from, glm::vec3 at, float yfov) {
    PlacedCamera camera;
    camera.position = from;
    camera.yfov = yfov;
    const glm::vec3 towards = at - from;
    const float distance = glm::length(towards);
    camera.forward = distance > 0 ? towards / distance : glm::vec3(0, 0, -1);
    // Looking straight up or down, world -Z is up in the picture.
    const bool vertical = std::abs(camera.forward.y) > 0.9999f;
    const glm::vec3 hint = vertical ? glm::vec3(0, 0, -1) : glm::vec3(0, 1, 0);
    const glm::vec3 right = glm::normalize(glm::cross(camera.forward, hint));
    camera.up = glm::normalize(glm::cross(right, camera.forward));
    return camera;
}

PlacedCamera overviewCamera(const Bounds& bounds) {
    constexpr float kYfov = 0.8f;
    // The sphere around the box touches the frustum where sin(fov / 2) = radius / distance.
    const float radius = std::max(0.5f * glm::length(bounds.size()), 1e-3f);
    const float distance = 1.05f * radius / std::sin(0.5f * kYfov);
    const glm::vec3 direction = glm::normalize(glm::vec3(0.55f, 0.45f, 1.0f));
    PlacedCamera camera = lookAt(bounds.centre() + distance * direction, bounds.centre(), kYfov);
    camera.name = "overview";
    return camera;
}

}  // namespace probegi

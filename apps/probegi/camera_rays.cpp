#include "camera_rays.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

namespace probegi::tool {

std::vector<Ray> primaryRays(const PlacedCamera& camera, int width, int height) {
    const glm::vec3 right = glm::cross(camera.forward, camera.up);
    const float scale = 2 * std::tan(0.5f * camera.yfov) / float(height);
    std::vector<Ray> rays;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            Ray ray;
            ray.origin = camera.position;
            ray.direction = glm::normalize(camera.forward + (float(x) + 0.5f - 0.5f * float(width)) * scale * right -
                                           (float(y) + 0.5f - 0.5f * float(height)) * scale * camera.up);
            rays.push_back(ray);
        }
    return rays;
}

float shadeOf(const Surface& surface, const Ray& ray) {
    return 0.4f + 0.6f * std::abs(glm::dot(surface.shadingNormal, ray.direction));
}

glm::vec3 colourOf(std::size_t number) {
    constexpr float kStrength = 0.85f, kBrightness = 0.95f;
    const float hue = float(number % 4096) * (1.0f / std::numbers::phi_v<float>);
    const glm::vec3 wheel = glm::abs(glm::fract(hue + glm::vec3(0.0f, 2.0f / 3.0f, 1.0f / 3.0f)) * 6.0f - 3.0f) - 1.0f;
    return kBrightness * glm::mix(glm::vec3(1.0f), glm::clamp(wheel, 0.0f, 1.0f), kStrength);
}

}  // namespace probegi::tool

#include "camera_rays.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

namespace probegi::tool {

std::vector<Ray> primaryRays(const PlacedCamera& camera, int width, int height) {
    const float pixel = 2.0f * std::tan(0.5f * camera.yfov) / float(height);
    const glm::vec3 right = pixel * glm::cross(camera.forward, camera.up), up = pixel * camera.up;
    std::vector<Ray> rays;
    rays.reserve(std::size_t(width) * std::size_t(height));
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const float fromMiddleX = float(x) + 0.5f - 0.5f * float(width);
            const float fromMiddleY = 0.5f * float(height) - float(y) - 0.5f;
            const glm::vec3 direction = camera.forward + fromMiddleX * right + fromMiddleY * up;
            rays.push_back({camera.position, 0.0f, glm::normalize(direction)});
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

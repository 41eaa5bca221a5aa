#include "sphere_world.h"

#include <algorithm>
#include <cmath>

namespace {

/// Distance to the near side of a sphere, or to its far side from inside; kMiss if there is none.
float hitSphere(const SphereWorld::Sphere& sphere, glm::vec3 origin, glm::vec3 direction) {
    const glm::vec3 offset = origin - sphere.centre;
    const float b = glm::dot(offset, direction);
    const float discriminant = b * b - glm::dot(offset, offset) + sphere.radius * sphere.radius;
    if (discriminant < 0) return SphereWorld::kMiss;
    const float root = std::sqrt(discriminant);
    if (-b - root > 1e-4f) return -b - root;
    return -b + root > 1e-4f ? -b + root : SphereWorld::kMiss;
}

}  // namespace

SphereWorld::Surface SphereWorld::trace(glm::vec3 origin, glm::vec3 direction) const {
    Surface best{kMiss, {}, {}, {}};
    if (const float t = -origin.y / direction.y; std::isfinite(t) && t > 1e-4f) {
        best = {t, origin + t * direction, {0, 1, 0}, planeAlbedo};
    }
    for (const Sphere& sphere : spheres) {
        const float t = hitSphere(sphere, origin, direction);
        if (t >= best.distance) continue;
        const glm::vec3 position = origin + t * direction;
        best = {t, position, (position - sphere.centre) / sphere.radius, sphere.albedo};
    }
    return best;
}

glm::vec3 SphereWorld::sunlight(const Surface& surface) const {
    const float cosine = glm::dot(surface.normal, toSun);
    if (cosine <= 0 || !trace(surface.position + 1e-3f * surface.normal, toSun).missed()) return glm::vec3(0);
    return sunIrradiance * cosine;
}

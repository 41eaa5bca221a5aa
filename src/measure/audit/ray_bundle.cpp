#include "measure/audit/ray_bundle.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "kernels/trace/ray_offset.h"

namespace probegi {

RayBundle::RayBundle(const Tracer& tracer) : m_tracer(tracer), m_magnitude(magnitudeOf(tracer)) {}

std::size_t RayBundle::add(glm::vec3 point, glm::vec3 normal, glm::vec3 target) {
    m_rays.push_back(segment(point, normal, target, m_magnitude));
    return m_rays.size() - 1;
}

Result<void> RayBundle::trace() {
    m_blocked.assign(m_rays.size(), 0);
    if (m_rays.empty()) return {};
    return m_tracer.occluded(m_rays, m_blocked);
}

float magnitudeOf(const Tracer& tracer) {
    const Bounds bounds = tracer.bounds();
    const glm::vec3 largest = glm::max(glm::abs(bounds.lower), glm::abs(bounds.upper));
    return std::max({largest.x, largest.y, largest.z});
}

Ray segment(glm::vec3 point, glm::vec3 normal, glm::vec3 target, float magnitude) {
    Ray ray;
    ray.origin = kernels::offsetOrigin(point, normal, magnitude);
    const glm::vec3 way = target - ray.origin;
    const float length = glm::length(way);
    ray.direction = length > 0 ? way / length : normal;
    ray.far = kernels::shadowRayEnd(length);
    return ray;
}

}  // namespace probegi

#pragma once

#include <cstdint>
#include <vector>

#include "probegi/tracer.h"

namespace probegi {

/// Segments to be tested together.
class RayBundle {
public:
    explicit RayBundle(const Tracer& tracer);

    /// Whether anything lies between a point that looks along `normal` (moved off its surface) and a target. Returns
    /// the segment's number.
    std::size_t add(glm::vec3 point, glm::vec3 normal, glm::vec3 target);
    /// Errors: those of the tracer.
    Result<void> trace();
    /// After trace().
    bool blocked(std::size_t segment) const { return m_blocked[segment] != 0; }
    std::size_t size() const { return m_rays.size(); }

private:
    const Tracer& m_tracer;
    float m_magnitude;
    std::vector<Ray> m_rays;
    std::vector<std::uint8_t> m_blocked;
};

/// The largest absolute coordinate of what a tracer can hit, metres: rounding is a share of it.
float magnitudeOf(const Tracer& tracer);

/// The ray from a point of a surface to a target, moved off the surface. A target that is the point itself gives a ray
/// along the normal that hits nothing.
Ray segment(glm::vec3 point, glm::vec3 normal, glm::vec3 target, float magnitude);

}  // namespace probegi

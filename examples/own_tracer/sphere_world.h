#pragma once

#include <array>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

/// The example's own scene and ray tracer: three spheres on a plane under a sun and a grey sky. A stand-in for an
/// engine's; independent of ProbeGI.
struct SphereWorld {
    struct Sphere {
        glm::vec3 centre;
        float radius;
        glm::vec3 albedo;
    };
    struct Surface {
        float distance;  ///< along the ray; kMiss: the sky
        glm::vec3 position;
        glm::vec3 normal;
        glm::vec3 albedo;
        bool missed() const { return distance >= kMiss; }
    };
    static constexpr float kMiss = 1e30f;

    std::array<Sphere, 3> spheres{{{{-1.3f, 1.0f, 0.0f}, 1.0f, {0.8f, 0.1f, 0.1f}},
                                   {{1.2f, 0.7f, 0.6f}, 0.7f, {0.8f, 0.8f, 0.8f}},
                                   {{0.3f, 0.4f, 1.6f}, 0.4f, {0.1f, 0.6f, 0.2f}}}};
    glm::vec3 planeAlbedo{0.6f};
    glm::vec3 toSun = glm::normalize(glm::vec3(0.6f, 0.7f, 0.4f));
    glm::vec3 sunIrradiance{4.0f, 3.7f, 3.2f};  ///< W m^-2 at normal incidence
    glm::vec3 skyRadiance{0.4f, 0.5f, 0.7f};    ///< W sr^-1 m^-2

    Surface trace(glm::vec3 origin, glm::vec3 direction) const;
    /// Irradiance from the sun on a surface, shadowed.
    glm::vec3 sunlight(const Surface& surface) const;
};

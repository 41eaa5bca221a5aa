#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "probegi/tracer.h"

namespace probegi {

/// A ray that starts where cameras and probes can be, and what it meets in the scene.
struct FitRay {
    glm::vec3 origin{0.0f};
    float distance = 0;  ///< to the scene's surface, metres; kFitSky: none
    glm::vec3 direction{0.0f};
    float cosine = 1;  ///< between the ray and the surface's normal, 0..1
};

constexpr float kFitSky = 1e30f;

/// What a ray's surface looks like, beside it in a list of the same length.
struct FitSurface {
    glm::vec3 normal{0.0f};  ///< geometric; zero for the sky
    glm::vec3 albedo{0.0f};
    glm::vec3 emission{0.0f};
    std::int32_t material = -1;  ///< as Surface::material
};

/// Rays in the world, and what they meet.
struct FitRays {
    std::vector<FitRay> rays;
    std::vector<FitSurface> surfaces;
};

/// `count` rays of random walks through the air of a scene. Walks start at the cameras, and at points of the bounds
/// that are not in matter: those whose rays hardly ever meet the back of a surface. A walk that gets behind a surface
/// begins anew. Fewer rays only where there is no air. Errors: the tracer's.
Result<FitRays> walkThrough(const Context& context, const Tracer& tracer, std::span<const PlacedCamera> cameras,
                            std::size_t count, std::uint32_t seed);

/// The same rays as seen in a frame whose axes are the columns of `frame`.
std::vector<FitRay> raysIn(const glm::mat3& frame, std::span<const FitRay> rays);

}  // namespace probegi

#pragma once

#include <vector>

#include "probegi/tracer.h"
#include "reference/emitter_sampler.h"
#include "reference/path_guide.h"
#include "reference/sky_light.h"

namespace probegi {

/// Everything that a path needs, made once for a pose.
struct Transport {
    const Tracer* tracer = nullptr;
    std::vector<PlacedLight> lights;
    EmitterSampler emitters;
    SkyLight sky;
    float magnitude = 0;  ///< sceneMagnitude(tracer->bounds())
};

/// How to estimate light that both light sampling and BSDF sampling can find. All three have the same expectation
/// (without mirrors); tests compare them.
enum class Strategy : std::uint8_t { both, bsdfOnly, lightsOnly };

struct PathSettings {
    bool diffuseOnly = false;
    int maxBounces = 0;  ///< reflections between a light and the camera; 0: unlimited
    Strategy strategy = Strategy::both;
    const PathGuide* guide = nullptr;  ///< directions of light; null: paths sample the BSDF alone
};

/// One path's result, split as in Picture.
struct PathResult {
    glm::vec3 sky{0.0f};         ///< seen directly
    glm::vec3 direct{0.0f};      ///< first surface: its emission, and punctual lights on it
    glm::vec3 indirect{0.0f};    ///< first surface: everything else
    glm::vec3 irradiance{0.0f};  ///< E behind `indirect`
    glm::vec3 albedo{0.0f};
    glm::vec3 normal{0.0f};
    float depth = 0.0f;

    glm::vec3 color() const { return sky + direct + indirect; }
};

}  // namespace probegi

#pragma once

#include <algorithm>
#include <glm/common.hpp>

#include "kernels/light/punctual_light.h"
#include "kernels/trace/ray_offset.h"
#include "probegi/tracer.h"

namespace probegi {

static_assert(int(LightType::directional) == kernels::kLightDirectional);
static_assert(int(LightType::point) == kernels::kLightPoint);
static_assert(int(LightType::spot) == kernels::kLightSpot);

/// Unshadowed light at `point`: direction, distance, irradiance at normal incidence.
inline kernels::LightSample sampleLight(const PlacedLight& light, glm::vec3 point) {
    return kernels::samplePunctual(int(light.type), light.position, light.direction, light.intensity, light.range,
                                   light.cosInner, light.cosOuter, point);
}

/// The largest absolute coordinate of the bounds: the scale for kernels::offsetOrigin.
inline float sceneMagnitude(const Bounds& bounds) {
    const glm::vec3 m = glm::max(glm::abs(bounds.lower), glm::abs(bounds.upper));
    return std::max({m.x, m.y, m.z});
}

/// The shadow ray from a surface point to a light. `geometricNormal` is on the lit side; `magnitude` is
/// sceneMagnitude(tracer.bounds()).
inline Ray shadowRay(glm::vec3 position, glm::vec3 geometricNormal, const kernels::LightSample& sample,
                     float magnitude) {
    return {kernels::offsetOrigin(position, geometricNormal, magnitude), 0.0f, sample.toLight,
            kernels::shadowRayEnd(sample.distance)};
}

}  // namespace probegi

#pragma once

#include "probegi/shared/rays.h"
#include "probegi/shared/screen_sample.h"

namespace probegi {

// Member by member: what is made elsewhere and copied costs a picture 3 % of its time.

/// What a ray into the sky shows; `viewDirection` and `irradiance` are left alone.
inline void showSky(ScreenSample& sample, glm::vec3 radiance) {
    sample.position = glm::vec3(0.0f);
    sample.kind = kSampleSky;
    sample.distance = 0.0f;
    sample.geometricNormal = sample.shadingNormal = glm::vec3(0, 1, 0);
    sample.metallic = 0.0f;
    sample.roughness = 1.0f;
    sample.albedo = glm::vec3(0.0f);
    sample.direct = radiance;
}

/// What a ray shows that hit a surface; the same.
inline void showSurface(ScreenSample& sample, float distance, const Surface& surface) {
    sample.position = surface.position;
    sample.kind = surface.backface ? kSampleBackface : kSampleSurface;
    sample.distance = distance;
    sample.geometricNormal = surface.geometricNormal;
    sample.metallic = surface.metallic;
    sample.shadingNormal = surface.shadingNormal;
    sample.roughness = surface.roughness;
    sample.albedo = surface.albedo;
    sample.direct = surface.emission;
}

}  // namespace probegi

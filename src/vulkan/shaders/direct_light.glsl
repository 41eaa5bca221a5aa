// Punctual lights with shadow rays, for a pass that has useLighting() behind it.
#ifndef PROBEGI_DIRECT_LIGHT_GLSL
#define PROBEGI_DIRECT_LIGHT_GLSL

#include "scene_set.glsl"

// Irradiance at normal incidence from one light, 0 where the light stands behind the surface or something is between.
vec3 visibleLight(Surface surface, LightSample light) {
    if (!reachesSurface(light, surface.geometricNormal, surface.shadingNormal)) return vec3(0.0);
    const bool blocked = occluded(shadowRay(surface.position, surface.geometricNormal, light));
    return blocked ? vec3(0.0) : light.irradianceAtNormal;
}

#endif

// Punctual lights with shadow rays, for a pass that has useLighting() behind it.
#ifndef PROBEGI_DIRECT_LIGHT_GLSL
#define PROBEGI_DIRECT_LIGHT_GLSL

#include "scene_set.glsl"

// Irradiance at normal incidence from one light, 0 where the light stands behind the surface or something is between.
// A light behind either normal does not count: the geometric one keeps light from seeping through a surface whose
// shading normal leans over its edge.
vec3 visibleLight(Surface surface, LightSample light) {
    const vec3 e = light.irradianceAtNormal;
    if (!(e.x > 0.0 || e.y > 0.0 || e.z > 0.0)) return vec3(0.0);
    if (!(dot(light.toLight, surface.shadingNormal) > 0.0)) return vec3(0.0);
    if (!(dot(light.toLight, surface.geometricNormal) > 0.0)) return vec3(0.0);
    return occluded(shadowRay(surface.position, surface.geometricNormal, light)) ? vec3(0.0) : e;
}

#endif

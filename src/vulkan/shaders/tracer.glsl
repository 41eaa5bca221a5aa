// What every tracer_NAME.glsl defines. The passes that say `// variants: tracers` are compiled once with each of them:
// they include this, then "chosen_tracer.glsl", which is the tracer's file. It may use
// - sceneConstants.tracer, which nobody else reads: what SceneTracer::block() of its C++ half says;
// - scene.glsl: materials, textures, lights and sky of the scene; triangles.glsl where its surfaces are triangles.
#ifndef PROBEGI_VULKAN_TRACER_GLSL
#define PROBEGI_VULKAN_TRACER_GLSL

#include "vulkan/shaders/types.glsl"

// The closest hit; alpha masks are honoured. A ray that is not a number hits nothing. Of what it says, others read
// distance and primitive (negative: nothing was hit); the rest is for surfaceAt() alone.
Hit closestHit(Ray ray);

// Whether anything lies between near and far; alpha masks are honoured.
bool occluded(Ray ray);

// Resolves a hit that closestHit() found along the ray. `spread`: angle of the ray's cone in radians, by which textures
// are filtered; 0: not at all. `material` is a number of Scene::materials.
Surface surfaceAt(Ray ray, Hit hit, float spread);

Surface surfaceAt(Ray ray, Hit hit) {
    return surfaceAt(ray, hit, 0.0);
}

#endif

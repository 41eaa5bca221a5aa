// What every tracer_NAME.glsl must define. Passes marked `// variants: tracers` are compiled once with each of them:
// they include this, then "chosen_tracer.glsl", which stands for the tracer's file. A tracer may use
// - sceneConstants.tracer, which nothing else reads: the result of SceneTracer::block() of its C++ half;
// - scene.glsl: materials, textures, lights and sky of the scene; triangles.glsl where its surfaces are triangles.
#ifndef PROBEGI_VULKAN_TRACER_GLSL
#define PROBEGI_VULKAN_TRACER_GLSL

#include "vulkan/shaders/types.glsl"

// The closest hit; alpha masks apply. A ray with NaNs hits nothing. Passes read only the hit's distance and primitive
// (negative: a miss); the rest is for surfaceAt().
Hit closestHit(Ray ray);

// Whether anything lies between near and far; alpha masks apply.
bool occluded(Ray ray);

// The surface at a hit that closestHit() found along the ray. `spread`: angle of the ray's cone in radians, for texture
// filtering; 0: unfiltered. Surface::material is an index into Scene::materials.
Surface surfaceAt(Ray ray, Hit hit, float spread);

Surface surfaceAt(Ray ray, Hit hit) {
    return surfaceAt(ray, hit, 0.0);
}

#endif

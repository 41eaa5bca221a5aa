// What every tracer include offers: a pass includes this, scene.glsl and exactly one file that defines these two.
#ifndef PROBEGI_VULKAN_TRACER_GLSL
#define PROBEGI_VULKAN_TRACER_GLSL

#include "vulkan/shaders/types.glsl"

// Alpha masks are honoured by both (alphaPasses of scene.glsl). A ray that is not a number hits nothing.
Hit closestHit(Ray ray);

// Whether anything lies between near and far.
bool occluded(Ray ray);

#endif

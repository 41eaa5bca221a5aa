// Rays, hits and surfaces, and the numbering of geometries by tracers of triangles.
#ifndef PROBEGI_VULKAN_TYPES_GLSL
#define PROBEGI_VULKAN_TYPES_GLSL

#include "probegi/shared/rays.h"

const float kNoHitDistance = 1e30;
const int kGeometryOpaque = 0;
const int kGeometryMasked = 1;

#endif

// Set 0 of the library's own passes: a field. Bindings 0 to 3 are those of query.glsl.
#ifndef PROBEGI_VOLUME_GLSL
#define PROBEGI_VOLUME_GLSL

#include "common.glsl"

#define PROBEGI_SET 0
#define PROBEGI_BINDING 0
#define PROBEGI_COUNT_FALLBACKS
#define PROBEGI_MASKS
#include "query.glsl"

layout(set = 0, binding = 4, rgba16f) uniform image2DArray irradianceImage;
layout(set = 0, binding = 5, rg16) uniform image2DArray visibilityImage;

#endif

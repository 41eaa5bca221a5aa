// Rays and hits in buffers.
#ifndef PROBEGI_RAYS_GLSL
#define PROBEGI_RAYS_GLSL

#include "common.glsl"
#include "types.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Rays {
    Ray at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Hits {
    Hit at[];
};

#endif

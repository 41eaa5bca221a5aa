// The light of the probes' emitter samples, in a buffer.
#ifndef PROBEGI_EMITTER_LIGHTS_GLSL
#define PROBEGI_EMITTER_LIGHTS_GLSL

#include "common.glsl"

#include "kernels/light/emitter_sampling.h"

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer EmitterLights {
    EmitterLight at[];
};

#endif

// Samples of a picture between its passes.
#ifndef PROBEGI_PICTURE_GLSL
#define PROBEGI_PICTURE_GLSL

#include "common.glsl"
#include "types.glsl"

#include "kernels/abi/gpu_passes.h"
#include "probegi/shared/screen_sample.h"

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Samples {
    ScreenSample at[];
};

// The surface that a sample shows, as far as passes after the first need it.
Surface sampleSurface(ScreenSample s) {
    Surface surface;
    surface.position = s.position;
    surface.geometricNormal = s.geometricNormal;
    surface.shadingNormal = s.shadingNormal;
    surface.albedo = s.albedo;
    surface.emission = vec3(0.0);
    surface.metallic = s.metallic;
    surface.roughness = s.roughness;
    surface.material = 0;
    surface.back = s.kind == kSampleBackface;
    surface.backface = s.kind == kSampleBackface;
    return surface;
}

#endif

// One entry of a G-buffer, and its lighting: C++ and GLSL.
#ifndef PROBEGI_SHARED_SCREEN_SAMPLE_H
#define PROBEGI_SHARED_SCREEN_SAMPLE_H

#include "probegi/shared/language.h"

PROBEGI_SHARED_BEGIN

// ScreenSample::kind.
PROBEGI_CONST PROBEGI_INT kSampleSky = 0;       ///< nothing is there
PROBEGI_CONST PROBEGI_INT kSampleSurface = 1;   ///< only these are lit
PROBEGI_CONST PROBEGI_INT kSampleBackface = 2;  ///< the back of a single-sided material: solid wall, black

/// What a primary ray meets, and the light there. Pictures pass planes of these from pass to pass; engines give theirs
/// to vulkan::recordShading().
struct ScreenSample {
    PROBEGI_VEC3 position PROBEGI_DEFAULT(PROBEGI_VEC3(0.0f));  ///< metres, in the world
    PROBEGI_INT kind PROBEGI_DEFAULT(kSampleSky);
    PROBEGI_VEC3 viewDirection PROBEGI_DEFAULT(PROBEGI_VEC3(0, 0, -1));  ///< unit, from the viewer to the position
    float distance PROBEGI_DEFAULT(0.0f);  ///< metres from the viewer; 0 for the sky; not used by recordShading()
    PROBEGI_VEC3 geometricNormal PROBEGI_DEFAULT(PROBEGI_VEC3(0, 1, 0));  ///< unit, on the viewer's side
    float metallic PROBEGI_DEFAULT(0.0f);                                 ///< 0..1
    PROBEGI_VEC3 shadingNormal PROBEGI_DEFAULT(PROBEGI_VEC3(0, 1, 0));    ///< unit, on the viewer's side
    float roughness PROBEGI_DEFAULT(1.0f);                                ///< 0..1, perceptual
    PROBEGI_VEC3 albedo PROBEGI_DEFAULT(PROBEGI_VEC3(0.0f));              ///< base colour, 0..1
    /// W sr^-1 m^-2. In: emission, or the sky's radiance. Out: plus the light of punctual lights.
    PROBEGI_VEC3 direct PROBEGI_DEFAULT(PROBEGI_VEC3(0.0f));
    /// E of the field, W m^-2; indirect radiance is albedo * E / pi. In: 0.
    PROBEGI_VEC3 irradiance PROBEGI_DEFAULT(PROBEGI_VEC3(0.0f));
};

#ifdef __cplusplus
static_assert(sizeof(ScreenSample) == 100 && offsetof(ScreenSample, kind) == 12 &&
              offsetof(ScreenSample, viewDirection) == 16 && offsetof(ScreenSample, distance) == 28 &&
              offsetof(ScreenSample, geometricNormal) == 32 && offsetof(ScreenSample, metallic) == 44 &&
              offsetof(ScreenSample, shadingNormal) == 48 && offsetof(ScreenSample, roughness) == 60 &&
              offsetof(ScreenSample, albedo) == 64 && offsetof(ScreenSample, direct) == 76 &&
              offsetof(ScreenSample, irradiance) == 88);
#endif

PROBEGI_SHARED_END

#endif

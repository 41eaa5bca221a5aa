// Queries of the shader test to scene.glsl and their results, for C++ and GLSL. Members of 4 bytes, scalar layout.
#ifndef PROBEGI_TESTS_VULKAN_SCENE_QUESTION_H
#define PROBEGI_TESTS_VULKAN_SCENE_QUESTION_H

#include "kernels/language.h"

KERNELS_BEGIN

struct Question {
    vec3 direction;
    vec2 barycentric;
    int primitive;
    int geometry;
    int instance;
    float spread;  // of the ray's cone, radians
};

struct Answer {
    vec3 position;
    vec3 geometricNormal;
    vec3 shadingNormal;
    vec3 albedo;
    vec3 emission;
    float metallic;
    float roughness;
    int material;
    int back;
    int backface;
    int passes;
    vec3 sky;
    vec3 toLight;
    vec3 irradianceAtNormal;
    vec3 shadowOrigin;
    float shadowEnd;
};

// Push constants: device addresses, low word first.
struct Push {
    uvec2 scene;
    uvec2 questions;
    uvec2 answers;
    uint count;
};

KERNELS_END

#endif

// Queries scene.glsl and triangles.glsl about hits, directions and points, one per thread.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require

#include "kernels/abi/gpu_scene.h"
#include "question.h"

layout(local_size_x = 64) in;

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Questions {
    Question at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer Answers {
    Answer at[];
};
layout(push_constant, scalar) uniform PushConstants {
    Push u_push;
};

#define PROBEGI_SCENE SceneBlock(u_push.scene).scene
#include "vulkan/shaders/triangles.glsl"

void main() {
    const uint index = gl_GlobalInvocationID.x;
    if (index >= u_push.count) return;
    const Question q = Questions(u_push.questions).at[index];
    const Surface s = surfaceAt(Ray(vec3(0.0), 0.0, q.direction, 1e30),
                                Hit(1.0, q.primitive, q.geometry, q.instance, q.barycentric), q.spread);
    const LightSample light = lightSampleAt(int(index) % PROBEGI_SCENE.lightCount, s.position);
    const Ray shadow = shadowRay(s.position, s.geometricNormal, light);
    Answer a;
    a.position = s.position;
    a.geometricNormal = s.geometricNormal;
    a.shadingNormal = s.shadingNormal;
    a.albedo = s.albedo;
    a.emission = s.emission;
    a.metallic = s.metallic;
    a.roughness = s.roughness;
    a.material = s.material;
    a.back = int(s.back);
    a.backface = int(s.backface);
    a.passes = int(alphaPasses(q.instance, q.geometry, q.primitive, q.barycentric));
    a.sky = skyRadianceAt(q.direction);
    a.toLight = light.toLight;
    a.irradianceAtNormal = light.irradianceAtNormal;
    a.shadowOrigin = shadow.origin;
    a.shadowEnd = shadow.far;
    Answers(u_push.answers).at[index] = a;
}

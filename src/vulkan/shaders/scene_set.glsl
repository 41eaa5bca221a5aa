// Set 1 of the library's own passes: a scene, and the tracer of this variant of the shader.
#ifndef PROBEGI_SCENE_SET_GLSL
#define PROBEGI_SCENE_SET_GLSL

#include "common.glsl"

#include "kernels/abi/gpu_passes.h"

layout(set = 1, binding = 0, scalar) uniform SceneUniforms {
    SceneConstants sceneConstants;
};
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer LightingBuffer {
    LightingBlock block;
};

// The scene with the pass's lights and sky. Every main() must call useLighting() or useSceneOnly() first.
SceneAddresses litScene;
#define PROBEGI_SCENE litScene
#include "scene.glsl"

void useLighting(uvec2 address) {
    const LightingBlock lighting = LightingBuffer(address).block;
    litScene = sceneConstants.scene;
    litScene.lights = lighting.lights;
    litScene.skyPixels = lighting.skyPixels;
    litScene.sky = lighting.sky;
    litScene.lightCount = lighting.lightCount;
}

// For passes that need no light.
void useSceneOnly() {
    litScene = sceneConstants.scene;
}

#include "tracer.glsl"

#include "chosen_tracer.glsl"

#endif

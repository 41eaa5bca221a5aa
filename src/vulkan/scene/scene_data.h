#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "geometry/emitters.h"
#include "geometry/scene_geometry.h"
#include "kernels/abi/gpu_scene.h"
#include "vulkan/device/address.h"

namespace probegi::vulkan {

// src/vulkan/shaders/scene.glsl reads these structs in scalar layout, which has no padding, so C++ must add none.
static_assert(sizeof(kernels::GpuVertex) == 32 && offsetof(kernels::GpuVertex, uv) == 24);
static_assert(sizeof(kernels::GpuTriangle) == 16 && offsetof(kernels::GpuTriangle, material) == 12);
static_assert(sizeof(kernels::GpuMesh) == 20 && offsetof(kernels::GpuMesh, firstTangent) == 16);
static_assert(sizeof(kernels::GpuInstance) == 136 && offsetof(kernels::GpuInstance, toObject) == 48 &&
              offsetof(kernels::GpuInstance, normalToWorld) == 96 && offsetof(kernels::GpuInstance, group) == 132);
static_assert(sizeof(kernels::GpuTexture) == 56 && offsetof(kernels::GpuTexture, rowU) == 16 &&
              offsetof(kernels::GpuTexture, flags) == 40 && offsetof(kernels::GpuTexture, mips) == 48);
static_assert(sizeof(kernels::GpuMaterial) == 64 && offsetof(kernels::GpuMaterial, emission) == 16 &&
              offsetof(kernels::GpuMaterial, doubleSided) == 40 &&
              offsetof(kernels::GpuMaterial, emissiveTexture) == 56);
static_assert(sizeof(kernels::GpuEmitter) == 44 && offsetof(kernels::GpuEmitter, edge2) == 32);
static_assert(sizeof(kernels::GpuLight) == 52 && offsetof(kernels::GpuLight, intensity) == 32);
static_assert(sizeof(kernels::GpuSky) == 20 && offsetof(kernels::GpuSky, width) == 12);
static_assert(sizeof(kernels::SceneAddresses) == 140 && offsetof(kernels::SceneAddresses, sky) == 96 &&
              offsetof(kernels::SceneAddresses, magnitude) == 120);

/// A SceneGeometry as records and raw arrays, each of which becomes a buffer (see kernels::SceneAddresses). Unused
/// arrays are empty.
struct SceneData {
    std::vector<kernels::GpuVertex> vertices;
    std::vector<kernels::GpuTriangle> triangles;
    std::vector<glm::vec2> uv1;
    std::vector<glm::vec4> tangents;
    std::vector<kernels::GpuMesh> meshes;         ///< by 2 * group + geometry; group 0 is the world, g + 1 is groups[g]
    std::vector<kernels::GpuInstance> instances;  ///< by placement
    std::vector<kernels::GpuMaterial> materials;  ///< in the scene's order
    std::vector<kernels::GpuTexture> textures;
    std::vector<std::uint32_t> texels;  ///< RGBA8 of each image in use and its mips, stored once
    std::vector<float> srgbTable;       ///< 256 values
    std::vector<kernels::GpuEmitter> emitters;
};

/// Geometry, emitters (may be empty) and mips must be those of the scene. Without mips, look-ups use level 0.
SceneData packScene(const SceneGeometry& geometry, const EmitterSet& emitters, const Scene& scene,
                    const MipMaps& mips = {});

std::vector<kernels::GpuEmitter> packEmitters(const EmitterSet& emitters);
/// For scenes of primitives: materials that have nothing but their luminance.
std::vector<kernels::GpuMaterial> packEmitterMaterials(const EmitterSet& emitters);

/// One record of SceneData::instances, for moving placements.
kernels::GpuInstance packInstance(const Placement& placement);

std::vector<kernels::GpuLight> packLights(std::span<const PlacedLight> lights);

/// The pixels of the sky's image are not part of it: they are uploaded unchanged.
kernels::GpuSky packSky(const Sky& sky);

}  // namespace probegi::vulkan

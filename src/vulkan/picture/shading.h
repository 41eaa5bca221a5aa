#pragma once

#include <optional>
#include <span>
#include <vector>

#include "geometry/picture_passes.h"
#include "kernels/abi/gpu_passes.h"
#include "kernels/screen/glossy_ray.h"
#include "vulkan/field/gpu_field_impl.h"
#include "vulkan/scene/gpu_lighting_impl.h"
#include "vulkan/scene/gpu_scene_impl.h"

namespace probegi::vulkan {

/// What the passes of a picture read.
struct SceneObjects {
    const GpuScene& scene;
    const FieldPasses* volume;  ///< may be null; its settings are up to date
};

/// A pass on the GPU: a shader with PicturePush, one thread a sample. Members as in PassInfo.
struct GpuPass {
    const char* name;
    std::optional<Shader> shader;  ///< none: there is nothing to do
    double PictureTimes::*time = nullptr;
    bool neighbours = false;
    bool perPixel = false;  ///< one thread a pixel
    bool perBlock = false;  ///< one thread a block of 2 x 2 pixels
    bool onHits = false;    ///< its samples are what glossy rays hit, one a block
};

GpuPass gpuPass(const PassInfo& info, const SceneObjects& objects);
/// kPicturePasses on the GPU, those that the picture has.
std::vector<GpuPass> gpuPasses(const SceneObjects& objects, const PictureDesc& desc = {});

/// Blocks of 2 x 2 pixels of a frame.
std::uint32_t glossyBlocks(int width, int rows);

/// Compiles the passes, so that either all are recorded or none. Throws.
void preparePasses(const SceneObjects& objects, std::span<const GpuPass> passes);
/// Before passes, with what they share.
void bindPasses(const Recorder& recorder, const SceneObjects& objects, const kernels::PicturePush& push);
/// Ends with a barrier between compute passes. Throws.
void recordPass(const Recorder& recorder, const SceneObjects& objects, const GpuPass& pass,
                const kernels::PicturePush& push, Profiler* profiler);

}  // namespace probegi::vulkan

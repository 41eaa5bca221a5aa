#pragma once

#include "kernels/abi/gpu_passes.h"
#include "vulkan/field/gpu_field_impl.h"
#include "vulkan/scene/gpu_lighting_impl.h"
#include "vulkan/scene/gpu_scene_impl.h"

namespace probegi::vulkan {

/// Direct light and the field for the samples that `push` names. `volume` (may be null) is bound by this; its guard is
/// up to date. Ends ordered for compute shaders. Throws.
void recordSampleShading(const Recorder& recorder, const Device& device, const GpuScene& scene,
                         const FieldPasses* volume, const kernels::PicturePush& push, Profiler* profiler);

}  // namespace probegi::vulkan

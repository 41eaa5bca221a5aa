#pragma once

#include <memory>

#include "geometry/scene_geometry.h"
#include "kernels/abi/gpu_passes.h"
#include "vulkan/device/staging.h"
#include "vulkan/scene/scene_data.h"

namespace probegi::vulkan {

/// What finds hits in an uploaded scene. A new way of tracing on the GPU is one of these and an include that offers
/// shaders/tracer.glsl; its name is a variant of the shaders that trace.
class SceneTracer {
public:
    virtual ~SceneTracer() = default;

    virtual TracerKind kind() const noexcept = 0;
    /// What the shaders' names end in.
    virtual const char* shaderSuffix() const noexcept = 0;
    /// Once, after the scene's own buffers are there: builds that the GPU does. May order with barriers.
    virtual void recordBuild(const Recorder& recorder) = 0;
    /// New transforms of the placements, in their order. What is flattened is not hit.
    virtual void recordPlacements(const Recorder& recorder, const std::vector<Placement>& placements) = 0;
    /// Frees what only the build needed, once it has finished.
    virtual void releaseStaging() noexcept = 0;
    virtual std::size_t bytes() const noexcept = 0;

    /// For the scene's uniform buffer; zero where shaders do not need them.
    virtual kernels::BvhAddresses addresses() const noexcept { return {}; }
    /// For binding 1 of the scene's set; null where there is none.
    virtual vk::AccelerationStructureKHR topLevel() const noexcept { return {}; }
};

/// The library's own BVH, built on the context's threads. Throws.
std::unique_ptr<SceneTracer> makeBvhSceneTracer(const Context& context, const Device& device,
                                                const SceneGeometry& geometry, Staging& staging);
/// VK_KHR_acceleration_structure over the scene's vertices (GpuVertex at `vertices`). Throws.
std::unique_ptr<SceneTracer> makeRayQuerySceneTracer(const Device& device, const SceneGeometry& geometry,
                                                     const SceneData& data, VkDeviceAddress vertices);

}  // namespace probegi::vulkan

#pragma once

#include <memory>

#include "geometry/scene_geometry.h"
#include "kernels/abi/gpu_passes.h"
#include "vulkan/device/staging.h"
#include "vulkan/scene/scene_data.h"

namespace probegi::vulkan {

/// A scene that is about to be uploaded, as tracers are made of it. All but `device` are read during the call only;
/// what is added to `staging` may point to the tracer's own memory until releaseStaging().
struct TracedScene {
    const Context& context;
    const Device& device;
    const SceneGeometry& geometry;
    const SceneData& data;
    VkDeviceAddress vertices;  ///< of SceneData::vertices on the device
    Staging& staging;          ///< recorded before SceneTracer::recordBuild()
};

/// What finds hits in an uploaded scene, and knows what they look like: the C++ half of a tracer. The other half is
/// shaders/tracer_NAME.glsl, which defines what shaders/tracer.glsl declares. A tracer needs no descriptors: all that
/// its shaders read they find by the addresses in its block.
class SceneTracer {
public:
    virtual ~SceneTracer() = default;

    /// sceneConstants.tracer in the GLSL half. Asked for after making and after each recordPlacements().
    virtual kernels::TracerBlock block() const noexcept = 0;
    /// Once, after the scene's own buffers are there: builds that the GPU does. May order with barriers.
    virtual void recordBuild(const Recorder& recorder) = 0;
    /// New transforms of the placements, in their order. What is flattened is not hit.
    virtual void recordPlacements(const Recorder& recorder, const std::vector<Placement>& placements) = 0;
    /// Frees what only the build needed, once it has finished.
    virtual void releaseStaging() noexcept = 0;
    virtual std::size_t bytes() const noexcept = 0;
};

/// A way of tracing on the GPU.
struct SceneTracerType {
    const char* name;   ///< as in shaders/tracer_NAME.glsl
    TracerKind kind;    ///< how users ask for it
    const char* needs;  ///< what a device must have for it, in a sentence
    bool (*possible)(const Device& device);
    bool (*preferred)(const Device& device);                         ///< where TracerKind::automatic takes it
    std::unique_ptr<SceneTracer> (*make)(const TracedScene& scene);  ///< throws
    bool hitsTriangles = true;        ///< of the scene, so that probes can look at those that send light
    ShaderBook shaders = shaderCode;  ///< has the passes for it

    /// A pass that has `// variants: tracers`.
    Shader shader(const char* pass) const { return {std::string(pass) + "_" + name, shaders}; }
};

/// The one that users ask for, or for TracerKind::automatic the first that is preferred. Throws unsupported.
const SceneTracerType& sceneTracerType(const Device& device, TracerKind wanted);

}  // namespace probegi::vulkan

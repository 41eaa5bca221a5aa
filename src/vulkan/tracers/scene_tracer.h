#pragma once

#include <memory>

#include "geometry/scene_geometry.h"
#include "kernels/abi/gpu_passes.h"
#include "sdf/placed_primitives.h"
#include "vulkan/device/staging.h"
#include "vulkan/scene/scene_data.h"

namespace probegi::vulkan {

/// A scene about to be uploaded: what a tracer is made from. Only `device` outlives the call. What is added to
/// `staging` must stay in memory until releaseStaging(), as a member of the tracer for instance.
struct TracedScene {
    const Context& context;
    const Device& device;
    const SceneGeometry& geometry;
    const SceneData& data;
    VkDeviceAddress vertices;                      ///< of SceneData::vertices on the device
    Staging& staging;                              ///< recorded before SceneTracer::recordBuild()
    const PlacedPrimitives* primitives = nullptr;  ///< of GpuSceneDesc::sdf
};

/// The C++ half of a tracer: uploads and builds what its shaders traverse. The other half is shaders/tracer_NAME.glsl,
/// which defines what shaders/tracer.glsl declares. A tracer needs no descriptors: its shaders find their data by the
/// addresses in its block.
class SceneTracer {
public:
    virtual ~SceneTracer() = default;

    /// sceneConstants.tracer in the GLSL half. Read after construction and after each recordPlacements().
    virtual kernels::TracerBlock block() const noexcept = 0;
    /// Records builds on the GPU, once, after the uploads of the scene's buffers. May record barriers.
    virtual void recordBuild(const Recorder& recorder) = 0;
    /// New transforms of the placements, in the same order. Rays do not hit a placement with a singular transform.
    virtual void recordPlacements(const Recorder& recorder, const std::vector<Placement>& placements) = 0;
    /// New places of the primitives, in the same order; for tracers that were made with some.
    virtual void recordPrimitives(const Recorder&, const PlacedPrimitives&) {}
    /// Frees what only the build needed; called after it has finished.
    virtual void releaseStaging() noexcept = 0;
    virtual std::size_t bytes() const noexcept = 0;
};

/// A way of tracing on the GPU.
struct SceneTracerType {
    const char* name;   ///< NAME of shaders/tracer_NAME.glsl
    TracerKind kind;    ///< how users ask for it
    const char* needs;  ///< what the device must have, for error messages
    bool (*possible)(const Device& device);
    bool (*preferred)(const Device& device);                         ///< whether TracerKind::automatic chooses it
    std::unique_ptr<SceneTracer> (*make)(const TracedScene& scene);  ///< throws
    bool hitsTriangles = true;                                       ///< of the scene; emitter samples need them
    ShaderBook shaders = shaderCode;                                 ///< has the passes compiled for it

    /// This tracer's variant of a pass marked `// variants: tracers`.
    Shader shader(const char* pass) const { return {std::string(pass) + "_" + name, shaders}; }
};

/// The tracer of the wanted kind; for TracerKind::automatic the first preferred one. Throws unsupported.
const SceneTracerType& sceneTracerType(const Device& device, TracerKind wanted);

}  // namespace probegi::vulkan

#pragma once

#include <optional>

#include "geometry/emitters.h"
#include "vulkan/tracers/scene_tracer.h"

namespace probegi::vulkan {

struct GpuScene::Impl {
    /// Throws.
    Impl(const Context& context, const Device& device, const Scene& scene, const ScenePose& pose,
         const GpuSceneDesc& desc, const SceneTracerType& type);
    /// GpuScene::create() with the tracer `type` instead of the one that desc asks for.
    static Result<GpuScene> create(const Context& context, const Device& device, const Scene& scene,
                                   const ScenePose& pose, const GpuSceneDesc& desc, const SceneTracerType& type);

    vk::DescriptorSet set() const noexcept { return *sets.front(); }
    /// This tracer's variant of a pass marked `// variants: tracers`.
    Shader shader(const char* pass) const { return tracerType.shader(pass); }
    kernels::SceneConstants constants() const;
    Bounds placedBounds() const;  // for the current placements
    bool placeEmitters();         // for the current placements; returns whether there are any
    /// GpuScene::recordPose() of a scene of primitives.
    Result<void> movePrimitives(VkCommandBuffer commands, const ScenePose& pose);

    Device device;
    std::optional<PlacedPrimitives> primitives;  // instead of triangles
    std::vector<Placement> placements;
    Bounds bounds;
    Bounds worldBounds;  // of the merged meshes; undefined without hasWorld
    bool hasWorld = false;
    std::vector<Bounds> groupBounds;  // in their own spaces
    EmitterGeometry emitterGeometry;
    EmitterSet emitters;  // for the current placements
    Buffer vertices, triangles, uv1, tangents, meshes, instances, materials, textures, texels, srgbTable, emitterBuffer;
    Buffer constantsBuffer;
    SceneTracerType tracerType;
    std::unique_ptr<SceneTracer> tracer;
    vk::raii::DescriptorPool pool{nullptr};
    vk::raii::DescriptorSets sets{nullptr};
    Staging staging;
    SceneData data;  // source of the staged copies; cleared with them

private:
    void measure(const SceneGeometry& geometry);
    void upload();
    void writeSet();
};

}  // namespace probegi::vulkan

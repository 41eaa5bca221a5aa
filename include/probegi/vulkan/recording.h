#pragma once

#include <array>

#include "probegi/field.h"
#include "probegi/image.h"
#include "probegi/sdf.h"
#include "probegi/shared/screen_sample.h"
#include "probegi/vulkan/device.h"

/// For engines: passes that are recorded into the engine's own command buffers.
namespace probegi::vulkan {

using probegi::TracerKind;

struct GpuSceneDesc {
    TracerKind tracer = TracerKind::automatic;
    /// Keep the instances of animated nodes separate so that recordPose() can move them. Otherwise meshes with one
    /// instance are merged, which traces slightly faster.
    bool movable = false;
    /// Further nodes that recordPose() can move, with their children: objects moved by the engine. Read during the call
    /// only.
    std::span<const int> movableNodes{};
    /// With TracerKind::sdf, and only then: the primitives to trace, as makeSdfTracer does; recordPose() moves those
    /// that ride on nodes, and the scene's triangles and materials are not uploaded. Read during the call only.
    const SdfScene* sdf = nullptr;
};

/// A scene's triangles, materials, textures and acceleration structures in GPU memory.
class PROBEGI_API GpuScene {
public:
    /// Builds the BVH on the context's threads, allocates, and fills staging memory. The scene must be valid; it is
    /// read during the call only. Errors: outOfMemory, unsupported (ray query requested but unavailable),
    /// invalidArgument (no such movable node in the scene; primitives without TracerKind::sdf, or it without them), and
    /// those of makeSdfTracer.
    static Result<GpuScene> create(const Context& context, const Device& device, const Scene& scene,
                                   const ScenePose& pose, const GpuSceneDesc& desc = {});
    GpuScene(GpuScene&&) noexcept;
    GpuScene& operator=(GpuScene&&) noexcept;
    ~GpuScene();

    /// Copies everything to the GPU and builds acceleration structures. Once, before any other use. Ends with a barrier
    /// to compute shaders. Errors: invalidArgument (after releaseStaging()), outOfMemory.
    Result<void> recordUpload(VkCommandBuffer commands);
    /// Frees the staging memory. The command buffer of recordUpload() must have finished.
    void releaseStaging() noexcept;
    /// Moves the instances of GpuSceneDesc::movable and movableNodes, and refits the top level. Includes barriers
    /// against compute work before and after it in the queue. Errors: invalidArgument (the pose is of another scene).
    Result<void> recordPose(VkCommandBuffer commands, const ScenePose& pose);

    TracerKind tracer() const noexcept;  ///< never automatic
    Bounds bounds() const noexcept;
    std::size_t bytes() const noexcept;  ///< of GPU memory, excluding staging

    struct Impl;
    Impl& impl() const noexcept { return *m_impl; }

private:
    explicit GpuScene(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> m_impl;
};

/// Punctual lights and sky in GPU memory.
class PROBEGI_API GpuLighting {
public:
    /// Capacity for at least `maxLights` lights, or as many as `lighting` has. Errors: outOfMemory.
    static Result<GpuLighting> create(const Device& device, const Lighting& lighting, int maxLights = 16);
    GpuLighting(GpuLighting&&) noexcept;
    GpuLighting& operator=(GpuLighting&&) noexcept;
    ~GpuLighting();

    /// As for GpuScene.
    Result<void> recordUpload(VkCommandBuffer commands);
    void releaseStaging() noexcept;
    /// Replaces the lights and the sky's factor, with the data in the command buffer. The sky's image cannot change.
    /// Errors: invalidArgument (more lights than the capacity).
    Result<void> recordUpdate(VkCommandBuffer commands, const Lighting& lighting);
    std::size_t bytes() const noexcept;

    struct Impl;
    Impl& impl() const noexcept { return *m_impl; }

private:
    explicit GpuLighting(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> m_impl;
};

/// Part of a storage buffer, written by the caller and read by the library.
struct BufferRange {
    VkDeviceAddress address = 0;  ///< a multiple of 4
    VkDeviceSize bytes = 0;       ///< readable from `address` on; 0: an empty range

    bool empty() const noexcept { return bytes == 0; }
};

/// How the caller's rays are stored.
enum class RayFormat : std::uint8_t {
    full,    ///< RayDatum, 16 bytes
    packed,  ///< PackedRayDatum, 8 bytes
};

/// Number of descriptors of `probegi/query.glsl`, from `PROBEGI_BINDING` on.
inline constexpr std::uint32_t kQueryBindings = 4;

/// How shaders of the engine see the first of these.
enum class QueryConstants : std::uint8_t {
    uniformBuffer,  ///< `query.glsl`, `query.metal`
    storageBuffer,  ///< `query.hlsl`; `query.glsl` with PROBEGI_CONSTANTS_IN_BUFFER
};

/// A field's probes on the GPU: atlases, and the passes that update and query them. The same field as the CPU's: same
/// rays in, same irradiance out.
class PROBEGI_API GpuField {
public:
    /// Errors: invalidArgument (as Field::create), unsupported (more probes than the device's images hold, or together
    /// more than 2^31 - 1 rays), outOfMemory.
    static Result<GpuField> create(const Device& device, const FieldDesc& desc, const FieldSettings& settings = {});
    GpuField(GpuField&&) noexcept;
    GpuField& operator=(GpuField&&) noexcept;
    ~GpuField();

    /// Settings, events, the coming update's probes and rays. What is set counts for passes that are recorded from then
    /// on; shaders of the engine that read the field through `probegi/query.glsl` have new settings from the next
    /// recordSettings(), recordUpdate(), recordQuery() or recordShading() on.
    FieldControl& control() noexcept;
    const FieldControl& control() const noexcept;
    const FieldDesc& desc() const noexcept { return control().desc(); }
    FieldMemory memory() const noexcept;  ///< of GPU memory

    /// Uploads the settings, new masks and primitives, for the shaders that read the field (with LeakGuard::masks and
    /// sdfShadow they define PROBEGI_MASKS), for engines that change them between updates. Orders itself against what
    /// comes before and after in the queue; nothing where nothing has changed. Errors: outOfMemory.
    Result<void> recordSettings(VkCommandBuffer commands);

    /// Clears the probes and restarts at frame 0. Record it once before any other use, and to discard all light (a new
    /// level). Includes barriers before and after. Errors: outOfMemory.
    Result<void> recordClear(VkCommandBuffer commands);

    /// Moves a volume's window, as Field::scroll. Includes barriers before and after. Errors: invalidArgument (no such
    /// volume, too far), outOfMemory (the first call compiles the pass).
    Result<void> recordScroll(VkCommandBuffer commands, int volume, glm::ivec3 cells);

    /// Scrolls the volumes that track a camera, as Field::followCamera, and uploads its position for the shaders that
    /// read the field. Includes barriers before and after. Errors: those of recordScroll() and recordSettings(),
    /// invalidArgument too where the position is not finite.
    Result<void> recordFollowCamera(VkCommandBuffer commands, glm::vec3 camera);

    /// One update with the library's rays: trace, shade with the lighting and last frame's field, blend. Begins and
    /// ends with a full barrier, so reads of the volume in the same queue need none. Errors: outOfMemory (the first
    /// call allocates the ray data buffer).
    Result<void> recordUpdate(VkCommandBuffer commands, const GpuScene& scene, const GpuLighting& lighting,
                              Profiler* profiler = nullptr);

    /// One update from the caller's own rays: RayDatum (16 bytes) [task * raysPerProbe + ray] along rayDirections(),
    /// from tasks()[task].origin. The caller makes the data visible to compute shader reads. Radiance that is not a
    /// number or infinite counts as 0. Errors: invalidArgument (the range is too short for all rays, or its address is
    /// not a multiple of 4), outOfMemory.
    Result<void> recordUpdate(VkCommandBuffer commands, const BufferRange& rayData, Profiler* profiler = nullptr);

    /// The same with fixed rays, as Field::update: `fixedRays` holds FixedRayDatum (12 bytes) [task * fixedRays + ray]
    /// along fixedRayDirections(); an empty range: none. `format` is that of `rayData`.
    Result<void> recordUpdate(VkCommandBuffer commands, const BufferRange& rayData, const BufferRange& fixedRays,
                              Profiler* profiler = nullptr, RayFormat format = RayFormat::full);

    /// With FieldDesc::relocation or probeStates, for callers that trace the rays: steps the probes' states and lists
    /// the coming update's tasks in taskBuffer(). recordUpdate() without a scene needs it before each update; that with
    /// a scene does it by itself. Begins and ends with a full barrier, and the list may be read by indirect dispatches
    /// and compute shaders. What FieldControl says of tasks, activities and positions is the lattice's then: the CPU
    /// does not see what the GPU decides. Tasks and bounds are those of this call until the update. Errors:
    /// invalidArgument (the field has neither; over 256 bounds of FieldControl::setMoving and setMedia), outOfMemory.
    Result<void> recordTasks(VkCommandBuffer commands);
    /// 16 words, of which the first is the number of tasks, words 1 to 3 the groups of 64 threads for a thread a task,
    /// 4 to 6 those for a thread a ray (raysPerProbe and fixed rays of each task); then ProbeTask (20 bytes) [task].
    /// For indirect dispatches, copies, and as a storage buffer by its address. Valid for the life of the field.
    VkBuffer taskBuffer() const noexcept;

    /// Irradiance at `count` points, at most 2^30. `queries`: address of FieldQuery[count] (36 bytes each);
    /// `irradiance`: address of vec3[count] (12 bytes each), W m^-2; multiples of 4. The caller synchronises these
    /// buffers with the compute shader stage, before and after. Errors: outOfMemory (the first call compiles the pass).
    Result<void> recordQuery(VkCommandBuffer commands, VkDeviceAddress queries, VkDeviceAddress irradiance,
                             std::uint32_t count, Profiler* profiler = nullptr);

    /// The kQueryBindings layout bindings of `probegi/query.glsl`, for the given stages, from `firstBinding` on: the
    /// field's constants, the irradiance and visibility atlases (combined image samplers), the probes' states (storage
    /// buffer).
    static std::array<VkDescriptorSetLayoutBinding, kQueryBindings> queryBindings(
        std::uint32_t firstBinding, VkShaderStageFlags stages,
        QueryConstants constants = QueryConstants::uniformBuffer) noexcept;
    /// Writes them into a descriptor set of the caller. Valid for the life of the field.
    void writeQueryBindings(VkDescriptorSet set, std::uint32_t firstBinding,
                            QueryConstants constants = QueryConstants::uniformBuffer) const;

    struct Impl;
    Impl& impl() const noexcept { return *m_impl; }

private:
    explicit GpuField(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> m_impl;
};

/// Deferred shading of `count` samples at the address of ScreenSample[count] (a multiple of 4, at most 2^30): punctual
/// lights with shadow rays and the metallic-roughness material, then the field (null: none). The caller makes the
/// samples visible to compute shaders before, and synchronises its own reads with the compute shader writes after.
/// Errors: outOfMemory (the first call compiles the passes), invalidArgument (objects of different devices).
PROBEGI_API Result<void> recordShading(VkCommandBuffer commands, const GpuScene& scene, const GpuLighting& lighting,
                                       GpuField* field, VkDeviceAddress samples, std::uint32_t count,
                                       bool diffuseOnly = false, Profiler* profiler = nullptr);

/// Tone-maps linear values to 8-bit sRGB, dithered if `toneMap` says so. `linear` is the address of vec3[width *
/// height], row by row; `display` of as many std::uint32_t, red in the lowest byte, alpha 255; at most 2^30 pixels.
/// Synchronised by the caller as above. Errors: outOfMemory.
PROBEGI_API Result<void> recordToneMap(VkCommandBuffer commands, const Device& device, VkDeviceAddress linear,
                                       VkDeviceAddress display, std::uint32_t width, std::uint32_t height,
                                       const ToneMap& toneMap, Profiler* profiler = nullptr);

}  // namespace probegi::vulkan

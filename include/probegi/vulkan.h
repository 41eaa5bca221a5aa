#pragma once

#include <vulkan/vulkan_core.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "probegi/export.h"
#include "probegi/field.h"
#include "probegi/render.h"

/// The Vulkan 1.3 backend. Two ways in:
///
/// An engine hands over its device (Device::adopt) and records passes into its own command buffers: GpuField,
/// GpuScene, GpuLighting. Recording never submits, waits or maps memory; the barriers between the library's own passes
/// are recorded with them, and each record function says what the caller must order before and after it. Record outside
/// of render passes; compute pipeline, descriptor sets and push constants of the command buffer are not kept. What a
/// command buffer uses must live until it has finished.
///
/// A program without a device opens one (Device::open) and uses the CPU backend's API on the GPU: makeTracer(),
/// makeMovableTracer(), makeField(), renderPicture(). These submit and wait.
namespace probegi::vulkan {

/// A Vulkan device of this machine.
struct DeviceInfo {
    int index = 0;       ///< for OpenDesc::device
    std::string name{};  ///< as reported by the driver
    std::string driver{};
    std::string type{};  ///< "discrete GPU", "integrated GPU", "virtual GPU", "software", "other"
    std::string api{};   ///< Vulkan version, "1.3.230"
    bool rayQuery = false;
    std::string missing{};  ///< what ProbeGI needs and the device lacks; empty: usable
    bool usable() const { return missing.empty(); }
};

/// All devices, in the loader's order. Errors: unsupported (no Vulkan loader on this machine, or no driver).
PROBEGI_API Result<std::vector<DeviceInfo>> listDevices();

/// What an allocation will be used for.
enum class MemoryUse : std::uint8_t {
    device,    ///< by the GPU only
    upload,    ///< written by the CPU, read by copies; must be host visible, coherent and mapped
    readback,  ///< written by copies, read by the CPU; must be host visible, coherent and mapped
};

struct Allocation {
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkDeviceSize offset = 0;   ///< bytes
    void* mapped = nullptr;    ///< where `offset` is mapped, for upload and readback
    void* userData = nullptr;  ///< the allocator's own
};

/// An engine's memory allocator. Empty functions: the library calls vkAllocateMemory for each buffer and image, about a
/// dozen for a volume and two dozen for a scene. All memory must be allocated with
/// VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT. Buffers and images may share a VkDeviceMemory, so suballocations must respect
/// bufferImageGranularity. `allocate` reports failure by its result and must not throw. Set both functions or neither.
struct Allocator {
    std::function<VkResult(const VkMemoryRequirements&, MemoryUse, Allocation&)> allocate{};
    std::function<void(const Allocation&)> free{};
};

/// An engine's device and how it was created. The engine keeps ownership of all handles, which must outlive every
/// object of this library.
///
/// Needed: Vulkan 1.3 on instance and device; the features synchronization2, bufferDeviceAddress, scalarBlockLayout
/// and shaderStorageImageExtendedFormats; a queue family with compute; the format R16G16B16A16_SFLOAT and R16G16_UNORM
/// as storage images and as sampled images with linear filter. Used where enabled: VK_KHR_acceleration_structure with
/// VK_KHR_ray_query, VK_EXT_debug_utils.
struct AdoptDesc {
    VkInstance instance = VK_NULL_HANDLE;
    VkPhysicalDevice physicalDevice = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    std::uint32_t queueFamily = 0;  ///< of the command buffers that passes are recorded into
    /// The device's create info; extensions and features (pNext chain or pEnabledFeatures) are read during the call.
    /// Required.
    const VkDeviceCreateInfo* createInfo = nullptr;
    std::span<const char* const> instanceExtensions{};        ///< enabled ones
    PFN_vkGetInstanceProcAddr getInstanceProcAddr = nullptr;  ///< null: that of the system's loader
    Allocator allocator{};
    /// Folder for the pipeline cache; empty: none, pipelines are compiled every run. A damaged cache file is ignored; a
    /// folder that cannot be written is reported in the context's log.
    std::filesystem::path cacheFolder{};
};

/// How Device::open creates a device.
struct OpenDesc {
    /// An index or part of a name from listDevices(); empty: the first usable device, discrete GPUs before integrated,
    /// virtual and software ones.
    std::string device{};
    bool rayQuery = true;     ///< enable ray query if available
    bool validation = false;  ///< Khronos validation layer with synchronisation validation; messages go to the log
    std::filesystem::path cacheFolder{};                      ///< as AdoptDesc::cacheFolder
    PFN_vkGetInstanceProcAddr getInstanceProcAddr = nullptr;  ///< null: that of the system's loader
};

/// A device with the library's functions, pipelines and memory for it. Cheap to copy (shared handle). The caller must
/// serialise calls on one Device; Devices are independent of each other.
class PROBEGI_API Device {
public:
    /// Errors: invalidArgument (a handle is missing), unsupported (names the missing version, feature or format),
    /// outOfMemory.
    static Result<Device> adopt(const Context& context, const AdoptDesc& desc);
    /// Errors: unsupported (no loader, no such device, or what the device lacks), outOfMemory.
    static Result<Device> open(const Context& context, const OpenDesc& desc = {});

    const DeviceInfo& info() const noexcept;
    bool rayQuery() const noexcept;  ///< whether TracerKind::rayQuery is available
    /// Validation messages so far (OpenDesc::validation).
    int validationMessages() const noexcept;
    /// Writes the compiled pipelines to the cache folder; done by the destructor of the last handle as well.
    /// Errors: writeFailed.
    Result<void> savePipelines() const;

    struct Impl;
    Impl& impl() const noexcept { return *m_impl; }

private:
    explicit Device(std::shared_ptr<Impl> impl) : m_impl(std::move(impl)) {}
    std::shared_ptr<Impl> m_impl;
};

struct PassTime {
    std::string name{};
    double milliseconds = 0;
};

/// GPU timestamps around passes. Pass one to record functions and read it when the command buffer has finished.
class PROBEGI_API Profiler {
public:
    /// `maxPasses` 1..1024. Errors: outOfMemory. A queue family without timestamps gives an empty list, not an error.
    static Result<Profiler> create(const Device& device, int maxPasses = 64);
    Profiler(Profiler&&) noexcept;
    Profiler& operator=(Profiler&&) noexcept;
    ~Profiler();

    /// Resets the timestamps. Record it before the passes of each frame.
    void recordReset(VkCommandBuffer commands);
    /// Times what is recorded between the two calls; passes may not nest. Passes beyond maxPasses are not timed.
    void recordBegin(VkCommandBuffer commands, const char* name);
    void recordEnd(VkCommandBuffer commands);
    /// Milliseconds of each pass, in order. Unchecked: the command buffer must have finished. Errors: deviceLost.
    Result<std::vector<PassTime>> read() const;

    struct Impl;

private:
    explicit Profiler(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> m_impl;
};

/// How triangles are traced on the GPU.
enum class TracerKind : std::uint8_t {
    automatic,  ///< ray query where it is in hardware, else the BVH
    bvh,        ///< the library's own wide, quantised BVH in compute; any device
    rayQuery,   ///< VK_KHR_ray_query
};

struct GpuSceneDesc {
    TracerKind tracer = TracerKind::automatic;
    /// Keep the instances of animated nodes separate so that recordPose() can move them. Otherwise meshes with one
    /// instance are merged, which traces slightly faster.
    bool movable = false;
    /// Further nodes that recordPose() can move, with their children: objects moved by the engine. Read during the call
    /// only.
    std::span<const int> movableNodes{};
};

/// A scene's triangles, materials, textures and acceleration structures in GPU memory.
class PROBEGI_API GpuScene {
public:
    /// Builds the BVH on the context's threads, allocates, and fills staging memory. The scene must be valid; it is
    /// read during the call only. Errors: outOfMemory, unsupported (ray query requested but unavailable),
    /// invalidArgument (no such movable node in the scene).
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

/// Number of descriptors of `probegi/query.glsl`, from `PROBEGI_BINDING` on.
inline constexpr std::uint32_t kQueryBindings = 4;

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

    /// Hands the settings to the shaders that read the field, for engines that change them between updates. Orders
    /// itself against what comes before and after in the queue; nothing where nothing has changed. Errors: outOfMemory.
    Result<void> recordSettings(VkCommandBuffer commands);

    /// Clears the probes and restarts at frame 0. Record it once before any other use, and to discard all light (a new
    /// level). Includes barriers before and after. Errors: outOfMemory.
    Result<void> recordClear(VkCommandBuffer commands);

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
    /// along fixedRayDirections(); an empty range: none.
    Result<void> recordUpdate(VkCommandBuffer commands, const BufferRange& rayData, const BufferRange& fixedRays,
                              Profiler* profiler = nullptr);

    /// Irradiance at `count` points, at most 2^30. `queries`: address of FieldQuery[count] (36 bytes each);
    /// `irradiance`: address of vec3[count] (12 bytes each), W m^-2; multiples of 4. The caller synchronises these
    /// buffers with the compute shader stage, before and after. Errors: outOfMemory (the first call compiles the pass).
    Result<void> recordQuery(VkCommandBuffer commands, VkDeviceAddress queries, VkDeviceAddress irradiance,
                             std::uint32_t count, Profiler* profiler = nullptr);

    /// The kQueryBindings layout bindings of `probegi/query.glsl`, for the given stages, from `firstBinding` on: the
    /// field's constants (uniform buffer), the irradiance and visibility atlases (combined image samplers), the
    /// probes' states (storage buffer).
    static std::array<VkDescriptorSetLayoutBinding, kQueryBindings> queryBindings(std::uint32_t firstBinding,
                                                                                  VkShaderStageFlags stages) noexcept;
    /// Writes them into a descriptor set of the caller. Valid for the life of the field.
    void writeQueryBindings(VkDescriptorSet set, std::uint32_t firstBinding) const;

    struct Impl;
    Impl& impl() const noexcept { return *m_impl; }

private:
    explicit GpuField(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> m_impl;
};

/// One entry of a G-buffer in a storage buffer, and recordShading()'s results. 100 bytes, no padding.
struct ShadingSample {
    /// What is visible there; only surfaces are shaded.
    enum Kind : std::int32_t { sky = 0, surface = 1, backface = 2 };

    glm::vec3 position{0.0f};
    std::int32_t kind = sky;
    glm::vec3 viewDirection{0, 0, -1};   ///< unit, from the viewer to the position
    float distance = 0;                  ///< metres from the viewer; passed through
    glm::vec3 geometricNormal{0, 1, 0};  ///< unit, on the viewer's side
    float metallic = 0;                  ///< 0..1
    glm::vec3 shadingNormal{0, 1, 0};    ///< unit, on the viewer's side
    float roughness = 1;                 ///< 0..1, perceptual
    glm::vec3 albedo{0.0f};              ///< base colour, 0..1
    glm::vec3 direct{0.0f};              ///< in: emission; out: plus light of punctual lights, W sr^-1 m^-2
    glm::vec3 indirect{0.0f};            ///< out: irradiance E of the field, W m^-2; radiance is albedo * E / pi
};

/// Deferred shading of `count` samples at the address of ShadingSample[count] (a multiple of 4, at most 2^30): punctual
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

/// Triangles traced on the GPU: closestHits(), occluded() and surfaces() upload, dispatch and wait, so large batches
/// are best; a Field of the same device traces without leaving the GPU. They fail with deviceLost or outOfMemory. The
/// scene must be valid and outlive the tracer. Errors: outOfMemory, unsupported.
PROBEGI_API Result<std::unique_ptr<Tracer>> makeTracer(const Context& context, const Device& device, const Scene& scene,
                                                       const ScenePose& pose, const GpuSceneDesc& desc = {});

/// The same for a scene in which things move: setPose() refits the top level on the GPU, and waits. Errors: those, and
/// invalidArgument (a node that the scene has not).
PROBEGI_API Result<std::unique_ptr<MovableTracer>> makeMovableTracer(const Context& context, const Device& device,
                                                                     const Scene& scene, const ScenePose& pose,
                                                                     const MovableDesc& movable = {},
                                                                     TracerKind tracer = TracerKind::automatic);

/// A Field whose passes run on the GPU. Its update() accepts any Tracer: with one of makeTracer() on the same device
/// everything stays on the GPU, with another the rays are traced and shaded by the CPU and uploaded.
/// Errors: as GpuField::create.
PROBEGI_API Result<Field> makeField(const Context& context, const Device& device, const FieldDesc& desc,
                                    const FieldSettings& settings = {});

/// GPU time of each pass of the field's last update and last batch of queries. Empty for other backends, or if the
/// device has no timestamps.
PROBEGI_API std::vector<PassTime> lastPassTimes(const Field& field);

/// As probegi::renderPicture, on the GPU: primary rays, direct light with shadow rays, query, resolve. `tracer` must be
/// from makeTracer() and `field` (may be null) from makeField(), both on this device.
/// Errors: invalidArgument (size; tracer or field of another backend), outOfMemory, deviceLost, cancelled.
PROBEGI_API Result<RenderedPicture> renderPicture(const Context& context, const Device& device, const Tracer& tracer,
                                                  const Lighting& lighting, const Field* field,
                                                  const PictureDesc& desc);

/// Tone-maps to 8-bit sRGB on the GPU, four bytes per pixel. Errors: outOfMemory, deviceLost.
PROBEGI_API Result<std::vector<std::uint8_t>> toneMapImage(const Device& device, const HdrImage& image,
                                                           const ToneMap& toneMap);

}  // namespace probegi::vulkan

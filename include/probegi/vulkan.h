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
/// An engine hands over its device (Device::adopt) and records passes into its own command buffers: ProbeVolume,
/// GpuScene, GpuLighting. Recording never submits, waits or maps memory; the barriers between the library's own passes
/// are recorded with them, and each record function says what the caller must order before and after it. Record outside
/// of render passes; compute pipeline, descriptor sets and push constants of the command buffer are not kept. What a
/// command buffer uses must live until it has finished.
///
/// A program without a device opens one (Device::open) and uses what the CPU backend offers, on the GPU: makeTracer(),
/// makeMovableTracer(), makeField(), renderPicture(). These submit and wait.
namespace probegi::vulkan {

/// One Vulkan device of this machine.
struct DeviceInfo {
    int index = 0;       ///< for OpenDesc::device
    std::string name{};  ///< as the driver gives it
    std::string driver{};
    std::string type{};  ///< "discrete GPU", "integrated GPU", "virtual GPU", "software", "other"
    std::string api{};   ///< Vulkan version, "1.3.230"
    bool rayQuery = false;
    std::string missing{};  ///< what ProbeGI needs and the device lacks; empty: usable
    bool usable() const { return missing.empty(); }
};

/// All devices, in the order of the loader. Errors: unsupported (no Vulkan loader on this machine, or no driver).
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

/// An engine's memory allocator. Empty functions: the library calls vkAllocateMemory for each buffer and image, about
/// a dozen for a volume and two dozen for a scene. All memory must be allocated with
/// VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT, and buffers and images share it: pieces of one VkDeviceMemory keep
/// bufferImageGranularity apart. `allocate` says why it fails by its result, and throws nothing. Give both or neither.
struct Allocator {
    std::function<VkResult(const VkMemoryRequirements&, MemoryUse, Allocation&)> allocate{};
    std::function<void(const Allocation&)> free{};
};

/// An engine's device, as it was made. All handles stay the engine's and must outlive every object of this library.
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
    /// What the device was made with: its extensions and features (pNext chain or pEnabledFeatures) are read during
    /// the call. Required.
    const VkDeviceCreateInfo* createInfo = nullptr;
    std::span<const char* const> instanceExtensions{};        ///< enabled ones
    PFN_vkGetInstanceProcAddr getInstanceProcAddr = nullptr;  ///< null: that of the system's loader
    Allocator allocator{};
    /// Folder in which compiled pipelines are kept between runs; empty: they are compiled anew. A damaged file in it is
    /// ignored, a folder that cannot be written is reported to the context's log.
    std::filesystem::path cacheFolder{};
};

/// How the library opens a device of its own.
struct OpenDesc {
    /// An index or part of a name, as listDevices() gives them; empty: the first usable discrete GPU, or else
    /// integrated, virtual, software one.
    std::string device{};
    bool rayQuery = true;     ///< enable ray query where the device has it
    bool validation = false;  ///< Khronos validation layer with synchronisation validation; messages go to the log
    std::filesystem::path cacheFolder{};                      ///< as AdoptDesc::cacheFolder
    PFN_vkGetInstanceProcAddr getInstanceProcAddr = nullptr;  ///< null: that of the system's loader
};

/// A device and what the library keeps for it: functions, pipelines, memory. Cheap to copy (shared handle). Calls on
/// one Device from several threads must be ordered by the caller; two Devices are independent.
class PROBEGI_API Device {
public:
    /// Errors: invalidArgument (a handle is missing), unsupported (names the missing version, feature or format),
    /// outOfMemory.
    static Result<Device> adopt(const Context& context, const AdoptDesc& desc);
    /// Errors: unsupported (no loader, no device, no such device, or what it lacks), outOfMemory.
    static Result<Device> open(const Context& context, const OpenDesc& desc = {});

    const DeviceInfo& info() const noexcept;
    bool rayQuery() const noexcept;  ///< whether TracerKind::rayQuery is possible
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

/// GPU timestamps around passes. Give one to record functions, read it once the command buffer has finished.
class PROBEGI_API Profiler {
public:
    /// `maxPasses` 1..1024. Errors: outOfMemory. A queue family without timestamps gives an empty list, not an error.
    static Result<Profiler> create(const Device& device, int maxPasses = 64);
    Profiler(Profiler&&) noexcept;
    Profiler& operator=(Profiler&&) noexcept;
    ~Profiler();

    /// Forgets what was recorded. Record it before the passes of each frame.
    void recordReset(VkCommandBuffer commands);
    /// Encloses what is recorded between the two calls; passes may not nest. Beyond maxPasses they are not timed.
    void recordBegin(VkCommandBuffer commands, const char* name);
    void recordEnd(VkCommandBuffer commands);
    /// Milliseconds of each pass, in order. Unchecked: the command buffer must have finished. Errors: deviceLost.
    Result<std::vector<PassTime>> read() const;

    struct Impl;

private:
    explicit Profiler(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> m_impl;
};

/// Second half of the first axis: how triangles are traced on the GPU.
enum class TracerKind : std::uint8_t {
    automatic,  ///< ray query where the device has it in hardware, else the BVH
    bvh,        ///< the library's own wide, quantised BVH in compute: any device
    rayQuery,   ///< VK_KHR_ray_query
};

struct GpuSceneDesc {
    TracerKind tracer = TracerKind::automatic;
    /// Keep the instances of animated nodes apart, so that recordPose() can move them; otherwise meshes that are placed
    /// once are merged, which traces a little faster.
    bool movable = false;
    /// Nodes that recordPose() can move though no animation does: an engine's own moving objects. Their children move
    /// with them. Read during the call only.
    std::span<const int> movableNodes{};
};

/// A scene's triangles, materials and textures in GPU memory, with what the tracer needs to find hits.
class PROBEGI_API GpuScene {
public:
    /// Builds the BVH on the context's threads, allocates, and fills staging memory. The scene must be valid; it is
    /// read during the call only. Errors: outOfMemory, unsupported (ray query asked for and not there), invalidArgument
    /// (a movable node that the scene has not).
    static Result<GpuScene> create(const Context& context, const Device& device, const Scene& scene,
                                   const ScenePose& pose, const GpuSceneDesc& desc = {});
    GpuScene(GpuScene&&) noexcept;
    GpuScene& operator=(GpuScene&&) noexcept;
    ~GpuScene();

    /// Copies everything to the GPU and builds acceleration structures. Once, before any other use. Ends with a barrier
    /// to compute shaders. Errors: invalidArgument (after releaseStaging(), there is nothing left to copy),
    /// outOfMemory.
    Result<void> recordUpload(VkCommandBuffer commands);
    /// Frees the staging memory. The command buffer of recordUpload() must have finished.
    void releaseStaging() noexcept;
    /// Moves the instances of GpuSceneDesc::movable and movableNodes, and refits the top level. Orders itself against
    /// compute work before and after it in the queue. Errors: invalidArgument (the pose is of another scene).
    Result<void> recordPose(VkCommandBuffer commands, const ScenePose& pose);

    TracerKind tracer() const noexcept;  ///< never automatic
    Bounds bounds() const noexcept;
    std::size_t bytes() const noexcept;  ///< of GPU memory, without staging

    struct Impl;
    Impl& impl() const noexcept { return *m_impl; }

private:
    explicit GpuScene(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> m_impl;
};

/// Punctual lights and sky in GPU memory.
class PROBEGI_API GpuLighting {
public:
    /// Room for at least `maxLights` lights (more where the lighting has more). Errors: outOfMemory.
    static Result<GpuLighting> create(const Device& device, const Lighting& lighting, int maxLights = 16);
    GpuLighting(GpuLighting&&) noexcept;
    GpuLighting& operator=(GpuLighting&&) noexcept;
    ~GpuLighting();

    /// As GpuScene's.
    Result<void> recordUpload(VkCommandBuffer commands);
    void releaseStaging() noexcept;
    /// New lights and a new factor for the sky, from the command buffer itself. The sky's image stays as it was made.
    /// Errors: invalidArgument (more lights than there is room for).
    Result<void> recordUpdate(VkCommandBuffer commands, const Lighting& lighting);
    std::size_t bytes() const noexcept;

    struct Impl;
    Impl& impl() const noexcept { return *m_impl; }

private:
    explicit GpuLighting(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> m_impl;
};

/// Part of a storage buffer that the caller fills and the library reads.
struct BufferRange {
    VkDeviceAddress address = 0;  ///< a multiple of 4
    VkDeviceSize bytes = 0;       ///< from there on that may be read; 0: an empty range

    bool empty() const noexcept { return bytes == 0; }
};

/// Descriptors that `probegi/query.glsl` reads, from `PROBEGI_BINDING` on, in this order.
inline constexpr std::uint32_t kQueryBindings = 4;

/// A volume of probes on the GPU: atlases, and the passes that update and query them. The same field as the CPU's:
/// same rays in, same irradiance out.
class PROBEGI_API ProbeVolume {
public:
    /// Errors: invalidArgument (as Field::create), unsupported (an axis has more probes than the device's images have
    /// texels for, or the probes together have more than 2^31 - 1 rays), outOfMemory.
    static Result<ProbeVolume> create(const Device& device, const FieldDesc& desc);
    ProbeVolume(ProbeVolume&&) noexcept;
    ProbeVolume& operator=(ProbeVolume&&) noexcept;
    ~ProbeVolume();

    const FieldDesc& desc() const noexcept;
    int frame() const noexcept;           ///< updates recorded so far
    FieldMemory memory() const noexcept;  ///< of GPU memory
    /// As Field::rayDirections: of the coming update.
    std::span<const glm::vec3> rayDirections() const noexcept;
    /// As Field::fixedRayDirections: the same for all updates.
    std::span<const glm::vec3> fixedRayDirections() const noexcept;
    void notify(FieldEvent event) noexcept;
    /// The guard of passes that are recorded from now on. Shaders of the engine that read the volume through
    /// `probegi/query.glsl` have it from the next recordGuard(), recordUpdate(), recordQuery() or recordShading() on.
    void setGuard(LeakGuard guard) noexcept;

    /// Hands setGuard()'s guard to the shaders that read the volume, for engines that change it between updates. Orders
    /// itself against what comes before and after in the queue; nothing where nothing has changed. Errors: outOfMemory.
    Result<void> recordGuard(VkCommandBuffer commands);

    /// Clears the probes and begins at frame 0. Once before any other use, and whenever the probes shall forget
    /// (another level). Orders itself against what comes before and after in the queue. Errors: outOfMemory.
    Result<void> recordClear(VkCommandBuffer commands);

    /// One update with the library's rays: trace, shade with the lighting and last frame's field, blend. Begins and
    /// ends with a barrier over all commands, so that reads of the volume before and after it in the queue need none of
    /// their own. Errors: outOfMemory (the ray data's buffer, made by the first call).
    Result<void> recordUpdate(VkCommandBuffer commands, const GpuScene& scene, const GpuLighting& lighting,
                              Profiler* profiler = nullptr);

    /// One update from the caller's own rays: RayDatum (16 bytes) [probe * raysPerProbe + ray] along rayDirections().
    /// The caller makes the data visible to compute shader reads. Radiance that is not a number or infinite counts as
    /// 0. Errors: invalidArgument (the range is too short for all rays, or its address is not a multiple of 4),
    /// outOfMemory.
    Result<void> recordUpdate(VkCommandBuffer commands, const BufferRange& rayData, Profiler* profiler = nullptr);

    /// The same with fixed rays, as Field::update: `fixedRays` holds FixedRayDatum (12 bytes) [probe * fixedRays + ray]
    /// along fixedRayDirections(); an empty range: none.
    Result<void> recordUpdate(VkCommandBuffer commands, const BufferRange& rayData, const BufferRange& fixedRays,
                              Profiler* profiler = nullptr);

    /// Irradiance at `count` points, at most 2^30. `queries`: address of FieldQuery[count] (36 bytes each);
    /// `irradiance`: address of vec3[count] (12 bytes each), W m^-2; multiples of 4. The caller orders its own buffers
    /// before and after: compute shader.
    /// Errors: outOfMemory (compiling the pass, the first time).
    Result<void> recordQuery(VkCommandBuffer commands, VkDeviceAddress queries, VkDeviceAddress irradiance,
                             std::uint32_t count, Profiler* profiler = nullptr);

    /// The kQueryBindings layout bindings of `probegi/query.glsl`, for the given stages, from `firstBinding` on: the
    /// volume's constants (uniform buffer), the irradiance and visibility atlases (combined image samplers), the
    /// probes' states (storage buffer).
    static std::array<VkDescriptorSetLayoutBinding, kQueryBindings> queryBindings(std::uint32_t firstBinding,
                                                                                  VkShaderStageFlags stages) noexcept;
    /// Writes them into a descriptor set of the caller. Valid for the life of the volume.
    void writeQueryBindings(VkDescriptorSet set, std::uint32_t firstBinding) const;

    struct Impl;
    Impl& impl() const noexcept { return *m_impl; }

private:
    explicit ProbeVolume(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> m_impl;
};

/// One entry of a G-buffer that lies in a storage buffer, and what recordShading() makes of it. 100 bytes, no gaps.
struct ShadingSample {
    /// What is seen there; only surfaces are shaded.
    enum Kind : std::int32_t { sky = 0, surface = 1, backface = 2 };

    glm::vec3 position{0.0f};
    std::int32_t kind = sky;
    glm::vec3 viewDirection{0, 0, -1};   ///< unit, from the viewer to the position
    float distance = 0;                  ///< metres from the viewer; handed through
    glm::vec3 geometricNormal{0, 1, 0};  ///< unit, on the viewer's side
    float metallic = 0;                  ///< 0..1
    glm::vec3 shadingNormal{0, 1, 0};    ///< unit, on the viewer's side
    float roughness = 1;                 ///< 0..1, perceptual
    glm::vec3 albedo{0.0f};              ///< base colour, 0..1
    glm::vec3 direct{0.0f};              ///< in: emission; out: that and the light of punctual lights, W sr^-1 m^-2
    glm::vec3 indirect{0.0f};            ///< out: irradiance E of the field, W m^-2; radiance is albedo * E / pi
};

/// Deferred shading of `count` samples at the address of ShadingSample[count] (a multiple of 4, at most 2^30): punctual
/// lights with shadow rays and the metallic-roughness material, then the field (null: none). The caller makes the
/// samples visible to compute shaders before and orders its own reads after: compute shader writes.
/// Errors: outOfMemory (compiling the passes, the first time), invalidArgument (objects of different devices).
PROBEGI_API Result<void> recordShading(VkCommandBuffer commands, const GpuScene& scene, const GpuLighting& lighting,
                                       ProbeVolume* volume, VkDeviceAddress samples, std::uint32_t count,
                                       bool diffuseOnly = false, Profiler* profiler = nullptr);

/// A picture's linear values to 8-bit sRGB through the tone map, dithered as it says: `linear` is the address of
/// vec3[width * height], row by row, `display` of as many std::uint32_t, red in the lowest byte, alpha 255; at most
/// 2^30 pixels. Ordered by the caller as above. Errors: outOfMemory.
PROBEGI_API Result<void> recordToneMap(VkCommandBuffer commands, const Device& device, VkDeviceAddress linear,
                                       VkDeviceAddress display, std::uint32_t width, std::uint32_t height,
                                       const ToneMap& toneMap, Profiler* profiler = nullptr);

/// Triangles traced on the GPU: closestHits(), occluded() and surfaces() upload, dispatch and wait, so they want large
/// batches; a Field of the same device traces without leaving the GPU. They fail with deviceLost or outOfMemory. The
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
/// Errors: as ProbeVolume::create.
PROBEGI_API Result<Field> makeField(const Context& context, const Device& device, const FieldDesc& desc);

/// GPU time of each pass of the field's last update and of its last batch of queries. Empty for a field of another
/// backend, or where the device has no timestamps.
PROBEGI_API std::vector<PassTime> lastPassTimes(const Field& field);

/// As probegi::renderPicture, on the GPU: primary rays, direct light with shadow rays, query, resolve. `tracer` must be
/// one of makeTracer() and `field` (may be null) one of makeField(), both on this device.
/// Errors: invalidArgument (size; tracer or field of another backend), outOfMemory, deviceLost, cancelled.
PROBEGI_API Result<RenderedPicture> renderPicture(const Context& context, const Device& device, const Tracer& tracer,
                                                  const Lighting& lighting, const Field* field,
                                                  const PictureDesc& desc);

/// 8-bit sRGB through the tone map, four bytes a pixel, on the GPU. Errors: outOfMemory, deviceLost.
PROBEGI_API Result<std::vector<std::uint8_t>> toneMapImage(const Device& device, const HdrImage& image,
                                                           const ToneMap& toneMap);

}  // namespace probegi::vulkan

#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "probegi/context.h"
#include "probegi/export.h"
#include "probegi/field.h"
#include "probegi/render.h"
#include "probegi/sdf.h"
#include "probegi/tracer.h"

namespace probegi {

/// The third axis of the pipeline: where passes run.
enum class BackendKind : std::uint8_t {
    cpu,     ///< threads and SIMD; triangles by Embree
    vulkan,  ///< Vulkan compute; triangles by the library's BVH or by ray query
};

/// Renders pictures, one at a time.
class PROBEGI_API PictureRenderer {
public:
    virtual ~PictureRenderer() = default;
    /// As renderPicture(). The tracer and the field (null: no indirect light) must be of the renderer's backend, else a
    /// GPU's fails with invalidArgument.
    virtual Result<RenderedPicture> render(const Tracer& tracer, const Lighting& lighting, const Field* field,
                                           const PictureDesc& desc) = 0;
};

/// Creates tracers, fields and renderers for one place to run passes, so that a program need not know which one it is.
/// What it creates may outlive it. Objects of one Vulkan device take calls one at a time.
class PROBEGI_API Backend {
public:
    virtual ~Backend() = default;
    virtual BackendKind kind() const noexcept = 0;

    /// The scene's triangles, to trace. The scene must be valid and outlive the tracer. Errors: outOfMemory,
    /// invalidArgument, unsupported (built without Embree; no ray query on the device).
    virtual Result<std::unique_ptr<Tracer>> openScene(const Scene& scene, const ScenePose& pose) const = 0;
    /// The same for a scene in which things move. Errors: those, and invalidArgument (no such node in the scene).
    virtual Result<std::unique_ptr<MovableTracer>> openMovableScene(const Scene& scene, const ScenePose& pose,
                                                                    const MovableDesc& movable = {}) const = 0;
    /// Primitives that stand for the scene (makeSdfTracer), to trace: for updates of fields, whose probes then see them
    /// instead of the triangles. Errors: as makeSdfTracer; of a GPU also deviceLost.
    virtual Result<std::unique_ptr<MovableTracer>> openSdf(const SdfScene& sdf, const Scene& scene,
                                                           const ScenePose& pose) const = 0;
    /// Errors: as Field::create; of a GPU also unsupported (more probes or rays than it can hold), deviceLost.
    virtual Result<Field> makeField(const FieldDesc& desc, const FieldSettings& settings = {}) const = 0;
    /// Errors: outOfMemory.
    virtual Result<std::unique_ptr<PictureRenderer>> makeRenderer() const = 0;
};

/// Selects a backend; the CPU's takes no further options.
struct BackendDesc {
    BackendKind kind = BackendKind::cpu;
    /// vulkan: an index or part of a name from vulkan::listDevices(); empty: the first usable device, discrete GPUs
    /// before others.
    std::string device{};
    TracerKind tracer = TracerKind::automatic;  ///< vulkan
    std::filesystem::path cacheFolder{};        ///< vulkan: for compiled pipelines; empty: they are compiled every run
};

/// Opens the CPU backend, or a Vulkan device and its backend; vulkan::makeBackend() takes a device that is open
/// already. Errors: unsupported (built without Vulkan, no such device, what it lacks), outOfMemory.
PROBEGI_API Result<std::unique_ptr<Backend>> openBackend(const Context& context, const BackendDesc& desc = {});

}  // namespace probegi

#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "probegi/context.h"
#include "probegi/export.h"
#include "probegi/field.h"
#include "probegi/render.h"
#include "probegi/tracer.h"

namespace probegi {

/// The third axis of the pipeline: where passes run.
enum class BackendKind : std::uint8_t {
    cpu,     ///< threads and SIMD; triangles by Embree
    vulkan,  ///< Vulkan compute; triangles by the library's BVH or by ray query
};

/// Draws pictures. Move-only by its pointer; one picture at a time.
class PROBEGI_API PictureRenderer {
public:
    virtual ~PictureRenderer() = default;
    /// As renderPicture(). The tracer and the field (null: no indirect light) must be of the renderer's backend.
    virtual Result<RenderedPicture> render(const Tracer& tracer, const Lighting& lighting, const Field* field,
                                           const PictureDesc& desc) = 0;
};

/// All that a program needs of the place where passes run, so that it need not know which one that is. What a backend
/// makes may outlive it. Thread-safe as far as its parts are: those on one Vulkan device take calls one at a time.
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
    /// Errors: as Field::create; unsupported (more probes than the device's images hold).
    virtual Result<Field> makeField(const FieldDesc& desc, const FieldSettings& settings = {}) const = 0;
    /// Errors: outOfMemory.
    virtual Result<std::unique_ptr<PictureRenderer>> makeRenderer() const = 0;
};

/// Which backend, and what only some of them have.
struct BackendDesc {
    BackendKind kind = BackendKind::cpu;
    /// vulkan: an index or part of a name from vulkan::listDevices(); empty: the first usable device, discrete GPUs
    /// before others.
    std::string device{};
    TracerKind tracer = TracerKind::automatic;  ///< vulkan
    std::filesystem::path cacheFolder{};        ///< vulkan: for compiled pipelines; empty: they are compiled every run
};

/// The CPU's, or that of a Vulkan device which is opened for it; vulkan::makeBackend() takes a device that is open.
/// Errors: unsupported (built without Vulkan, no such device, what it lacks), outOfMemory.
PROBEGI_API Result<std::unique_ptr<Backend>> openBackend(const Context& context, const BackendDesc& desc = {});

}  // namespace probegi

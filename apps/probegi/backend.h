#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "probegi/field.h"
#include "probegi/render.h"
#include "probegi/tracer.h"

namespace probegi::tool {

enum class BackendKind : std::uint8_t { cpu, vulkan };
enum class GpuTracer : std::uint8_t { automatic, bvh, rayQuery };

/// --backend, --device, --tracer and --shader-cache.
struct BackendOptions {
    BackendKind kind = BackendKind::cpu;
    std::string device;  ///< index or part of a name; empty: the library chooses
    GpuTracer tracer = GpuTracer::automatic;
    std::string shaderCache;  ///< folder; empty: the user's cache folder
};

void addBackendOptions(CLI::App& command, BackendOptions& options);

/// What no device can make right, found before the work begins: throws CLI::ValidationError where an option of the
/// Vulkan backend was given to the other one.
void checkBackendOptions(const CLI::App& command, const BackendOptions& options);

/// Where a command's passes run: the same three things on each backend.
class Backend {
public:
    virtual ~Backend() = default;
    virtual BackendKind kind() const noexcept = 0;
    virtual Result<std::unique_ptr<Tracer>> makeTracer(const Scene& scene, const ScenePose& pose) const = 0;
    virtual Result<Field> makeField(const FieldDesc& desc, const FieldSettings& settings) const = 0;
    virtual Result<RenderedPicture> render(const Tracer& tracer, const Lighting& lighting, const Field* field,
                                           const PictureDesc& desc) const = 0;
};

/// Errors: unsupported (no such device, what it lacks, or a program that was built without Vulkan).
Result<std::unique_ptr<Backend>> openBackend(const Context& context, const BackendOptions& options);

/// The shader cache that was asked for, else probegi in the user's cache folder; empty where the user has none.
std::filesystem::path shaderCacheFolder(const BackendOptions& options);

}  // namespace probegi::tool

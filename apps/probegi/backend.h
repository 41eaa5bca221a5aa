#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>

#include "probegi/backend.h"

namespace probegi::tool {

/// --backend, --device, --tracer and --shader-cache.
struct BackendOptions {
    BackendKind kind = BackendKind::cpu;
    std::string device;  ///< index or part of a name; empty: the library chooses
    TracerKind tracer = TracerKind::automatic;
    std::string shaderCache;  ///< folder; empty: the user's cache folder
};

void addBackendOptions(CLI::App& command, BackendOptions& options);

/// Throws CLI::ValidationError if an option of the Vulkan backend was given to the CPU backend. Called before any work
/// begins.
void checkBackendOptions(const CLI::App& command, const BackendOptions& options);

/// Errors: unsupported (no such device, a missing feature, or a program built without Vulkan).
Result<std::unique_ptr<Backend>> openBackend(const Context& context, const BackendOptions& options);

/// The folder of --shader-cache, or else probegi in the user's cache folder; empty if the user has none.
std::filesystem::path shaderCacheFolder(const BackendOptions& options);

}  // namespace probegi::tool

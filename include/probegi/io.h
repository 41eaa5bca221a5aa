#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "probegi/export.h"
#include "probegi/scene.h"

namespace probegi {

/// A scene read from a file, and warnings for what is not supported.
struct LoadedScene {
    Scene scene;                                 ///< has passed validate()
    std::vector<std::string> warnings;           ///< one sentence each, e.g. an ignored optional extension
    std::vector<std::filesystem::path> files{};  ///< every file read: the scene, its settings, all that it references
};

/// Reads glTF 2.0 (.gltf with its files beside it, or .glb). If an .ini file of the same stem, in the format of
/// NVIDIA's RTXGI test harness, lies beside it, its lights, cameras, sky and probe grids are added.
/// A scene so far from the origin that single-precision coordinates are too coarse is moved to the origin
/// (Scene::origin).
/// Errors: fileNotFound, fileUnreadable, malformed, unsupported (a required extension, named), outOfMemory.
PROBEGI_API Result<LoadedScene> loadScene(const std::filesystem::path& path, const ReadLimits& limits = {});

/// Writes a file atomically: it appears whole or not at all. Symbolic links are followed, not replaced. Devices, pipes
/// and streams of this process (/dev/null, /dev/stdout) are written to directly. Errors: writeFailed.
PROBEGI_API Result<void> writeFile(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);

/// Checks whether writeFile() could write there, without leaving a trace; for use before long work. Errors:
/// writeFailed.
PROBEGI_API Result<void> checkWritable(const std::filesystem::path& path);

}  // namespace probegi

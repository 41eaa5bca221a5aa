#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "probegi/export.h"
#include "probegi/scene.h"

namespace probegi {

/// A scene from a file, and what the reader could not honour.
struct LoadedScene {
    Scene scene;                                 ///< has passed validate()
    std::vector<std::string> warnings;           ///< one sentence each, e.g. an optional extension that was ignored
    std::vector<std::filesystem::path> files{};  ///< all that were read: the scene, its settings, what it refers to
};

/// Reads glTF 2.0 (.gltf with its files beside it, or .glb). Where a file of the same stem with the ending .ini lies
/// beside it in the form of NVIDIA's RTXGI test harness, its lights, cameras, sky and probe grid are added.
/// A scene that lies far from the origin, where single-precision coordinates are too coarse for light, is moved there
/// (Scene::origin).
/// Errors: fileNotFound, fileUnreadable, malformed, unsupported (a required extension, named), outOfMemory.
PROBEGI_API Result<LoadedScene> loadScene(const std::filesystem::path& path, const ReadLimits& limits = {});

/// Makes a file of these bytes, which appears whole or not at all. A symbolic link stays a link: what it points to is
/// written. What is no file but a device, a pipe or a stream of this process (/dev/null, /dev/stdout) is written to as
/// it is. Errors: writeFailed.
PROBEGI_API Result<void> writeFile(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);

/// Whether writeFile() could write there, found without a trace: to be asked before long work. Errors: writeFailed.
PROBEGI_API Result<void> checkWritable(const std::filesystem::path& path);

}  // namespace probegi

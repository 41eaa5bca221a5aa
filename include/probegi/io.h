#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "probegi/export.h"
#include "probegi/scene.h"

namespace probegi {

/// A scene from a file, and what the reader could not honour.
struct LoadedScene {
    Scene scene;                        ///< has passed validate()
    std::vector<std::string> warnings;  ///< one sentence each, e.g. an optional extension that was ignored
};

/// Reads glTF 2.0 (.gltf with its files beside it, or .glb). Where a file of the same stem with the ending .ini lies
/// beside it in the form of NVIDIA's RTXGI test harness, its lights, cameras, sky and probe grid are added.
/// Errors: fileNotFound, fileUnreadable, malformed, unsupported (a required extension, named), outOfMemory.
PROBEGI_API Result<LoadedScene> loadScene(const std::filesystem::path& path);

}  // namespace probegi

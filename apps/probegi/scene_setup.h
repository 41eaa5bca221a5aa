#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "console/terminal.h"
#include "probegi/builtin_scenes.h"
#include "probegi/field.h"
#include "probegi/io.h"
#include "probegi/tracer.h"

namespace probegi::tool {

/// SCENE and everything on the command line that overrides what the scene says. Texts have passed their parser.
struct SceneOptions {
    std::string scene;      ///< a path, or builtin:NAME
    BuiltinParams builtin;  ///< --wall, --albedo, --emission, --power, --radius
    float timeOfScene = 0;  ///< seconds into the animations
    int threads = 0;        ///< for makeContext

    std::string camera;  ///< name or index; empty: the scene's first, else an overview
    std::string lookFrom, lookAt;
    std::optional<float> fovDegrees;  ///< vertical

    std::vector<std::string> suns, points;  ///< where given, they replace the scene's lights of their kind
    std::string sky;                        ///< R,G,B or a file

    std::string volume, probes;      ///< --volume, --probes
    std::string exposure = "scene";  ///< --exposure
    ReadLimits limits;               ///< --unpack-limit
};

/// Adds SCENE, all overrides and --threads to a command.
void addSceneOptions(CLI::App& command, SceneOptions& options);

/// Adds only SCENE, the built-in scenes' parameters and --time-of-scene.
void addSceneArgument(CLI::App& command, SceneOptions& options);

/// A scene ready to be traced: what the file says with the overrides applied.
struct LoadedSetup {
    std::unique_ptr<Scene> scene;  ///< at an address that stays, for the tracer
    ScenePose pose;
    Lighting lighting;  ///< lights of no intensity are left out
    PlacedCamera camera;
    VolumeDesc grid;
    float exposure = 1.0f;              ///< that was asked for, or what the scene suggests
    bool automaticExposure = false;     ///< of what is shown: from the picture
    std::vector<std::string> warnings;  ///< of the reader, and of a grid that leaves surfaces out; one sentence each
    std::vector<std::filesystem::path> files;  ///< all that were read
};

/// Loads or makes the scene, and nothing else.
Result<LoadedScene> readScene(const SceneOptions& options);

/// The grid where neither the scene nor the command line has one: over the scene, with an eye to its walls.
Result<VolumeDesc> automaticGrid(const Scene& scene, const ScenePose& pose, const PlacementDesc& placement = {},
                                 int threads = 0);

/// The exposure at which a picture is shown: the setup's, or one that follows from the picture.
float shownExposure(const LoadedSetup& setup, const HdrImage& color);

/// Whether anything shines: a punctual light, a sky that is not black, an emissive triangle.
bool hasLight(const Scene& scene, const ScenePose& pose, const Lighting& lighting);

/// readScene, then the overrides. Warnings are also printed. A scene without any light is an error, for a picture of
/// it would be black.
Result<LoadedSetup> loadSetup(const SceneOptions& options);

}  // namespace probegi::tool

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
#include "probegi/sdf.h"
#include "probegi/tracer.h"
#include "volume_options.h"

namespace probegi::tool {

/// SCENE and all options that override parts of it. The strings have passed their parsers.
struct SceneOptions {
    std::string scene;      ///< a path, or builtin:NAME
    BuiltinParams builtin;  ///< --wall, --albedo, --emission, --power, --radius
    float timeOfScene = 0;  ///< seconds into the animations
    int threads = 0;        ///< for makeContext

    std::string camera;  ///< name or index; empty: the scene's first, else an overview
    std::string lookFrom, lookAt;
    std::optional<float> fovDegrees;  ///< vertical

    std::vector<std::string> suns, points;  ///< if any, they replace the scene's lights of that type
    std::string sky;                        ///< R,G,B or a file

    std::string volume, probes;      ///< --volume, --probes
    bool turnGrid = true;            ///< --turn-grid: of a grid that is laid over the scene
    VolumeOptions volumes;           ///< --cascades, --outside
    std::vector<VolumeDesc> given;   ///< volumes of a field that was read, in place of all others; empty: none
    std::string exposure = "scene";  ///< --exposure
    std::string sdf;                 ///< --sdf; empty: none
    bool probesHitMesh = false;      ///< --probe-rays mesh, whatever --sdf is
    ReadLimits limits;               ///< --unpack-limit
};

/// Adds SCENE, all overriding options and --threads to a command.
void addSceneOptions(CLI::App& command, SceneOptions& options);

/// Adds only SCENE, the built-in scenes' parameters and --time-of-scene.
void addSceneArgument(CLI::App& command, SceneOptions& options);

/// Adds --threads.
void addThreadsOption(CLI::App& command, SceneOptions& options);

/// A scene ready to be traced, with the overriding options applied.
struct LoadedSetup {
    std::unique_ptr<Scene> scene;  ///< at a fixed address, which the tracer keeps
    ScenePose pose;
    Lighting lighting;  ///< without lights of zero intensity
    PlacedCamera camera;
    std::vector<VolumeDesc> volumes;    ///< of the field, at least one
    FieldSettings settings;             ///< for it: what the options say
    VolumeDesc grid;                    ///< the first of the volumes
    std::optional<SdfScene> sdf;        ///< --sdf
    bool probesHitSdf = false;          ///< probe rays hit that instead of the triangles
    float exposure = 1.0f;              ///< as requested, or as the scene suggests
    bool automaticExposure = false;     ///< choose it for the picture
    std::vector<std::string> warnings;  ///< by the reader, and about surfaces outside the grid; one sentence each
    std::vector<std::filesystem::path> files;  ///< all files that were read
};

/// Loads or builds the scene without applying options.
Result<LoadedScene> readScene(const SceneOptions& options);

/// The grid used if neither the scene nor the command line has one: over the scene, placed by its walls.
Result<VolumeDesc> automaticGrid(const Scene& scene, const ScenePose& pose, const PlacementDesc& placement = {},
                                 int threads = 0);

/// Probes of all volumes.
int probeCount(const LoadedSetup& setup);
/// Sentences where the scene or the camera is outside the grid.
std::vector<std::string> gridWarnings(const LoadedSetup& setup, const Bounds& scene);

/// The exposure to show a picture at: the setup's, or one chosen for the picture.
float shownExposure(const LoadedSetup& setup, const HdrImage& color);

/// Whether there is any light: a punctual light, a sky that is not black, an emissive triangle.
bool hasLight(const Scene& scene, const ScenePose& pose, const Lighting& lighting);

/// readScene(), then applies the options. Warnings are also printed. A scene without any light is an error, since its
/// picture would be black.
Result<LoadedSetup> loadSetup(const SceneOptions& options);

/// Takes pose, lights and camera to another moment of the scene's animations, seconds; sky and grid stay.
/// Errors: invalidArgument (the camera looks at its own place).
Result<void> moveSetup(LoadedSetup& setup, const SceneOptions& options, float seconds);

}  // namespace probegi::tool

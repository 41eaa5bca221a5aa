#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "probegi/backend.h"
#include "scene_setup.h"

namespace probegi::tool {

/// Adds --sdf.
void addSdfOption(CLI::App& command, SceneOptions& options);

/// Reads and writes primitives in the coordinates of the scene's file (Scene::origin). Errors: as loadSdf(), saveSdf().
Result<SdfScene> loadSdfOf(const Scene& scene, const std::filesystem::path& path, const ReadLimits& limits);
Result<void> saveSdfOf(const Scene& scene, const std::filesystem::path& path, SdfScene sdf);

/// Reads the file of --sdf into the setup, in the coordinates of its scene. Warns where it has no primitives. Nothing
/// without the option. Errors: those of loadSdf.
Result<void> readSdf(LoadedSetup& setup, const SceneOptions& options);

/// What probe rays hit with --sdf, instead of the triangles that pictures show; null without. `pose`: the setup's, or
/// one with more. Errors: those of Backend::openSdf.
Result<std::unique_ptr<MovableTracer>> openProbeTracer(const Backend& backend, const LoadedSetup& setup,
                                                       const ScenePose& pose);

/// Gives settings with LeakGuard::sdfShadow the primitives of --sdf, which must be there, in this pose; others stay.
/// Errors: those of placeSdf.
Result<void> placeGuard(FieldSettings& settings, const LoadedSetup& setup, const ScenePose& pose);

/// Geometry of the primitives that a GPU's rays read, bytes.
std::size_t sdfBytes(const SdfScene& sdf);

}  // namespace probegi::tool

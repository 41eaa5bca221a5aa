#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "probegi/field.h"
#include "probegi/scene.h"

namespace probegi::tool {

/// Cascades in place of a grid over the scene, and what light is where no volume is.
struct VolumeOptions {
    int cascades = 0;          ///< --cascades; 0: a grid
    float cascadeSpacing = 0;  ///< --cascade-spacing, metres, of the finest; 0: the coarsest covers the scene
    std::string cascadeProbes = "24x12x24";  ///< --cascade-probes
    std::string outside = "nearest";         ///< --outside
};

/// Adds them; cascades exclude the other ways to place probes.
void addVolumeOptions(CLI::App& command, VolumeOptions& options, const std::vector<CLI::Option*>& otherPlacements);

/// The nested volumes around a camera. Errors: those of makeCascades().
Result<std::vector<VolumeDesc>> cascadesAround(const VolumeOptions& options, glm::vec3 camera, const Bounds& scene);

/// What of a field's settings these options decide; `volumes` answer around `camera` where they track it.
FieldSettings fieldSettings(const VolumeOptions& options, const std::vector<VolumeDesc>& volumes, glm::vec3 camera);

}  // namespace probegi::tool

#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "io/budget.h"
#include "io/tinygltf.h"
#include "probegi/io.h"
#include "scene/checks.h"

namespace probegi::io {

/// State of an import: the source and the results so far. Each importX() below fills its part of the scene.
struct Import {
    const tinygltf::Model& model;
    LoadedScene& out;
    Budget geometry;
    Budget pixels;
    std::vector<int> lights;          ///< model light -> scene light, -1: dropped
    std::vector<int> cameras;         ///< model camera -> scene camera, -1: dropped
    std::vector<bool> placedCameras;  ///< model camera -> whether a node has it
    std::vector<int> nodes;           ///< model node -> scene node, -1: not in the scene shown
    std::vector<int> meshes;          ///< model mesh -> scene mesh, -1: not used by those nodes

    Scene& scene() { return out.scene; }

    /// Adds a warning, once however often it occurs, up to a maximum number.
    void warn(std::string sentence) {
        constexpr std::size_t kMost = 50;
        auto& all = out.warnings;
        if (all.size() > kMost || std::find(all.begin(), all.end(), sentence) != all.end()) return;
        all.push_back(all.size() == kMost ? "there are more warnings" : std::move(sentence));
    }
};

void importMaterials(Import& import);
void importLights(Import& import);
void importCameras(Import& import);
void importNodes(Import& import);       ///< needs lights and cameras; numbers the meshes in use
void importMeshes(Import& import);      ///< needs nodes and materials
void importAnimations(Import& import);  ///< needs nodes

using checks::title;  ///< "mesh 3 'column'"

/// Checks that an index from the file is valid. Returns it as an offset.
inline std::size_t checkedIndex(std::string_view user, std::string_view kind, int index, std::size_t count) {
    if (index < 0 || std::size_t(index) >= count) {
        refuseMalformed("{} uses {} {}, but there are {}", user, kind, index, count);
    }
    return std::size_t(index);
}

/// A number from the file as a finite float.
float finiteFloat(std::string_view user, std::string_view member, double value);

/// An extension of an object, or null.
const tinygltf::Value* findExtension(const tinygltf::ExtensionMap& extensions, const char* name);

/// A number in an extension; `fallback` if it is missing.
double numberOf(const tinygltf::Value& object, const char* member, double fallback);

/// An element of an array in an extension; `fallback` if it is missing.
double numberOf(const tinygltf::Value& object, const char* member, int element, double fallback);

}  // namespace probegi::io

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

/// One import under way: what is read, and what has been made of it. Each importX() below fills its part of the scene.
struct Import {
    const tinygltf::Model& model;
    LoadedScene& out;
    Budget geometry;
    Budget pixels;
    std::vector<int> lights;          ///< model light -> scene light, -1: dropped
    std::vector<int> cameras;         ///< model camera -> scene camera, -1: dropped
    std::vector<bool> placedCameras;  ///< model camera -> whether a node has it
    std::vector<int> nodes;           ///< model node -> scene node, -1: not in the scene that is shown
    std::vector<int> meshes;          ///< model mesh -> scene mesh, -1: not used by those nodes

    Scene& scene() { return out.scene; }

    /// Says a thing once, however often it occurs, and stops before nobody reads on.
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
void importNodes(Import& import);       ///< needs lights and cameras; numbers the meshes that are used
void importMeshes(Import& import);      ///< needs nodes and materials
void importAnimations(Import& import);  ///< needs nodes

using checks::title;  ///< "mesh 3 'column'"

/// An index of the file that must exist. Returns it as an offset.
inline std::size_t checkedIndex(std::string_view user, std::string_view kind, int index, std::size_t count) {
    if (index < 0 || std::size_t(index) >= count) {
        refuseMalformed("{} uses {} {}, but there are {}", user, kind, index, count);
    }
    return std::size_t(index);
}

/// A number of the file as a float that is finite.
float finiteFloat(std::string_view user, std::string_view member, double value);

/// An extension of an object, or null.
const tinygltf::Value* findExtension(const tinygltf::ExtensionMap& extensions, const char* name);

/// A number in an extension; `fallback` where it is missing.
double numberOf(const tinygltf::Value& object, const char* member, double fallback);

/// Numbers of an array in an extension; fallback where it is missing or shorter.
double numberOf(const tinygltf::Value& object, const char* member, int element, double fallback);

}  // namespace probegi::io

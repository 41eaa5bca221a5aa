#include "io/gltf_import.h"

#include <cmath>

#include "io/gltf.h"
#include "io/gltf_parse.h"

namespace probegi::io {

float finiteFloat(std::string_view user, std::string_view member, double value) {
    const auto narrow = float(value);
    if (!std::isfinite(narrow)) refuseMalformed("{}: {} {} is not a finite number", user, member, value);
    return narrow;
}

const tinygltf::Value* findExtension(const tinygltf::ExtensionMap& extensions, const char* name) {
    const auto found = extensions.find(name);
    return found != extensions.end() && found->second.IsObject() ? &found->second : nullptr;
}

double numberOf(const tinygltf::Value& object, const char* member, double fallback) {
    const tinygltf::Value& value = object.Get(std::string(member));
    return value.IsNumber() ? value.GetNumberAsDouble() : fallback;
}

double numberOf(const tinygltf::Value& object, const char* member, int element, double fallback) {
    const tinygltf::Value& array = object.Get(std::string(member));
    if (!array.IsArray() || std::size_t(element) >= array.ArrayLen()) return fallback;
    const tinygltf::Value& value = array.Get(element);
    return value.IsNumber() ? value.GetNumberAsDouble() : fallback;
}

LoadedScene importGltf(std::span<const std::uint8_t> bytes, const std::filesystem::path& folder,
                       const ReadLimits& limits) {
    LoadedScene out;
    const tinygltf::Model model = parseGltf(bytes, folder, limits, out);
    std::size_t size = bytes.size();
    for (const tinygltf::Buffer& buffer : model.buffers) size += buffer.data.size();
    for (const tinygltf::Image& image : model.images) size += image.image.size();
    Import import{model, out, Budget(limits, size, kGeometryShare), Budget(limits, size), {}, {}, {}, {}, {}};
    importMaterials(import);
    importLights(import);
    importCameras(import);
    importNodes(import);
    importMeshes(import);
    importAnimations(import);
    return out;
}

Result<LoadedScene> loadGltfFromMemory(std::string_view name, std::span<const std::uint8_t> bytes,
                                       const std::filesystem::path& folder, const ReadLimits& limits) {
    return guarded(name, [&] {
        LoadedScene loaded = importGltf(bytes, folder, limits);
        if (const auto valid = validate(loaded.scene); !valid) throw Refused{valid.error()};
        return loaded;
    });
}

}  // namespace probegi::io

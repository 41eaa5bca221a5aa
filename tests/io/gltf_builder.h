#pragma once

#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

namespace probegi::test {

using Bytes = std::vector<std::uint8_t>;

// glTF's codes of component types.
constexpr int kByte = 5120, kUnsignedByte = 5121, kShort = 5122, kUnsignedShort = 5123, kUnsignedInt = 5125,
              kFloat = 5126;

/// Builds glTF files in memory: adds binary data, and leaves the JSON open to any edit.
class GltfBuilder {
public:
    GltfBuilder();

    /// A buffer view of these bytes; returns its index.
    int addView(std::span<const std::uint8_t> bytes, int stride = 0);
    int addAccessor(int view, int componentType, std::size_t count, const char* type, bool normalized = false);
    /// A buffer view and an accessor for packed values; returns the accessor's index.
    template <class T>
    int add(const std::vector<T>& values, int componentType, const char* type, bool normalized = false) {
        const auto* first = reinterpret_cast<const std::uint8_t*>(values.data());
        const int view = addView({first, values.size() * sizeof(T)});
        return addAccessor(view, componentType, values.size() / componentsOf(type), type, normalized);
    }
    int addFloats(const std::vector<float>& values, const char* type) { return add(values, kFloat, type); }

    /// Appends to an array of the root object and returns the index.
    int append(const char* array, nlohmann::json value);
    /// Adds a mesh of one primitive and a root node with it; returns the mesh's index.
    int show(nlohmann::json primitive);
    /// {"POSITION": accessor} for a triangle in the plane z = 0 with corners (0,0), (1,0), (0,1).
    nlohmann::json triangle();

    Bytes glb() const;
    Bytes text() const;  ///< .gltf with the binary data as a data URI

    nlohmann::json json;
    Bytes binary;

private:
    static std::size_t componentsOf(const std::string& type);
};

/// data:MIME;base64,...
std::string dataUri(const char* mime, std::span<const std::uint8_t> bytes);

/// A PNG of the given size, each pixel its own colour.
Bytes smallPng(int width, int height);

/// A file that uses every feature the reader supports.
GltfBuilder richScene();

}  // namespace probegi::test

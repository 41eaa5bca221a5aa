#include "io/gltf_draco.h"

#include <draco/compression/decode.h>

#include <limits>

#include "io/gltf_accessor.h"
#include "io/refused.h"

namespace probegi::io {

namespace {

std::unique_ptr<draco::Mesh> decompress(std::span<const std::uint8_t> bytes) {
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    draco::Decoder decoder;
    auto result = decoder.DecodeMeshFromBuffer(&buffer);
    if (!result.ok()) refuseMalformed("its Draco data is damaged ({})", result.status().error_msg_string());
    return std::move(result).value();
}

/// Draco keeps integers unscaled; the glTF accessor says whether they are normalised.
float scaleOf(const tinygltf::Model& model, const tinygltf::Primitive& primitive, const std::string& name,
              const draco::PointAttribute& attribute) {
    const auto found = primitive.attributes.find(name);
    if (found == primitive.attributes.end()) return 1.0f;
    const AccessorView view(model, found->second);
    if (!view.normalized() || attribute.normalized()) return 1.0f;
    switch (view.componentType()) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return 1.0f / 127.0f;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return 1.0f / 255.0f;
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return 1.0f / 32767.0f;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return 1.0f / 65535.0f;
        default:
            return 1.0f;
    }
}

DracoAttribute unpack(const draco::Mesh& mesh, const draco::PointAttribute& attribute, float scale) {
    constexpr int kMaxComponents = 4;
    DracoAttribute out;
    out.components = std::min<int>(attribute.num_components(), kMaxComponents);
    if (out.components < 1) refuseMalformed("a Draco attribute has no components");
    out.values.reserve(std::size_t(mesh.num_points()) * std::size_t(out.components));
    for (draco::PointIndex point(0); point < mesh.num_points(); ++point) {
        float value[kMaxComponents] = {};
        const draco::AttributeValueIndex at = attribute.mapped_index(point);
        if (at.value() >= attribute.size() || !attribute.ConvertValue<float>(at, std::int8_t(out.components), value)) {
            refuseMalformed("a Draco attribute is damaged at vertex {}", point.value());
        }
        for (int c = 0; c < out.components; ++c) out.values.push_back(value[c] * scale);
    }
    return out;
}

std::vector<std::uint32_t> indicesOf(const draco::Mesh& mesh) {
    std::vector<std::uint32_t> indices;
    indices.reserve(3 * std::size_t(mesh.num_faces()));
    for (draco::FaceIndex face(0); face < mesh.num_faces(); ++face) {
        for (int corner = 0; corner < 3; ++corner) indices.push_back(mesh.face(face)[std::size_t(corner)].value());
    }
    return indices;
}

}  // namespace

DracoPrimitive decodeDraco(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                           const tinygltf::Value& extension) {
    const tinygltf::Value& view = extension.Get("bufferView");
    const tinygltf::Value& attributes = extension.Get("attributes");
    if (!view.IsInt() || !attributes.IsObject())
        refuseMalformed("its Draco extension lacks a buffer view or attributes");
    const auto mesh = decompress(bytesOfView(model, view.Get<int>()));
    DracoPrimitive out;
    for (const std::string& name : attributes.Keys()) {
        const tinygltf::Value& id = attributes.Get(name);
        const draco::PointAttribute* attribute =
            id.IsInt() && id.Get<int>() >= 0 ? mesh->GetAttributeByUniqueId(std::uint32_t(id.Get<int>())) : nullptr;
        if (!attribute) refuseMalformed("its Draco data has no attribute {}", name);
        out.attributes.emplace(name, unpack(*mesh, *attribute, scaleOf(model, primitive, name, *attribute)));
    }
    out.indices = indicesOf(*mesh);
    return out;
}

}  // namespace probegi::io

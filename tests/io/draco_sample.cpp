#include "draco_sample.h"

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>

#include <array>
#include <cmath>

namespace probegi::test {

namespace {

using Vertex = std::array<float, 3>;

Vertex positionAt(int x, int y) {
    return {float(x), float(y), std::sin(float(x)) * 0.25f};
}

std::unique_ptr<draco::Mesh> makeMesh(int size, std::array<int, 3>& attributes) {
    draco::TriangleSoupMeshBuilder builder;
    builder.Start(2 * size * size);
    attributes = {builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32),
                  builder.AddAttribute(draco::GeometryAttribute::NORMAL, 3, draco::DT_FLOAT32),
                  builder.AddAttribute(draco::GeometryAttribute::TEX_COORD, 2, draco::DT_FLOAT32)};
    const Vertex normal{0, 0, 1};
    int face = 0;
    const auto add = [&](std::array<std::array<int, 2>, 3> corners) {
        std::array<Vertex, 3> p;
        std::array<std::array<float, 2>, 3> uv;
        for (std::size_t c = 0; c < 3; ++c) {
            p[c] = positionAt(corners[c][0], corners[c][1]);
            uv[c] = {float(corners[c][0]) / float(size), float(corners[c][1]) / float(size)};
        }
        const draco::FaceIndex f(std::uint32_t(face++));
        builder.SetAttributeValuesForFace(attributes[0], f, p[0].data(), p[1].data(), p[2].data());
        builder.SetAttributeValuesForFace(attributes[1], f, normal.data(), normal.data(), normal.data());
        builder.SetAttributeValuesForFace(attributes[2], f, uv[0].data(), uv[1].data(), uv[2].data());
    };
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            add({{{x, y}, {x + 1, y}, {x, y + 1}}});
            add({{{x + 1, y}, {x + 1, y + 1}, {x, y + 1}}});
        }
    }
    return builder.Finalize();
}

}  // namespace

GltfBuilder dracoScene(int size) {
    std::array<int, 3> ids{};
    const auto mesh = makeMesh(size, ids);
    draco::Encoder encoder;
    encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, 14);
    encoder.SetAttributeQuantization(draco::GeometryAttribute::NORMAL, 10);
    encoder.SetAttributeQuantization(draco::GeometryAttribute::TEX_COORD, 12);
    draco::EncoderBuffer buffer;
    if (!mesh || !encoder.EncodeMeshToBuffer(*mesh, &buffer).ok()) return {};

    GltfBuilder b;
    const auto* data = reinterpret_cast<const std::uint8_t*>(buffer.data());
    const int view = b.addView({data, buffer.size()});
    const auto accessor = [&](int componentType, const char* type, std::size_t count) {
        return b.append("accessors", {{"componentType", componentType}, {"type", type}, {"count", count}});
    };
    const std::size_t points = mesh->num_points();
    const nlohmann::json attributes = {{"POSITION", accessor(kFloat, "VEC3", points)},
                                       {"NORMAL", accessor(kFloat, "VEC3", points)},
                                       {"TEXCOORD_0", accessor(kFloat, "VEC2", points)}};
    const nlohmann::json compressed = {{"POSITION", mesh->attribute(ids[0])->unique_id()},
                                       {"NORMAL", mesh->attribute(ids[1])->unique_id()},
                                       {"TEXCOORD_0", mesh->attribute(ids[2])->unique_id()}};
    b.show({{"attributes", attributes},
            {"indices", accessor(kUnsignedInt, "SCALAR", 3 * std::size_t(mesh->num_faces()))},
            {"extensions", {{"KHR_draco_mesh_compression", {{"bufferView", view}, {"attributes", compressed}}}}}});
    b.json["extensionsUsed"] = {"KHR_draco_mesh_compression"};
    b.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    return b;
}

}  // namespace probegi::test

#include <glm/geometric.hpp>

#include "reading.h"

namespace probegi::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::vector<float> kSquare{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};

Primitive readPrimitive(GltfBuilder& b, nlohmann::json primitive) {
    b.show(std::move(primitive));
    return onlyPrimitive(readClean(b));
}

TEST(GltfMesh, ReadsEveryIndexType) {
    for (const int type : {kUnsignedByte, kUnsignedShort, kUnsignedInt}) {
        GltfBuilder b;
        const int position = b.addFloats(kSquare, "VEC3");
        int indices = 0;
        if (type == kUnsignedByte) indices = b.add(std::vector<std::uint8_t>{2, 1, 3}, type, "SCALAR");
        if (type == kUnsignedShort) indices = b.add(std::vector<std::uint16_t>{2, 1, 3}, type, "SCALAR");
        if (type == kUnsignedInt) indices = b.add(std::vector<std::uint32_t>{2, 1, 3}, type, "SCALAR");
        b.append("materials", nlohmann::json::object());
        const Primitive p =
            readPrimitive(b, {{"attributes", {{"POSITION", position}}}, {"indices", indices}, {"material", 0}});
        ASSERT_EQ(p.positions.size(), 3u) << "the vertex that no index names is left out";
        EXPECT_THAT(p.indices, ElementsAre(1, 0, 2));
        EXPECT_EQ(p.positions[2], glm::vec3(1, 1, 0));
    }
}

TEST(GltfMesh, WithoutIndicesTakesVerticesInOrder) {
    GltfBuilder b;
    const Primitive p = readPrimitive(b, {{"attributes", b.triangle()}});
    EXPECT_THAT(p.indices, ElementsAre(0, 1, 2));
}

TEST(GltfMesh, StripsAndFansKeepTheirFront) {
    for (const int mode : {5, 6}) {
        GltfBuilder b;
        // A strip zigzags, a fan turns around its first vertex; both cover the unit square, facing +Z.
        const std::vector<float> fan{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
        const int position = b.addFloats(mode == 5 ? kSquare : fan, "VEC3");
        const Primitive p = readPrimitive(b, {{"attributes", {{"POSITION", position}}}, {"mode", mode}});
        ASSERT_EQ(p.indices.size(), 6u);
        float area = 0;
        for (std::size_t i = 0; i < 6; i += 3) {
            const glm::vec3 a = p.positions[p.indices[i]];
            const glm::vec3 normal = cross(p.positions[p.indices[i + 1]] - a, p.positions[p.indices[i + 2]] - a);
            EXPECT_GT(normal.z, 0) << "mode " << mode;
            area += 0.5f * normal.z;
        }
        EXPECT_FLOAT_EQ(area, 1.0f);
    }
}

TEST(GltfMesh, ReadsInterleavedVertices) {
    GltfBuilder b;
    const std::vector<float> mixed{0, 0, 0, 0.5f, 0.25f, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
    const int view = b.addView({reinterpret_cast<const std::uint8_t*>(mixed.data()), mixed.size() * 4}, 20);
    const int position = b.addAccessor(view, kFloat, 3, "VEC3");
    const int uv = b.addAccessor(view, kFloat, 3, "VEC2");
    b.json["accessors"][uv]["byteOffset"] = 12;
    const Primitive p = readPrimitive(b, {{"attributes", {{"POSITION", position}, {"TEXCOORD_0", uv}}}});
    ASSERT_EQ(p.uv0.size(), 3u);
    EXPECT_EQ(p.uv0[0], glm::vec2(0.5f, 0.25f));
    EXPECT_EQ(p.uv0[2], glm::vec2(0, 1));
    EXPECT_EQ(p.positions[1], glm::vec3(1, 0, 0));
}

TEST(GltfMesh, ReadsQuantisedAttributes) {
    GltfBuilder b;
    // Positions as plain shorts, normals as normalised bytes, padded to 4 bytes as glTF requires.
    const std::vector<std::int16_t> positions{0, 0, 0, 0, 300, 0, 0, 0, 0, -200, 0, 0};
    const std::vector<std::int8_t> normals{0, 0, 127, 0, 0, -128, 0, 0, 0, 0, 127, 0};
    const auto bytes = [](const auto& v) {
        return std::span(reinterpret_cast<const std::uint8_t*>(v.data()), v.size() * sizeof(v[0]));
    };
    const int position = b.addAccessor(b.addView(bytes(positions), 8), kShort, 3, "VEC3");
    const int normal = b.addAccessor(b.addView(bytes(normals), 4), kByte, 3, "VEC3", true);
    b.json["extensionsUsed"] = {"KHR_mesh_quantization"};
    b.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    const Primitive p = readPrimitive(b, {{"attributes", {{"POSITION", position}, {"NORMAL", normal}}}});
    EXPECT_EQ(p.positions[1], glm::vec3(300, 0, 0));
    EXPECT_EQ(p.positions[2], glm::vec3(0, -200, 0));
    EXPECT_EQ(p.normals[0], glm::vec3(0, 0, 1));
    EXPECT_EQ(p.normals[1], glm::vec3(0, -1, 0));
}

TEST(GltfMesh, ReadsSparseAccessors) {
    for (const bool zeros : {false, true}) {
        GltfBuilder b;
        const int position = b.addFloats({0, 0, 0, 1, 0, 0, 9, 9, 9}, "VEC3");
        const int indices = b.add(std::vector<std::uint16_t>{2}, kUnsignedShort, "SCALAR");
        const int values = b.addFloats({0, 5, 0}, "VEC3");
        auto& accessor = b.json["accessors"][position];
        if (zeros) accessor.erase("bufferView");
        accessor["sparse"] = {{"count", 1},
                              {"indices", {{"bufferView", indices}, {"componentType", kUnsignedShort}}},
                              {"values", {{"bufferView", values}}}};
        const Primitive p = readPrimitive(b, {{"attributes", {{"POSITION", position}}}});
        EXPECT_EQ(p.positions[1], zeros ? glm::vec3(0) : glm::vec3(1, 0, 0));
        EXPECT_EQ(p.positions[2], glm::vec3(0, 5, 0));
    }
}

TEST(GltfMesh, SharedMeshesStayShared) {
    GltfBuilder b;
    const int mesh = b.show({{"attributes", b.triangle()}});
    for (int i = 0; i < 3; ++i) b.json["scenes"][0]["nodes"].push_back(b.append("nodes", {{"mesh", mesh}}));
    const Scene scene = readClean(b);
    EXPECT_EQ(scene.meshes.size(), 1u);
    EXPECT_EQ(scene.nodes.size(), 4u);
    EXPECT_EQ(triangleCount(scene, poseAt(scene)), 4u);
}

TEST(GltfMesh, PrimitivesWithoutMaterialGetTheDefaultOne) {
    GltfBuilder b;
    const Primitive p = readPrimitive(b, {{"attributes", b.triangle()}});
    const Scene scene = readClean(b);
    ASSERT_EQ(p.material, 0);
    ASSERT_EQ(scene.materials.size(), 1u);  // glTF 2.0's default: white, metallic 1, roughness 1
    EXPECT_EQ(scene.materials[0].baseColor, glm::vec4(1));
    EXPECT_EQ(scene.materials[0].metallic, 1.0f);
    EXPECT_EQ(scene.materials[0].roughness, 1.0f);
}

TEST(GltfMesh, RepairsNormalsAndSaysSo) {
    GltfBuilder b;
    auto attributes = b.triangle();
    attributes["NORMAL"] = b.addFloats({0, 3, 0, 0, 0, 0, NAN, 0, 0}, "VEC3");
    attributes["TANGENT"] = b.addFloats(std::vector<float>(12, 0.0f), "VEC4");
    b.show({{"attributes", attributes}});
    const auto loaded = read(b);
    ASSERT_TRUE(loaded) << loaded.error().message;
    const Primitive p = onlyPrimitive(loaded->scene);
    EXPECT_THAT(p.normals, ElementsAre(glm::vec3(0, 1, 0), glm::vec3(0, 0, 1), glm::vec3(0, 0, 1)));
    EXPECT_TRUE(p.tangents.empty()) << "tangents without a direction are derived from the uvs instead";
    EXPECT_THAT(loaded->warnings, ElementsAre(HasSubstr("normals")));
}

TEST(GltfMesh, WarnsOfWhatItLeavesOut) {
    GltfBuilder b;
    b.show({{"attributes", b.triangle()}, {"mode", 0}});
    auto attributes = b.triangle();
    attributes["COLOR_0"] = attributes["POSITION"];
    b.show({{"attributes", attributes}, {"targets", {b.triangle()}}});
    b.show({{"attributes", {{"NORMAL", 0}}}});
    const auto loaded = read(b);
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(triangleCount(loaded->scene, poseAt(loaded->scene)), 1u);
    EXPECT_THAT(loaded->warnings, ElementsAre(HasSubstr("points and lines"), HasSubstr("morph"),
                                              HasSubstr("vertex colours"), HasSubstr("no positions")));
}

TEST(GltfMesh, TextAndBinaryAreTheSame) {
    const GltfBuilder b = richScene();
    const auto binary = read(b.glb());
    const auto text = read(b.text());
    ASSERT_TRUE(binary && text);
    EXPECT_THAT(binary->warnings, testing::IsEmpty());
    const Primitive p = onlyPrimitive(binary->scene);
    const Primitive q = onlyPrimitive(text->scene);
    EXPECT_EQ(p.positions, q.positions);
    EXPECT_EQ(p.uv1, q.uv1);
    EXPECT_EQ(p.uv1[3], glm::vec2(1, 1)) << "normalised shorts";
    EXPECT_EQ(p.tangents[3], glm::vec4(1, 0, 0, -1));
    EXPECT_EQ(p.normals[1], glm::vec3(0, 0, 1)) << "made unit long";
    EXPECT_EQ(binary->scene.images.at(0).rgba, text->scene.images.at(0).rgba);
}

}  // namespace
}  // namespace probegi::test

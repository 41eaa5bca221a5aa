// Deliberately broken files: each must give an error message, never a crash, a hang or a huge allocation.
#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <random>

#include "reading.h"
#include "support/scenes.h"

namespace probegi::test {
namespace {

/// An indexed triangle: accessor 0 positions (view 0), accessor 1 indices (view 1).
GltfBuilder indexed() {
    GltfBuilder b;
    auto attributes = b.triangle();
    const int indices = b.add(std::vector<std::uint16_t>{0, 1, 2}, kUnsignedShort, "SCALAR");
    b.show({{"attributes", attributes}, {"indices", indices}});
    return b;
}

void expectMalformed(const GltfBuilder& b, const std::string& words) {
    expectRefused(b, ErrorCode::malformed, words);
}

TEST(GltfHostile, AccessorsMustFitTheirViews) {
    const auto with = [](int accessor, const char* member, nlohmann::json value) {
        GltfBuilder b = indexed();
        b.json["accessors"][accessor][member] = std::move(value);
        return b;
    };
    expectMalformed(with(0, "count", 4), "do not fit");
    expectMalformed(with(0, "count", 0xffffffffu), "do not fit");
    expectMalformed(with(0, "count", std::uint64_t(1) << 62), "too many");
    expectMalformed(with(0, "count", -1), "count");
    expectMalformed(with(0, "byteOffset", 4), "do not fit");
    expectMalformed(with(0, "byteOffset", std::uint64_t(-1)), "do not fit");
    expectMalformed(with(0, "bufferView", 17), "buffer view 17");
    expectMalformed(with(0, "componentType", 5124), "5124");
    expectMalformed(with(0, "componentType", 5130), "5130");
    expectMalformed(with(0, "type", "MAT4"), "matri");
    expectMalformed(with(0, "type", "VEC2"), "POSITION has 2 components");
    expectMalformed(with(0, "type", "VEC9"), "VEC9");
    expectMalformed(with(1, "componentType", kFloat), "do not fit");
    expectMalformed(with(1, "componentType", kShort), "unsigned integers");
    expectMalformed(with(1, "type", "VEC3"), "do not fit");
}

TEST(GltfHostile, ViewsMustFitTheirBuffers) {
    const auto with = [](const char* member, nlohmann::json value) {
        GltfBuilder b = indexed();
        b.json["bufferViews"][0][member] = std::move(value);
        return b;
    };
    expectMalformed(with("byteLength", 1000), "beyond");
    expectMalformed(with("byteOffset", 20), "beyond");
    expectMalformed(with("byteOffset", std::uint64_t(-4)), "beyond");
    expectMalformed(with("buffer", 1), "buffer 1");
    expectMalformed(with("buffer", -1), "buffer -1");
    expectMalformed(with("byteStride", 4), "stride");
    expectMalformed(with("byteStride", 3), "Stride");
    expectMalformed(with("byteStride", 1000), "Stride");
    expectMalformed(with("byteLength", 3), "do not fit");
}

TEST(GltfHostile, IndicesMustNameVertices) {
    GltfBuilder b = indexed();
    b.binary[b.binary.size() - 4] = 200;
    expectMalformed(b, "beyond its 3 vertices");
    for (const char* member : {"indices", "material"}) {
        b = indexed();
        b.json["meshes"][0]["primitives"][0][member] = 9;
        EXPECT_FALSE(read(b)) << member;
    }
    b = indexed();
    b.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 9;
    expectMalformed(b, "accessor 9");
    b = indexed();
    b.json["nodes"][0]["mesh"] = 9;
    expectMalformed(b, "mesh 9");
    b = indexed();
    b.json["scenes"][0]["nodes"] = {-3};
    expectMalformed(b, "node -3");
    b.json["scene"] = 4;
    expectMalformed(b, "scene 4");
}

TEST(GltfHostile, PositionsMustBeFinite) {
    for (const float bad : {NAN, INFINITY, -INFINITY}) {
        GltfBuilder b = indexed();
        std::memcpy(b.binary.data() + 16, &bad, sizeof(bad));
        expectMalformed(b, "not a finite number");
    }
    GltfBuilder b = indexed();
    b.json["nodes"][0]["translation"] = {1e300, 0, 0};
    expectMalformed(b, "finite");
}

TEST(GltfHostile, SparseAccessorsAreChecked) {
    const auto with = [](const nlohmann::json& change, std::uint16_t index) {
        GltfBuilder b;
        const int position = b.addFloats({0, 0, 0, 1, 0, 0, 9, 9, 9}, "VEC3");
        const int indices = b.add(std::vector<std::uint16_t>{0, index}, kUnsignedShort, "SCALAR");
        const int values = b.addFloats({0, 5, 0, 1, 1, 1}, "VEC3");
        nlohmann::json sparse = {{"count", 2},
                                 {"indices", {{"bufferView", indices}, {"componentType", kUnsignedShort}}},
                                 {"values", {{"bufferView", values}}}};
        sparse.merge_patch(change);
        b.json["accessors"][position]["sparse"] = sparse;
        b.show({{"attributes", {{"POSITION", position}}}});
        return b;
    };
    const nlohmann::json kSame = nlohmann::json::object();
    EXPECT_TRUE(read(with(kSame, 2)));
    expectMalformed(with(kSame, 3), "out of range");
    expectMalformed(with(kSame, 0), "out of order");
    expectMalformed(with({{"count", 3}}, 2), "do not fit");
    expectMalformed(with({{"count", -1}}, 2), "negative");
    expectMalformed(with({{"count", 2000000000}}, 2), "sparse elements");
    expectMalformed(with({{"indices", {{"byteOffset", -2}}}}, 2), "negative");
    expectMalformed(with({{"indices", {{"componentType", kFloat}}}}, 2), "component type");
    expectMalformed(with({{"values", {{"bufferView", 50}}}}, 2), "buffer view 50");
}

TEST(GltfHostile, SmallFilesCannotAskForMuchMemory) {
    // Four billion zero vertices in 300 bytes.
    GltfBuilder b;
    b.append("accessors", {{"componentType", kFloat}, {"type", "VEC3"}, {"count", 0xffffffffu}});
    b.show({{"attributes", {{"POSITION", 0}}}});
    expectRefused(b, ErrorCode::outOfMemory, "out of proportion");

    // One vertex buffer used by thousands of primitives.
    GltfBuilder many;
    const int position = many.addFloats(std::vector<float>(30'000, 0.5f), "VEC3");
    nlohmann::json primitives;
    for (int i = 0; i < 5000; ++i) primitives.push_back({{"attributes", {{"POSITION", position}}}});
    many.append("meshes", {{"primitives", primitives}});
    many.append("nodes", {{"mesh", 0}});
    many.json["scenes"][0]["nodes"] = {0};
    expectRefused(many, ErrorCode::outOfMemory, "out of proportion");

    // The binary chunk copied into many buffers.
    GltfBuilder copies = indexed();
    copies.json["buffers"] = nlohmann::json::array();
    for (int i = 0; i < 3; ++i) copies.json["buffers"].push_back({{"byteLength", copies.binary.size()}});
    copies.binary.clear();
    expectMalformed(copies, "no uri");
}

TEST(GltfHostile, TextMustBeSane) {
    const auto refused = [](const std::string& text, const char* words) {
        expectRefused(Bytes(text.begin(), text.end()), ErrorCode::malformed, words);
    };
    refused("", "JSON");
    refused("[]", "not an object");
    refused("{", "byte");
    refused("hello", "byte");
    refused("{    }", "asset");
    refused(R"({"asset": 3})", "asset");
    refused(std::string(1'000'000, '['), "byte");
    const std::string deep = std::string(500'000, '[') + std::string(500'000, ']');
    refused(R"({"asset":{"version":"2.0"},"extras":)" + deep + "}", "nested");
    refused(deep, "not an object");
    // Every array of the root object with a wrong type, or with elements of a wrong type.
    for (const char* array : {"accessors", "animations", "buffers", "bufferViews", "cameras", "images", "materials",
                              "meshes", "nodes", "samplers", "scenes", "skins", "textures", "extensionsUsed"}) {
        for (const char* value :
             {"3", "null", "\"x\"", "[3]", "[null]", "[[]]", "[{}]", "{\"a\":[]}", "[{\"name\":3}]"}) {
            const std::string text = fmt::format(R"({{"asset":{{"version":"2.0"}},"{}":{}}})", array, value);
            const auto loaded = read(Bytes(text.begin(), text.end()));
            if (!loaded) {
                EXPECT_THAT(loaded.error().message, testing::StartsWith("test.glb: "));
            }
        }
    }
}

TEST(GltfHostile, BinaryHeaderIsChecked) {
    const Bytes whole = indexed().glb();
    Bytes b = whole;
    b[4] = 1;
    expectRefused(b, ErrorCode::unsupported, "version 1");
    b = whole;
    b[12] = b[13] = b[14] = b[15] = 0xff;
    expectRefused(b, ErrorCode::malformed, "cut off");
    b = whole;
    b[8] = 0xff;
    b[9] = 0xff;
    expectRefused(b, ErrorCode::malformed, "glTF");
}

class RealFile : public testing::TestWithParam<const char*> {
protected:
    static Bytes bytes() {
        std::ifstream file(scenesFolder() / GetParam(), std::ios::binary);
        EXPECT_TRUE(file) << "set PROBEGI_SCENES to the folder of the real scenes";
        return Bytes(std::istreambuf_iterator<char>(file), {});
    }
};

TEST_P(RealFile, EveryTruncationIsASentence) {
    const Bytes whole = bytes();
    ASSERT_TRUE(read(whole));
    for (std::size_t length = 0; length < whole.size(); length += 1 + length / 64) {
        const auto loaded = read(Bytes(whole.begin(), whole.begin() + std::ptrdiff_t(length)));
        ASSERT_FALSE(loaded) << length;
        EXPECT_THAT(loaded.error().message, testing::StartsWith("test.glb: "));
    }
}

TEST_P(RealFile, BitFlipsNeverCrash) {
    const Bytes whole = bytes();
    std::mt19937 random(7);
    int refused = 0;
    for (int trial = 0; trial < 3000; ++trial) {
        Bytes flipped = whole;
        for (int flips = 0; flips <= trial % 3; ++flips) {
            flipped[random() % flipped.size()] ^= std::uint8_t(1u << random() % 8);
        }
        const auto loaded = read(flipped);
        if (loaded) {
            EXPECT_TRUE(validate(loaded->scene));
        } else {
            ++refused;
            EXPECT_THAT(loaded.error().message, testing::StartsWith("test.glb: "));
        }
    }
    EXPECT_GT(refused, 300);
}

INSTANTIATE_TEST_SUITE_P(Scenes, RealFile, testing::Values("rtxgi/cornell.glb", "rtxgi/furnace.glb"),
                         [](const auto& scene) { return std::string(scene.index == 0 ? "cornell" : "furnace"); });

}  // namespace
}  // namespace probegi::test

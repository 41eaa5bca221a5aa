// Errors that tinygltf overlooks or misinterprets.
#include "io/gltf_strict.h"

#include <fmt/format.h>

#include "reading.h"
#include "support/memory.h"

namespace probegi::test {
namespace {

/// A triangle whose data is in a data: URI.
nlohmann::json triangleJson() {
    GltfBuilder b;
    b.show({{"attributes", b.triangle()}});
    const Bytes text = b.text();
    return nlohmann::json::parse(text.begin(), text.end());
}

Bytes textOf(const nlohmann::json& json) {
    const std::string text = json.dump();
    return {text.begin(), text.end()};
}

TEST(GltfStrict, NegativeNumbersAreRefused) {
    const auto refused = [](const char* list, const char* member, int value) {
        nlohmann::json json = triangleJson();
        json[list][0][member] = value;
        expectRefused(textOf(json), ErrorCode::malformed, fmt::format("{} {} may not be negative", member, value));
    };
    refused("accessors", "bufferView", -1);
    refused("accessors", "byteOffset", -12);
    refused("accessors", "count", -3);
    refused("bufferViews", "buffer", -1);
    refused("bufferViews", "byteOffset", -4);
    refused("bufferViews", "byteLength", -36);
    refused("bufferViews", "byteStride", -12);
    refused("buffers", "byteLength", -36);
}

TEST(GltfStrict, IndicesMustBeWholeAndFit) {
    const auto refused = [](const nlohmann::json& value, const char* words) {
        nlohmann::json json = triangleJson();
        json["nodes"][0]["mesh"] = value;
        expectRefused(textOf(json), ErrorCode::malformed, words);
    };
    refused(0.5, "mesh 0.5 is not a whole number");
    refused(0.0, "mesh 0.0 is not a whole number");
    refused(std::uint64_t(1) << 32, "mesh 4294967296 is too large");  // 0 in 32 bits
    nlohmann::json json = triangleJson();
    json["accessors"][0]["bufferView"] = std::uint64_t(1) << 32;
    expectRefused(textOf(json), ErrorCode::malformed, "bufferView 4294967296 is too large");
    json = triangleJson();
    json["nodes"][0]["extras"] = {{"count", -1}, {"mesh", 0.5}};
    EXPECT_TRUE(read(textOf(json))) << "extras are anybody's";
}

TEST(GltfStrict, MinimalVersions) {
    const auto with = [](const nlohmann::json& version) {
        nlohmann::json json = triangleJson();
        json["asset"]["minVersion"] = version;
        return textOf(json);
    };
    EXPECT_TRUE(read(with("2.0")));
    EXPECT_TRUE(read(with("1.1")));
    for (const nlohmann::json& version : {nlohmann::json("2.1"), nlohmann::json("3.0"), nlohmann::json("20.0"),
                                          nlohmann::json("new"), nlohmann::json(""), nlohmann::json(2)})
        expectRefused(with(version), ErrorCode::unsupported, "minVersion");
    nlohmann::json json = triangleJson();
    json["asset"]["version"] = "2.1";
    EXPECT_TRUE(read(textOf(json))) << "newer files may be read where they do not say that they may not";
}

TEST(GltfStrict, DataUris) {
    const auto with = [](const std::string& uri) {
        nlohmann::json json = triangleJson();
        json["buffers"][0]["uri"] = uri;
        return textOf(json);
    };
    const std::string whole = triangleJson()["buffers"][0]["uri"];
    const std::string data = whole.substr(whole.find(',') + 1);
    for (const char* media : {"application/octet-stream", "application/x-mesh", "", "model/gltf;charset=x"}) {
        const auto loaded = read(with("data:" + std::string(media) + ";base64," + data));
        ASSERT_TRUE(loaded) << media << ": " << loaded.error().message;
        EXPECT_EQ(onlyPrimitive(loaded->scene).positions[1], glm::vec3(1, 0, 0)) << media;
    }
    std::string percent = "data:application/octet-stream,";
    for (int i = 0; i < 36; ++i) percent += "%00";
    expectRefused(with(percent), ErrorCode::unsupported, "percent-encoded");
    expectRefused(with("data:"), ErrorCode::unsupported, "percent-encoded");
    expectRefused(with("data:;base64,"), ErrorCode::malformed, "holds no data");
    expectRefused(with("data:;base64," + data.substr(0, 8) + "%3D"), ErrorCode::malformed, "not base64 from byte 8");
}

TEST(GltfStrict, MessagesAreNotALibrarys) {
    const auto refused = [](const std::string& text, const char* words) {
        const auto loaded = read(Bytes(text.begin(), text.end()));
        ASSERT_FALSE(loaded) << text;
        EXPECT_THAT(loaded.error().message, testing::HasSubstr(words));
        for (const char* foreign : {"json.exception", "vector::", "std::", "basic_string"})
            EXPECT_THAT(loaded.error().message, testing::Not(testing::HasSubstr(foreign)));
    };
    refused(R"({"asset":{"version":"2.0"},"nodes":[{"translation":[1e999,0,0]}]})", "number at byte 57");
    refused(R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":0,"uri":"data:;base64,"}]})", "no data");
    // An empty binary chunk as an empty buffer.
    GltfBuilder b;
    b.json["buffers"] = {{{"byteLength", 0}}};
    const auto empty = read(b);
    if (!empty) {
        EXPECT_THAT(empty.error().message, testing::Not(testing::HasSubstr("vector::")));
    }
}

TEST(GltfStrict, TextFullOfObjectsIsRefusedBeforeTheyAreMade) {
    std::string text = R"({"asset":{"version":"2.0"},"nodes":[{})";
    for (int i = 0; i < 1'000'000; ++i) text += ",{}";
    text += "]}";
    const Bytes bytes(text.begin(), text.end());
    const std::size_t before = peakMemory();
    expectRefused(bytes, ErrorCode::outOfMemory, "out of proportion");
    EXPECT_LT(peakMemory() - before, std::size_t(32) << 20);
}

TEST(GltfStrict, ARaisedLimitLetsObjectsPass) {
    std::string text = R"({"asset":{"version":"2.0"},"nodes":[{})";
    for (int i = 0; i < 20'000; ++i) text += ",{}";
    text += "]}";
    const Bytes bytes(text.begin(), text.end());
    EXPECT_FALSE(io::loadGltfFromMemory("a", bytes, {}, {16, "x"}));
    const auto loaded = io::loadGltfFromMemory("a", bytes, {}, {16 * 16, "x"});
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded->scene.nodes.size(), 20'001u);
}

TEST(GltfStrict, LongNamesAreQuotedInPart) {
    nlohmann::json json = triangleJson();
    json["meshes"][0]["name"] = std::string(1 << 20, 'y');
    json["accessors"][0]["count"] = 4;
    expectRefused(textOf(json), ErrorCode::malformed, "yyy...");  // under 500 bytes, as all messages
    json = triangleJson();
    json["buffers"][0]["uri"] = "../" + std::string(1 << 20, 'y');
    expectRefused(textOf(json), ErrorCode::unsupported, "yyy...");
    json = triangleJson();
    json["extensionsRequired"] = {std::string(1 << 20, 'y')};
    expectRefused(textOf(json), ErrorCode::unsupported, "yyy...");
}

}  // namespace
}  // namespace probegi::test

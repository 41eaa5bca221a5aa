#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <glm/gtc/quaternion.hpp>

#include "io/sdf_text.h"
#include "probegi/io.h"

namespace probegi::test {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

Result<SdfScene> readText(const std::string& text, const ReadLimits& limits = {}) {
    return io::loadSdfFromMemory("test.sdf.json", {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()},
                                 limits);
}

/// A file of one primitive.
Result<SdfScene> readOne(const std::string& primitive) {
    return readText("{\"sdf\": 1, \"primitives\": [" + primitive + "]}");
}

void expectRefused(const Result<SdfScene>& read, ErrorCode code, const std::string& words) {
    ASSERT_FALSE(read) << "was read, but should say: " << words;
    EXPECT_EQ(read.error().code, code);
    EXPECT_THAT(read.error().message, testing::StartsWith("test.sdf.json: "));
    EXPECT_THAT(read.error().message, HasSubstr(words));
    EXPECT_LT(read.error().message.size(), 400u);
}

/// One of each shape, with values that only all digits of a float tell.
SdfScene everyShape() {
    SdfScene sdf;
    for (int i = 0; i < 6; ++i) {
        SdfPrimitive p;
        p.shape = SdfShape(i);
        p.name = i == 2 ? "" : "part \"" + std::to_string(i) + "\" \xc3\xa4";
        p.centre = {0.1f * float(i), -1.0f / 3, 1e-7f};
        if (i != 4) p.rotation = glm::normalize(glm::quat(0.3f, 0.1f * float(i), -0.2f, 0.9f));
        if (i < 5) p.halfSize = {0.7f, 1.3f, 2e-3f};
        if (i > 1) p.halfSize.z = 0.5f;
        if (i == 2) p.halfSize.y = 0.5f;
        p.rounding = i == 1 ? 1e-3f : 0;
        p.albedo = {0.1f, 0.2f, 1};
        if (i == 3) p.emission = {1e20f, 0, 3.3f};
        if (i == 5) p.node = "door";
        p.pinned = i == 0;
        sdf.primitives.push_back(p);
    }
    return sdf;
}

TEST(SdfFile, whatWasSavedIsLoaded) {
    const SdfScene sdf = everyShape();
    const fs::path path = fs::path(testing::TempDir()) / "every.sdf.json";
    ASSERT_TRUE(saveSdf(path, sdf));
    const auto loaded = loadSdf(path);
    fs::remove(path);
    ASSERT_TRUE(loaded) << loaded.error().message;
    ASSERT_EQ(loaded->primitives.size(), sdf.primitives.size());
    for (std::size_t i = 0; i < sdf.primitives.size(); ++i) {
        const SdfPrimitive &a = sdf.primitives[i], &b = loaded->primitives[i];
        EXPECT_EQ(a.name, b.name);
        EXPECT_EQ(a.shape, b.shape);
        EXPECT_EQ(a.centre, b.centre);
        EXPECT_EQ(a.rotation, b.rotation);
        EXPECT_EQ(a.halfSize, b.halfSize) << i;
        EXPECT_EQ(a.rounding, b.rounding);
        EXPECT_EQ(a.albedo, b.albedo);
        EXPECT_EQ(a.emission, b.emission);
        EXPECT_EQ(a.node, b.node);
        EXPECT_EQ(a.pinned, b.pinned);
    }
    EXPECT_EQ(io::sdfText(*loaded), io::sdfText(sdf));
}

TEST(SdfFile, whatIsLeftOutHasDefaults) {
    const auto read = readOne(R"({"shape": "sphere", "centre": [1, 2, 3], "radius": 2})");
    ASSERT_TRUE(read) << read.error().message;
    const SdfPrimitive& p = read->primitives[0];
    EXPECT_EQ(p.centre, glm::vec3(1, 2, 3));
    EXPECT_EQ(p.halfSize.x, 2);
    EXPECT_EQ(p.rotation, SdfPrimitive{}.rotation);
    EXPECT_EQ(p.albedo, SdfPrimitive{}.albedo);
    EXPECT_EQ(p.emission, glm::vec3(0));
    EXPECT_EQ(p.node, "");
    EXPECT_FALSE(p.pinned);
    EXPECT_TRUE(readText(R"({"sdf": 1, "primitives": []})"));
}

TEST(SdfFile, rotationsOfAnyLengthAreMadeUnit) {
    const auto read = readOne(R"({"shape": "plane", "centre": [0, 0, 0], "rotation": [0, 0, 3, 3]})");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_NEAR(read->primitives[0].rotation.z, 0.70710678f, 1e-6);
    expectRefused(readOne(R"({"shape": "plane", "centre": [0, 0, 0], "rotation": [0, 0, 0, 0]})"), ErrorCode::malformed,
                  "primitive 0: its 'rotation' must be a quaternion");
}

TEST(SdfFile, mistakesAreNamed) {
    const auto expectFault = [](const std::string& members, const std::string& words) {
        expectRefused(readOne("{\"name\": \"wall\", " + members + "}"), ErrorCode::malformed,
                      "primitive 0 'wall': " + words);
    };
    const std::string box = R"("shape": "box", "centre": [0, 0, 0], "halfSize": [1, 1, 1])";
    expectFault(R"("centre": [0, 0, 0])", "it has no 'shape'");
    expectFault(R"("shape": "cube")", "there is no shape 'cube'; there are box,");
    expectFault(R"("shape": 3)", "its 'shape' must be a text in quotes");
    expectFault(R"("shape": "box")", "it has no 'centre'");
    expectFault(R"("shape": "box", "centre": [0, 0])", "its 'centre' must be 3 numbers in brackets");
    expectFault(R"("shape": "box", "centre": [0, 0, "0"])", "its 'centre' must be 3 numbers in brackets");
    expectFault(R"("shape": "box", "centre": [0, 0, 0], "halfsize": [1, 1, 1])", "it has no 'halfSize'");
    expectFault(box + R"(, "albdo": [1, 1, 1])", "a box has no 'albdo'; correct the spelling or remove it");
    expectFault(box + R"(, "rounding": 0.1)", "a box has no 'rounding'");
    expectFault(R"("shape": "sphere", "centre": [0, 0, 0], "radius": "1")", "its 'radius' must be a number");
    expectFault(R"("shape": "sphere", "centre": [0, 0, 0], "radius": -1)", "its radius -1 must be > 0");
    expectFault(R"("shape": "sphere", "centre": [0, 0, 1e39], "radius": 1)", "its 'centre' has a number that is too");
    expectFault(R"("shape": "capsule", "centre": [0, 0, 0], "radius": 1)", "it has no 'halfLength'");
    expectFault(box + R"(, "pinned": 1)", "its 'pinned' must be true or false");
    expectFault(box + R"(, "node": null)", "its 'node' must be a text in quotes");
    expectFault(box + R"(, "albedo": [2, 0, 0])", "its albedo (2, 0, 0) must be 0..1");
    expectRefused(readOne("7"), ErrorCode::malformed, "primitive 0 must be an object in braces");
}

TEST(SdfFile, otherFilesAreRefused) {
    expectRefused(readText(""), ErrorCode::malformed, "is not a scene of primitives: its JSON is invalid or cut off");
    expectRefused(readText("[]"), ErrorCode::malformed, "its JSON is not an object");
    expectRefused(readText("{}"), ErrorCode::malformed, "it has no \"sdf\": 1");
    expectRefused(readText(R"({"sdf": "1", "primitives": []})"), ErrorCode::malformed, "it has no \"sdf\": 1");
    expectRefused(readText(R"({"sdf": 2, "primitives": []})"), ErrorCode::unsupported, "version 2");
    expectRefused(readText(R"({"sdf": 1})"), ErrorCode::malformed, "it has no list of \"primitives\"");
    expectRefused(readText(R"({"sdf": 1, "primitives": [], "primitves": []})"), ErrorCode::malformed, "'primitves'");
    expectRefused(readText(R"({"asset": {"version": "2.0"}})"), ErrorCode::malformed, "is not a scene of primitives");
    const auto absent = loadSdf("no/such/file.sdf.json");
    ASSERT_FALSE(absent);
    EXPECT_EQ(absent.error().code, ErrorCode::fileNotFound);
}

TEST(SdfFile, hostileFilesAreRefused) {
    const std::string plane = R"({"shape": "plane", "centre": [0, 0, 0]})";
    std::string many = "{\"sdf\": 1, \"primitives\": [" + plane;
    for (int i = 1; i < 100000; ++i) many += "," + plane;
    expectRefused(readText(many + "]}"), ErrorCode::malformed, "100000 primitives are more than 4096");
    expectRefused(readText("{\"sdf\": 1, \"primitives\": " + std::string(100000, '[')), ErrorCode::malformed, "JSON");
    std::string values = "{\"sdf\": 1, \"primitives\": [0";
    for (int i = 0; i < 400000; ++i) values += ",{}";
    expectRefused(readText(values + "]}", {.megabytes = 1, .name = "--limit"}), ErrorCode::outOfMemory,
                  "raise --limit");
    expectRefused(readText(R"({"sdf": 1, "primitives": [{"centre": [1e999]}]})"), ErrorCode::malformed, "too large");
    const std::string whole = io::sdfText(everyShape());
    for (std::size_t length = 0; length + 3 < whole.size(); length += 7) {
        EXPECT_FALSE(readText(whole.substr(0, length))) << length;
    }
}

TEST(SdfFile, refusesToSaveWhatIsInvalid) {
    SdfScene sdf = everyShape();
    sdf.primitives[0].halfSize.x = -1;
    const fs::path path = fs::path(testing::TempDir()) / "invalid.sdf.json";
    const auto saved = saveSdf(path, sdf);
    ASSERT_FALSE(saved);
    EXPECT_THAT(saved.error().message, HasSubstr("half size along x -1"));
    EXPECT_FALSE(fs::exists(path));
    EXPECT_EQ(saveSdf("no/such/folder/x.json", everyShape()).error().code, ErrorCode::writeFailed);
}

TEST(SdfFile, keepsColoursOfFacesInEightBits) {
    SdfScene sdf{{SdfPrimitive{}}};
    for (int i = 0; i < 216; ++i) sdf.primitives[0].faces.push_back({float(i) / 215, 0, 1});
    const auto read = readText(io::sdfText(sdf));
    ASSERT_TRUE(read) << read.error().message;
    const auto& faces = read->primitives[0].faces;
    ASSERT_EQ(faces.size(), 216u);
    for (std::size_t i = 0; i < 216; ++i) {
        EXPECT_NEAR(std::sqrt(faces[i].x), std::sqrt(float(i) / 215), 0.5f / 255 + 1e-6f);
        EXPECT_EQ(faces[i].y, 0);
        EXPECT_EQ(faces[i].z, 1);
    }
    EXPECT_EQ(io::sdfText(*read), io::sdfText(sdf));  // once in eight bits, they stay
}

TEST(SdfFile, refusesBrokenColoursOfFaces) {
    const auto withFaces = [](const std::string& faces) {
        return readOne(R"({"shape": "box", "centre": [0, 0, 0], "halfSize": [1, 1, 1], "faces": )" + faces + "}");
    };
    const std::string face(216, 'a'), odd = std::string(215, 'a') + "g";
    const auto list = [](const std::string& first, const std::string& rest, int count) {
        std::string text = "[\"" + first + "\"";
        for (int i = 1; i < count; ++i) text += ", \"" + rest + "\"";
        return text + "]";
    };
    EXPECT_TRUE(withFaces(list(face, face, 6)));
    expectRefused(withFaces(list(face, face, 5)), ErrorCode::malformed, "6 texts of 216");
    expectRefused(withFaces(list(face + "aa", face, 6)), ErrorCode::malformed, "6 texts of 216");
    expectRefused(withFaces(list(odd, face, 6)), ErrorCode::malformed, "hexadecimal");
    expectRefused(withFaces("[1, 2]"), ErrorCode::malformed, "list of texts");
}

}  // namespace
}  // namespace probegi::test

#include <set>

#include "draco_sample.h"
#include "reading.h"

namespace probegi::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(GltfExtension, RequiredAndUnknownIsAnErrorThatNamesIt) {
    GltfBuilder b;
    b.show({{"attributes", b.triangle()}});
    b.json["extensionsUsed"] = {"EXT_meshopt_compression"};
    b.json["extensionsRequired"] = {"EXT_meshopt_compression"};
    expectRefused(b, ErrorCode::unsupported, "EXT_meshopt_compression");
}

TEST(GltfExtension, OptionalAndUnknownIsAWarningThatNamesIt) {
    GltfBuilder b;
    b.show({{"attributes", b.triangle()}});
    b.json["extensionsUsed"] = {"KHR_materials_unlit", "KHR_lights_punctual"};
    const auto loaded = read(b);
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_THAT(loaded->warnings, ElementsAre(HasSubstr("KHR_materials_unlit")));
}

TEST(GltfExtension, OtherVersionsAreRefused) {
    GltfBuilder b;
    b.json["asset"]["version"] = "1.0";
    expectRefused(b, ErrorCode::unsupported, "version '1.0'");
    b.json["asset"]["version"] = "2.1";
    EXPECT_TRUE(read(b));
}

TEST(GltfDraco, RoundTrip) {
    constexpr int kSize = 6;
    const Scene scene = readClean(dracoScene(kSize));
    const Primitive p = onlyPrimitive(scene);
    EXPECT_EQ(p.indices.size(), std::size_t(6 * kSize * kSize));
    EXPECT_EQ(p.positions.size(), std::size_t((kSize + 1) * (kSize + 1)));
    ASSERT_EQ(p.normals.size(), p.positions.size());
    ASSERT_EQ(p.uv0.size(), p.positions.size());
    constexpr float kQuantum = kSize / 16384.0f;  // of 14 bits
    std::set<std::pair<int, int>> corners;
    for (std::size_t v = 0; v < p.positions.size(); ++v) {
        const glm::vec3 at = p.positions[v];
        const glm::vec3 rounded(std::round(at.x), std::round(at.y), 0.25f * std::sin(std::round(at.x)));
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(at[c], rounded[c], kQuantum);
        EXPECT_NEAR(p.normals[v].z, 1.0f, 1e-3f);
        EXPECT_NEAR(p.uv0[v].x, at.x / kSize, 1e-3f);
        EXPECT_NEAR(p.uv0[v].y, at.y / kSize, 1e-3f);
        corners.emplace(int(rounded.x), int(rounded.y));
    }
    EXPECT_EQ(corners.size(), p.positions.size());
}

TEST(GltfDraco, ReadsTextFilesToo) {
    const auto loaded = read(dracoScene().text());
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(triangleCount(loaded->scene, poseAt(loaded->scene)), 32u);
}

TEST(GltfDraco, RefusesBrokenExtensions) {
    const auto withExtension = [](const char* member, nlohmann::json value) {
        GltfBuilder b = dracoScene();
        auto& extension = b.json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"];
        extension[member] = std::move(value);
        return b;
    };
    expectRefused(withExtension("bufferView", 9), ErrorCode::malformed, "buffer view 9");
    expectRefused(withExtension("bufferView", "x"), ErrorCode::malformed, "Draco");
    expectRefused(withExtension("attributes", {{"POSITION", 77}}), ErrorCode::malformed, "no attribute POSITION");
    expectRefused(withExtension("attributes", {{"POSITION", -1}}), ErrorCode::malformed, "no attribute POSITION");
    expectRefused(withExtension("attributes", 3), ErrorCode::malformed, "Draco");
}

TEST(GltfDraco, DamagedDataNeverCrashes) {
    const GltfBuilder whole = dracoScene();
    int refused = 0;
    for (std::size_t at = 0; at < whole.binary.size(); ++at) {
        for (const int flip : {0x01, 0x80, 0xff}) {
            GltfBuilder b = whole;
            b.binary[at] = std::uint8_t(b.binary[at] ^ flip);
            const auto loaded = read(b);
            if (loaded) continue;
            ++refused;
            EXPECT_THAT(loaded.error().message, testing::StartsWith("test.glb: "));
        }
    }
    EXPECT_GT(refused, 20);
}

}  // namespace
}  // namespace probegi::test

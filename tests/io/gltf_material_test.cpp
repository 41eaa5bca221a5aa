#include <filesystem>
#include <fstream>

#include "reading.h"

namespace probegi::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

glm::vec2 apply(const TextureRef& ref, glm::vec2 uv) {
    return glm::vec2(ref.uvTransform * glm::vec3(uv, 1.0f));
}

/// A triangle whose material has a base colour texture with these extra properties.
GltfBuilder textured(const nlohmann::json& info, const nlohmann::json& image) {
    GltfBuilder b;
    b.append("images", image);
    nlohmann::json texture = {{"index", b.append("textures", {{"source", 0}})}};
    if (!info.is_null()) texture.update(info);
    b.append("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", texture}}}});
    b.show({{"attributes", b.triangle()}, {"material", 0}});
    return b;
}
nlohmann::json inlinePng(int width = 2, int height = 2) {
    return {{"uri", dataUri("image/png", smallPng(width, height))}};
}

TEST(GltfMaterial, ReadsEveryProperty) {
    const Scene scene = readClean(richScene());
    ASSERT_EQ(scene.materials.size(), 1u);
    const Material& m = scene.materials[0];
    EXPECT_EQ(m.name, "all");
    EXPECT_EQ(m.baseColor, glm::vec4(0.1f, 0.2f, 0.3f, 0.4f));
    EXPECT_FLOAT_EQ(m.metallic, 0.5f);
    EXPECT_FLOAT_EQ(m.roughness, 0.6f);
    EXPECT_EQ(m.emission, glm::vec3(8, 4, 2)) << "emissiveFactor x emissiveStrength";
    EXPECT_FLOAT_EQ(m.normalScale, 0.7f);
    EXPECT_EQ(m.alphaMode, AlphaMode::mask);
    EXPECT_FLOAT_EQ(m.alphaCutoff, 0.3f);
    EXPECT_TRUE(m.doubleSided);
    for (const TextureRef* ref :
         {&m.baseColorTexture, &m.metallicRoughnessTexture, &m.normalTexture, &m.emissiveTexture}) {
        EXPECT_EQ(ref->image, 0);
        EXPECT_EQ(ref->wrapU, Wrap::clampToEdge);
        EXPECT_EQ(ref->wrapV, Wrap::mirroredRepeat);
        EXPECT_TRUE(ref->nearest);
    }
    EXPECT_EQ(m.normalTexture.texCoord, 1);
    EXPECT_EQ(m.baseColorTexture.texCoord, 1) << "KHR_texture_transform overrides the uv set";
    ASSERT_EQ(scene.images.size(), 1u) << "decoded once";
    EXPECT_EQ(scene.images[0].width, 5);
    EXPECT_EQ(scene.images[0].height, 3);
    EXPECT_EQ(scene.images[0].rgba.size(), 60u);
    EXPECT_EQ(scene.images[0].rgba[3], 255) << "opaque where the file has no alpha";
}

TEST(GltfMaterial, DefaultsAreThoseOfGltf) {
    GltfBuilder b;
    b.append("materials", nlohmann::json::object());
    b.append("materials", {{"alphaMode", "BLEND"}});
    const Scene scene = readClean(b);
    const Material& m = scene.materials.at(0);
    EXPECT_EQ(m.baseColor, glm::vec4(1));
    EXPECT_EQ(m.metallic, 1.0f);
    EXPECT_EQ(m.roughness, 1.0f);
    EXPECT_EQ(m.emission, glm::vec3(0));
    EXPECT_EQ(m.alphaMode, AlphaMode::opaque);
    EXPECT_EQ(m.baseColorTexture.image, -1);
    EXPECT_FALSE(m.doubleSided);
    EXPECT_EQ(scene.materials.at(1).alphaMode, AlphaMode::blend);
}

TEST(GltfMaterial, TextureTransform) {
    constexpr double kQuarter = 1.5707963267948966;
    const auto ref = [](const nlohmann::json& transform) {
        const Scene scene = readClean(textured({{"extensions", {{"KHR_texture_transform", transform}}}}, inlinePng()));
        return scene.materials.empty() ? TextureRef() : scene.materials[0].baseColorTexture;
    };
    EXPECT_EQ(apply(ref({{"offset", {0.5, 0.25}}}), {0.1f, 0.1f}), glm::vec2(0.6f, 0.35f));
    EXPECT_EQ(apply(ref({{"scale", {2, 4}}}), {0.5f, 0.5f}), glm::vec2(1, 2));
    // Counter-clockwise on the image, whose v points down: the u axis turns up, to -v.
    const glm::vec2 turned = apply(ref({{"rotation", kQuarter}}), {1, 0});
    EXPECT_NEAR(turned.x, 0, 1e-6f);
    EXPECT_NEAR(turned.y, -1, 1e-6f);
    // Scale first, then rotation, then offset.
    const glm::vec2 all = apply(ref({{"rotation", kQuarter}, {"scale", {2, 3}}, {"offset", {10, 20}}}), {1, 1});
    EXPECT_NEAR(all.x, 13, 1e-5f);
    EXPECT_NEAR(all.y, 18, 1e-5f);
}

TEST(GltfMaterial, LimitsFactorsAndSaysSo) {
    GltfBuilder b;
    b.append("materials", {{"name", "odd"},
                           {"pbrMetallicRoughness", {{"metallicFactor", 3}, {"roughnessFactor", -1}}},
                           {"alphaMode", "GLASS"},
                           {"emissiveFactor", {-1, 0, 0}}});
    const auto loaded = read(b);
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded->scene.materials[0].metallic, 1.0f);
    EXPECT_EQ(loaded->scene.materials[0].roughness, 0.0f);
    EXPECT_EQ(loaded->scene.materials[0].emission, glm::vec3(0));
    EXPECT_THAT(loaded->warnings, ElementsAre(HasSubstr("metallic"), HasSubstr("roughness"), HasSubstr("emission"),
                                              HasSubstr("alpha mode")));
    EXPECT_THAT(loaded->warnings[0], HasSubstr("'odd'"));
}

TEST(GltfMaterial, WarnsOfTexturesItCannotUse) {
    const auto loaded = read(textured({{"texCoord", 2}}, inlinePng()));
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_THAT(loaded->warnings, ElementsAre(HasSubstr("uv set 2")));
    EXPECT_EQ(loaded->scene.materials[0].baseColorTexture.image, -1);

    GltfBuilder b = textured({}, inlinePng());
    b.json["textures"][0] = nlohmann::json::object();
    const auto without = read(b);
    ASSERT_TRUE(without) << without.error().message;
    EXPECT_THAT(without->warnings, ElementsAre(HasSubstr("no PNG or JPEG")));
}

TEST(GltfMaterial, RefusesUnreadableImages) {
    const Bytes png = smallPng(64, 64);
    const Bytes half(png.begin(), png.begin() + std::ptrdiff_t(png.size() / 2));
    expectRefused(textured({}, {{"uri", dataUri("image/png", half)}}), ErrorCode::malformed, "PNG");
    expectRefused(textured({}, {{"uri", dataUri("image/png", Bytes(40, 7))}}), ErrorCode::unsupported,
                  "neither PNG nor JPEG");
    expectRefused(textured({}, {{"bufferView", 99}}), ErrorCode::malformed, "image 0");
    // A PNG of a hundred bytes that claims 60,000 x 60,000 pixels.
    Bytes bomb = smallPng(2, 2);
    for (const std::size_t at : {16u, 20u}) {
        bomb[at + 2] = 0xea;
        bomb[at + 3] = 0x60;
    }
    expectRefused(textured({}, {{"uri", dataUri("image/png", bomb)}}), ErrorCode::malformed, "over 2^28 pixels");
    for (const std::size_t at : {16u, 20u}) bomb[at + 2] = 0x30;
    expectRefused(textured({}, {{"uri", dataUri("image/png", bomb)}}), ErrorCode::malformed, "claims");
}

TEST(GltfMaterial, ManyUsesOfOneImageCostOnce) {
    GltfBuilder b;
    b.append("images", inlinePng(32, 32));
    b.append("textures", {{"source", 0}});
    for (int i = 0; i < 20; ++i) {
        b.append("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    }
    EXPECT_EQ(readClean(b).images.size(), 1u);
}

class GltfFiles : public testing::Test {
protected:
    GltfFiles() : m_folder(std::filesystem::temp_directory_path() / ("probegi_gltf_" + std::to_string(getpid()))) {
        std::filesystem::create_directories(m_folder / "textures");
    }
    ~GltfFiles() override { std::filesystem::remove_all(m_folder); }

    void write(const char* name, const Bytes& bytes) const {
        std::ofstream(m_folder / name, std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
    }
    Result<LoadedScene> loadWithImage(const std::string& uri) const {
        write("scene.gltf", textured({}, {{"uri", uri}}).text());
        return loadScene(m_folder / "scene.gltf");
    }

    std::filesystem::path m_folder;
};

TEST_F(GltfFiles, ReadsNeighboursAndFoldersBelow) {
    write("textures/my wall.png", smallPng(4, 2));
    const auto loaded = loadWithImage("textures/my%20wall.png");
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded->scene.images.at(0).width, 4);
    EXPECT_EQ(loaded->scene.name, "scene");
}

TEST_F(GltfFiles, MissingTextureIsNamed) {
    const auto loaded = loadWithImage("textures/gone.png");
    ASSERT_FALSE(loaded);
    EXPECT_EQ(loaded.error().code, ErrorCode::fileNotFound);
    EXPECT_THAT(loaded.error().message, HasSubstr("textures/gone.png"));
    EXPECT_THAT(loaded.error().message, HasSubstr("scene.gltf"));
}

TEST_F(GltfFiles, NothingOutsideTheFolderIsRead) {
    write("secret.png", smallPng(4, 2));
    for (const std::string uri : {"../secret.png", "textures/../../secret.png", "/etc/passwd", "%2e%2e/secret.png",
                                  "https://example.org/a.png", "file:///etc/passwd", "..\\secret.png"}) {
        const auto loaded = loadWithImage(uri);
        ASSERT_FALSE(loaded) << uri;
        EXPECT_EQ(loaded.error().code, ErrorCode::unsupported) << loaded.error().message;
        EXPECT_THAT(loaded.error().message, HasSubstr("own folder"));
    }
}

TEST_F(GltfFiles, ReadsAndChecksSeparateBuffers) {
    GltfBuilder b;
    b.show({{"attributes", b.triangle()}});
    b.json["buffers"] = {{{"byteLength", b.binary.size()}, {"uri", "scene.bin"}}};
    const std::string text = b.json.dump();
    write("scene.gltf", {text.begin(), text.end()});
    const auto missing = loadScene(m_folder / "scene.gltf");
    ASSERT_FALSE(missing);
    EXPECT_THAT(missing.error().message, HasSubstr("scene.bin"));
    write("scene.bin", b.binary);
    const auto loaded = loadScene(m_folder / "scene.gltf");
    ASSERT_TRUE(loaded) << loaded.error().message;
    write("scene.bin", Bytes(4));
    EXPECT_FALSE(loadScene(m_folder / "scene.gltf"));
}

}  // namespace
}  // namespace probegi::test

#include "probegi/io.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "gltf_builder.h"
#include "support/scenes.h"

namespace probegi::test {
namespace {

using testing::HasSubstr;

/// `warnings`: matches the reader's warnings.
Scene load(const char* name, const testing::Matcher<const std::vector<std::string>&>& warnings = testing::IsEmpty()) {
    auto loaded = loadScene(scenesFolder() / name);
    EXPECT_TRUE(loaded) << loaded.error().message << " (set PROBEGI_SCENES to the folder of the real scenes)";
    if (!loaded) return {};
    EXPECT_THAT(loaded->warnings, warnings);
    return std::move(loaded->scene);
}
/// The file requests a grid that follows the camera, which is not supported.
testing::Matcher<const std::vector<std::string>&> scrollingIgnored() {
    return testing::ElementsAre(HasSubstr("infiniteScrolling.enabled is ignored"));
}
std::size_t triangles(const Scene& scene) {
    return triangleCount(scene, poseAt(scene));
}
std::size_t vertices(const Scene& scene) {
    std::size_t count = 0;
    for (const Mesh& mesh : scene.meshes) {
        for (const Primitive& p : mesh.primitives) count += p.positions.size();
    }
    return count;
}

// The expected numbers are from the scenes' own description.

TEST(LoadScene, Sponza) {
    const Scene scene = load("sponza/sponza.glb");
    EXPECT_EQ(triangles(scene), 262'267u);
    EXPECT_EQ(vertices(scene), 184'402u);
    EXPECT_EQ(scene.meshes.size(), 381u);
    EXPECT_EQ(scene.materials.size(), 25u);
    EXPECT_EQ(std::count_if(scene.materials.begin(), scene.materials.end(),
                            [](const Material& m) { return m.alphaMode == AlphaMode::mask && m.doubleSided; }),
              3);
    const ScenePose pose = poseAt(scene);
    EXPECT_NEAR(pose.bounds.upper.y, 14.29f, 0.01f);
    ASSERT_EQ(pose.lights.size(), 1u);
    EXPECT_EQ(pose.lights[0].intensity, glm::vec3(20));
    EXPECT_NEAR(pose.lights[0].direction.y, -0.9476f, 1e-4f);
    ASSERT_EQ(pose.cameras.size(), 2u);
    EXPECT_EQ(pose.cameras[0].name, "nave");
    EXPECT_NEAR(pose.cameras[0].forward.x, 1.0f, 1e-5f);
    for (const TextureImage& image : scene.images) EXPECT_LE(image.width, 512) << image.name;
    EXPECT_FALSE(scene.grid);
    EXPECT_TRUE(scene.sky.black());
}

TEST(LoadScene, CornellWithItsSettings) {
    const Scene scene = load("rtxgi/cornell.glb", scrollingIgnored());
    EXPECT_EQ(triangles(scene), 34u);
    EXPECT_EQ(vertices(scene), 82u);
    EXPECT_EQ(scene.materials.size(), 3u);
    ASSERT_EQ(scene.lights.size(), 1u) << "two of three have no power";
    EXPECT_EQ(scene.lights[0].type, LightType::directional);
    EXPECT_EQ(scene.cameras.size(), 2u);
    ASSERT_TRUE(scene.grid);
    EXPECT_EQ(scene.grid->counts, glm::ivec3(9));
    EXPECT_NEAR(scene.grid->origin.x, -1.2f, 1e-6f);
    EXPECT_NEAR(scene.grid->origin.y, -0.2f, 1e-6f);
    EXPECT_TRUE(scene.sky.black());
}

TEST(LoadScene, FurnaceWithItsSettings) {
    const Scene scene = load("rtxgi/furnace.glb");
    EXPECT_EQ(triangles(scene), 12u);
    EXPECT_TRUE(scene.materials.at(0).doubleSided);
    EXPECT_EQ(scene.sky.radiance, glm::vec3(1));
    EXPECT_TRUE(scene.lights.empty());
    EXPECT_EQ(scene.grid.value().counts, glm::ivec3(8, 3, 8));
}

TEST(LoadScene, TwoRoomsWithItsSettings) {
    const Scene scene = load("rtxgi/two-rooms.glb", scrollingIgnored());
    EXPECT_EQ(triangles(scene), 90u);
    EXPECT_EQ(scene.cameras.size(), 3u);
    EXPECT_EQ(scene.lights.at(0).intensity, glm::vec3(2.25f));
    // The camera in the open room looks along +X and down, at the doorway.
    const ScenePose pose = poseAt(scene);
    EXPECT_GT(pose.cameras.at(0).forward.x, 0.8f);
    EXPECT_LT(pose.cameras.at(0).forward.y, 0.0f);
}

TEST(LoadScene, OpenArena) {
    const Scene scene = load("openarena/oa_dm1.glb");
    EXPECT_EQ(triangles(scene), 7'382u);
    EXPECT_EQ(vertices(scene), 7'421u);
    EXPECT_EQ(scene.cameras.size(), 9u);
    EXPECT_EQ(scene.lights.at(0).intensity, glm::vec3(60));
}

class LoadFolder : public testing::Test {
protected:
    LoadFolder() : m_folder(std::filesystem::temp_directory_path() / ("probegi_load_" + std::to_string(getpid()))) {
        std::filesystem::create_directories(m_folder);
    }
    ~LoadFolder() override { std::filesystem::remove_all(m_folder); }

    std::filesystem::path write(const char* name, const auto& bytes) const {
        std::ofstream(m_folder / name, std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
        return m_folder / name;
    }
    /// Writes a triangle in a node at x.
    std::filesystem::path writeTriangle(double x) const {
        GltfBuilder b;
        b.show({{"attributes", b.triangle()}});
        b.json["nodes"][0]["translation"] = {x, 0, 0};
        return write("a.glb", b.glb());
    }

    std::filesystem::path m_folder;
};

TEST_F(LoadFolder, AFaultOfTheSettingsIsTheirs) {
    const auto scene = writeTriangle(0);
    const auto settings = write("a.ini", std::string("scene.cameras.0.fov=200\n"));
    const auto loaded = loadScene(scene);
    ASSERT_FALSE(loaded);
    EXPECT_THAT(loaded.error().message, testing::StartsWith(settings.string() + ": "));
}

TEST_F(LoadFolder, AllFilesThatWereReadAreListed) {
    GltfBuilder b;
    const Bytes png = smallPng(2, 2);
    write("a.png", png);
    b.append("images", {{"uri", "a.png"}});
    b.append("textures", {{"source", 0}});
    b.append("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    b.show({{"attributes", b.triangle()}, {"material", 0}});
    const auto scene = write("a.glb", b.glb());
    const auto settings = write("a.ini", std::string("scene.skyColor=1 1 1\n"));
    const auto loaded = loadScene(scene);
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_THAT(loaded->files, testing::UnorderedElementsAre(scene, settings, m_folder / "a.png"));
}

TEST_F(LoadFolder, ASceneFarAwayIsMovedAndSaysSo) {
    const auto far = loadScene(writeTriangle(500'000.5));
    ASSERT_TRUE(far) << far.error().message;
    EXPECT_THAT(far->warnings, testing::ElementsAre(HasSubstr("far from the origin")));
    const Bounds bounds = poseAt(far->scene).bounds;
    EXPECT_EQ(bounds.lower + far->scene.origin, glm::vec3(500'000.5f, 0, 0));
    EXPECT_LT(std::abs(bounds.upper.x), 2);
    const auto near = loadScene(writeTriangle(10));
    ASSERT_TRUE(near);
    EXPECT_THAT(near->warnings, testing::IsEmpty());
    EXPECT_EQ(near->scene.origin, glm::vec3(0.0f));
}

TEST(LoadScene, ErrorsNameTheFile) {
    const auto missing = loadScene("no/such/scene.glb");
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().code, ErrorCode::fileNotFound);
    EXPECT_THAT(missing.error().message, HasSubstr("no/such/scene.glb"));
    const auto folder = loadScene(std::filesystem::temp_directory_path());
    ASSERT_FALSE(folder);
    EXPECT_EQ(folder.error().code, ErrorCode::fileUnreadable);
    const auto empty = loadScene("/dev/null");
    ASSERT_FALSE(empty);
    EXPECT_EQ(empty.error().code, ErrorCode::fileUnreadable);
}

}  // namespace
}  // namespace probegi::test

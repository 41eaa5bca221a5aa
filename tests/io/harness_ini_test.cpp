#include "io/harness_ini.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <sstream>

#include "io/refused.h"

namespace probegi::test {
namespace {

using testing::HasSubstr;

Result<Scene> readSettings(const std::string& text) {
    return io::guarded("test.ini", [&] {
        Scene scene;
        std::istringstream stream(text);
        io::addHarnessSettings(stream, scene);
        return scene;
    });
}

void expectNear(glm::vec3 a, glm::vec3 b) {
    EXPECT_NEAR(glm::distance(a, b), 0.0f, 1e-5f) << a.x << " " << a.y << " " << a.z;
}

TEST(HarnessIni, ReadsLights) {
    const auto scene = readSettings(
        "# comment\nscene.lights.0.name=Ceiling Light\nscene.lights.0.type=2\nscene.lights.0.position=1 2.f 3\n"
        "scene.lights.0.color=1.0 0.5 0.25\nscene.lights.0.power=4\nscene.lights.0.radius=5.0\n"
        "scene.lights.1.type=0\nscene.lights.1.power=0.0\n"
        "scene.lights.2.type=1\nscene.lights.2.direction=0 -3 0\nscene.lights.2.umbraAngle=10\n"
        "scene.lights.2.penumbraAngle=50.0\nscene.lights.3.type=0\nscene.lights.3.direction=0.6 -0.435 -0.816\n");
    ASSERT_TRUE(scene) << scene.error().message;
    ASSERT_EQ(scene->lights.size(), 3u) << "the one without power is off";
    ASSERT_TRUE(validate(*scene));
    const ScenePose pose = poseAt(*scene);
    EXPECT_EQ(scene->lights[0].name, "Ceiling Light");
    EXPECT_EQ(scene->lights[0].type, LightType::point);
    EXPECT_FLOAT_EQ(scene->lights[0].range, 5.0f);
    expectNear(scene->lights[0].intensity, {4, 2, 1});
    expectNear(pose.lights[0].position, {1, 2, 3});
    EXPECT_EQ(scene->lights[1].type, LightType::spot);
    EXPECT_NEAR(scene->lights[1].outerConeAngle, 0.8726646f, 1e-6f);
    EXPECT_NEAR(scene->lights[1].innerConeAngle, 0.1745329f, 1e-6f);
    expectNear(pose.lights[1].direction, {0, -1, 0});
    expectNear(pose.lights[2].direction, glm::normalize(glm::vec3(0.6f, -0.435f, -0.816f)));
}

TEST(HarnessIni, ReadsCameras) {
    const auto scene = readSettings(
        "scene.cameras.0.name=Default Camera\nscene.cameras.0.fov=45\nscene.cameras.0.position=0.1 1.0 4.0\n"
        "scene.cameras.1.yaw=90\nscene.cameras.2.pitch=30\nscene.cameras.2.fov=60\n");
    ASSERT_TRUE(scene) << scene.error().message;
    ASSERT_TRUE(validate(*scene));
    const ScenePose pose = poseAt(*scene);
    ASSERT_EQ(pose.cameras.size(), 3u);
    EXPECT_EQ(pose.cameras[0].name, "Default Camera");
    EXPECT_NEAR(pose.cameras[0].yfov, 0.7853982f, 1e-6f);
    expectNear(pose.cameras[0].position, {0.1f, 1, 4});
    expectNear(pose.cameras[0].forward, {0, 0, -1});
    expectNear(pose.cameras[1].forward, {1, 0, 0});
    expectNear(pose.cameras[2].forward, {0, -0.5f, -0.8660254f});  // positive pitch looks down
    expectNear(pose.cameras[2].up, {0, 0.8660254f, -0.5f});
}

TEST(HarnessIni, ReadsSkyAndGrid) {
    const auto scene = readSettings(
        "scene.skyColor=1.0 0.5 0.0\nscene.skyIntensity=2.f\nddgi.volume.0.origin=0.0 1.0 0.0 # centre\n"
        "ddgi.volume.0.probeCounts=9 5 3\nddgi.volume.0.probeSpacing=0.3 0.5 1\nddgi.volume.1.probeCounts=2 2 2\n");
    ASSERT_TRUE(scene) << scene.error().message;
    expectNear(scene->sky.radiance, {2, 1, 0});
    ASSERT_TRUE(scene->grid);
    EXPECT_EQ(scene->grid->counts, glm::ivec3(9, 5, 3));
    expectNear(scene->grid->spacing, {0.3f, 0.5f, 1});
    expectNear(scene->grid->origin, {-1.2f, 0, -1});
    expectNear(0.5f * (scene->grid->origin + probePosition(*scene->grid, 9 * 5 * 3 - 1)), {0, 1, 0});
}

std::vector<std::string> ignoredOf(const std::string& text) {
    Scene scene;
    std::istringstream stream(text);
    return io::addHarnessSettings(stream, scene);
}

TEST(HarnessIni, ReadsAllVolumesInTheOrderOfTheirNumbers) {
    const auto scene = readSettings(
        "ddgi.volume.10.probeCounts=2 3 4\nddgi.volume.10.probeSpacing=2 2 2\nddgi.volume.10.origin=7 8 9\n"
        "ddgi.volume.0.probeCounts=9 5 3\nddgi.volume.2.probeCounts=5 5 5\n"
        "ddgi.volume.2.origin=1 0 0\nddgi.volume.2.rotation=0 90 0\n");
    ASSERT_TRUE(scene) << scene.error().message;
    ASSERT_TRUE(validate(*scene));
    ASSERT_TRUE(scene->grid);
    EXPECT_EQ(scene->grid->counts, glm::ivec3(9, 5, 3));
    EXPECT_EQ(scene->grid->orientation, glm::quat(1, 0, 0, 0));
    ASSERT_EQ(scene->furtherGrids.size(), 2u);
    const VolumeDesc &turned = scene->furtherGrids[0], &last = scene->furtherGrids[1];
    EXPECT_EQ(last.counts, glm::ivec3(2, 3, 4));
    expectNear(last.origin, {6, 6, 6});
    // About its middle: the first probe, at -2 on all axes before, goes where a quarter turn about y takes it.
    expectNear(turned.origin, {-1, -2, 2});
    expectNear(0.5f * (turned.origin + probePosition(turned, 124)), {1, 0, 0});
    expectNear(probePosition(turned, 1), turned.origin + glm::vec3(0, 0, -1));
}

TEST(HarnessIni, SaysWhatItIgnores) {
    const std::string volume = "ddgi.volume.0.probeCounts=9 5 3\n";
    EXPECT_THAT(ignoredOf(volume + "ddgi.volume.0.infiniteScrolling.enabled=0\nddgi.volume.0.rotation=0 0 0\n"),
                testing::IsEmpty());
    EXPECT_THAT(ignoredOf(volume + "ddgi.volume.1.probeCounts=2 2 2\nddgi.volume.0.rotation=0 0.5 0\n"),
                testing::IsEmpty());
    const auto empty = ignoredOf(volume + "ddgi.volume.10.origin=1 2 3\nddgi.volume.x.name=b\n");
    ASSERT_EQ(empty.size(), 1u);
    EXPECT_THAT(empty[0], HasSubstr("ddgi.volume.10 is ignored: it has no probeCounts"));
    const auto scrolling = ignoredOf(volume + "ddgi.volume.0.infiniteScrolling.enabled=1\n");
    ASSERT_EQ(scrolling.size(), 1u);
    EXPECT_THAT(scrolling[0], HasSubstr("infiniteScrolling.enabled is ignored"));
}

TEST(HarnessIni, OtherSettingsChangeNothing) {
    const auto scene = readSettings("app.width=1920\n[section]\nkey=value\npp.enable=1\njust words\n");
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_TRUE(scene->nodes.empty());
    EXPECT_FALSE(scene->grid);
    EXPECT_TRUE(scene->sky.black());
}

TEST(HarnessIni, BadValuesNameTheirKey) {
    const auto refused = [](const std::string& text, const char* words) {
        const auto scene = readSettings(text);
        ASSERT_FALSE(scene) << text;
        EXPECT_EQ(scene.error().code, ErrorCode::malformed);
        EXPECT_THAT(scene.error().message, HasSubstr(words));
    };
    refused("scene.lights.0.power=bright\n", "scene.lights.0.power has the value 'bright'");
    refused("scene.lights.0.power=1x\n", "1x");
    refused("scene.lights.0.power=1e999\n", "1e999");
    refused("scene.lights.0.power=nan\n", "nan");
    refused("scene.lights.0.type=7\n", "scene.lights.0.type is 7");
    refused("scene.lights.0.color=1 1\n", "needs three");
    refused("scene.lights.0.direction=0 0 0\n", "no direction");
    refused("ddgi.volume.0.probeCounts=1 9 9\n", "probeCounts");
    refused("ddgi.volume.0.probeCounts=1e9 9 9\n", "probeCounts");
    refused("ddgi.volume.3.probeCounts=1 9 9\n", "ddgi.volume.3.probeCounts");
    refused("ddgi.volume.0.probeCounts=9 9 9\nddgi.volume.0.rotation=0 up 0\n", "rotation");
}

}  // namespace
}  // namespace probegi::test

#include <glm/geometric.hpp>

#include "reading.h"

namespace probegi::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(GltfNode, ParentsComeFirst) {
    GltfBuilder b;
    const int mesh = b.show({{"attributes", b.triangle()}});
    b.json["nodes"] = {{{"name", "leaf"}, {"mesh", mesh}, {"translation", {1, 0, 0}}},
                       {{"name", "middle"}, {"children", {0}}, {"scale", {2, 2, 2}}},
                       {{"name", "unused"}, {"mesh", mesh}},
                       {{"name", "root"}, {"children", {1}}, {"translation", {0, 10, 0}}}};
    b.json["scenes"] = {{{"nodes", {3}}}};
    const Scene scene = readClean(b);
    ASSERT_EQ(scene.nodes.size(), 3u) << "what the scene does not show is left out";
    EXPECT_EQ(scene.nodes[0].name, "root");
    EXPECT_EQ(scene.nodes[2].name, "leaf");
    EXPECT_EQ(scene.nodes[2].parent, 1);
    const ScenePose pose = poseAt(scene);
    ASSERT_EQ(pose.instances.size(), 1u);
    EXPECT_EQ(glm::vec3(pose.instances[0].toWorld[3]), glm::vec3(2, 10, 0));
}

TEST(GltfNode, MatrixIsColumnMajor) {
    GltfBuilder b;
    b.show({{"attributes", b.triangle()}});
    b.json["nodes"][0]["matrix"] = {0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 7, 8, 9, 1};
    const Scene scene = readClean(b);
    ASSERT_TRUE(scene.nodes.at(0).matrix);
    const glm::vec4 corner = *scene.nodes[0].matrix * glm::vec4(1, 0, 0, 1);
    EXPECT_EQ(corner, glm::vec4(7, 9, 9, 1));
}

TEST(GltfNode, ShowsTheDefaultScene) {
    GltfBuilder b;
    b.show({{"attributes", b.triangle()}});
    b.append("nodes", {{"name", "second"}});
    b.append("scenes", {{"nodes", {1}}});
    b.json["scene"] = 1;
    EXPECT_EQ(readClean(b).nodes.at(0).name, "second");
    b.json.erase("scene");
    EXPECT_EQ(readClean(b).nodes.at(0).mesh, 0);
    b.json.erase("scenes");
    EXPECT_EQ(readClean(b).nodes.size(), 2u) << "without scenes, every root is shown";
}

TEST(GltfNode, RefusesBrokenHierarchies) {
    GltfBuilder b;
    b.json["nodes"] = {{{"children", {1}}}, {{"children", {0}}}};
    b.json["scenes"][0]["nodes"] = {0};
    expectRefused(b, ErrorCode::malformed, "cycle");
    b.json.erase("scenes");
    expectRefused(b, ErrorCode::malformed, "cycle");
    b.json["scenes"] = {{{"nodes", {0, 1}}}};
    b.json["nodes"] = {{{"children", {1}}}, nlohmann::json::object()};
    expectRefused(b, ErrorCode::malformed, "two parents");
    b.json["nodes"] = {{{"children", {7}}}, nlohmann::json::object()};
    expectRefused(b, ErrorCode::malformed, "node 7");
    b.json["nodes"] = {{{"children", {-1}}}, nlohmann::json::object()};
    expectRefused(b, ErrorCode::malformed, "node -1");
}

TEST(GltfNode, DeepHierarchiesDoNotOverflowTheStack) {
    GltfBuilder b;
    constexpr int kDepth = 100'000;
    for (int i = 0; i + 1 < kDepth; ++i) b.json["nodes"].push_back({{"children", {i + 1}}});
    b.json["nodes"].push_back(nlohmann::json::object());
    b.json["scenes"][0]["nodes"] = {0};
    EXPECT_EQ(readClean(b).nodes.size(), std::size_t(kDepth));
}

TEST(GltfNode, RotationsAreMadeUnit) {
    GltfBuilder b;
    b.json["nodes"] = {{{"rotation", {0, 0.6, 0, 0.81}}}, {{"rotation", {0, 0, 0, 0}}}};
    b.json["scenes"][0]["nodes"] = {0, 1};
    const auto loaded = read(b);
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_NEAR(glm::length(loaded->scene.nodes[0].rotation), 1.0f, 1e-6f);
    EXPECT_EQ(loaded->scene.nodes[1].rotation, glm::quat(1, 0, 0, 0));
    EXPECT_THAT(loaded->warnings, ElementsAre(HasSubstr("quaternion")));
}

TEST(GltfNode, ReadsLights) {
    GltfBuilder b;
    b.json["extensionsUsed"] = {"KHR_lights_punctual"};
    b.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "directional"}, {"intensity", 20}, {"color", {1, 0.5, 0.25}}, {"name", "sun"}},
        {{"type", "point"}},
        {{"type", "spot"}, {"range", 5}, {"spot", {{"innerConeAngle", 0.1}, {"outerConeAngle", 0.2}}}},
        {{"type", "spot"}, {"spot", nlohmann::json::object()}}};
    for (int light = 0; light < 4; ++light) {
        const int node = b.append("nodes", {{"extensions", {{"KHR_lights_punctual", {{"light", light}}}}},
                                            {"rotation", {-0.70710678, 0, 0, 0.70710678}}});
        b.json["scenes"][0]["nodes"].push_back(node);
    }
    const Scene scene = readClean(b);
    ASSERT_EQ(scene.lights.size(), 4u);
    EXPECT_EQ(scene.lights[0].type, LightType::directional);
    EXPECT_EQ(scene.lights[0].name, "sun");
    EXPECT_EQ(scene.lights[0].intensity, glm::vec3(20, 10, 5));
    EXPECT_EQ(scene.lights[1].intensity, glm::vec3(1)) << "the default of glTF";
    EXPECT_EQ(scene.lights[1].range, 0.0f) << "unlimited";
    EXPECT_EQ(scene.lights[2].type, LightType::spot);
    EXPECT_FLOAT_EQ(scene.lights[2].innerConeAngle, 0.1f);
    EXPECT_FLOAT_EQ(scene.lights[2].outerConeAngle, 0.2f);
    EXPECT_FLOAT_EQ(scene.lights[2].range, 5.0f);
    EXPECT_FLOAT_EQ(scene.lights[3].outerConeAngle, 0.785398163f);
    const ScenePose pose = poseAt(scene);
    EXPECT_NEAR(glm::distance(pose.lights.at(0).direction, glm::vec3(0, -1, 0)), 0, 1e-6f);
}

TEST(GltfNode, DropsLightsItCannotUseAndLimitsOthers) {
    GltfBuilder b;
    b.json["extensionsUsed"] = {"KHR_lights_punctual"};
    b.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "area"}},
        {{"type", "spot"}, {"intensity", -3}, {"spot", {{"innerConeAngle", 3}, {"outerConeAngle", 2}}}}};
    for (int light = 0; light < 2; ++light) {
        b.append("nodes", {{"extensions", {{"KHR_lights_punctual", {{"light", light}}}}}});
        b.json["scenes"][0]["nodes"].push_back(light);
    }
    const auto loaded = read(b);
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded->scene.lights.size(), 1u);
    EXPECT_EQ(loaded->scene.nodes[0].light, -1);
    EXPECT_EQ(loaded->scene.nodes[1].light, 0);
    EXPECT_EQ(loaded->warnings.size(), 3u);
    b.json["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 2;
    expectRefused(b, ErrorCode::malformed, "light 2");
}

TEST(GltfNode, ReadsPerspectiveCamerasOnly) {
    GltfBuilder b;
    b.json["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 0.8}, {"znear", 0.1}}}},
        {{"type", "orthographic"}, {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"znear", 0.1}, {"zfar", 9}}}}};
    b.json["nodes"] = {{{"camera", 1}}, {{"camera", 0}, {"name", "eye"}}};
    b.json["scenes"][0]["nodes"] = {0, 1};
    const auto loaded = read(b);
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_THAT(loaded->warnings, ElementsAre(HasSubstr("orthographic")));
    ASSERT_EQ(loaded->scene.cameras.size(), 1u);
    EXPECT_FLOAT_EQ(loaded->scene.cameras[0].yfov, 0.8f);
    EXPECT_EQ(loaded->scene.cameras[0].name, "eye") << "named after its node where it has no name";
    EXPECT_EQ(loaded->scene.nodes[0].camera, -1);
    EXPECT_EQ(loaded->scene.nodes[1].camera, 0);
}

TEST(GltfNode, ACameraInTwoPlacesHasTwoNames) {
    GltfBuilder b;
    b.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.8}, {"znear", 0.1}}}}};
    b.json["nodes"] = {{{"camera", 0}, {"name", "hall"}}, {{"camera", 0}, {"name", "garden"}}, {{"camera", 0}}};
    b.json["scenes"][0]["nodes"] = {0, 1, 2};
    const auto loaded = read(b);
    ASSERT_TRUE(loaded) << loaded.error().message;
    const ScenePose pose = poseAt(loaded->scene);
    ASSERT_EQ(pose.cameras.size(), 3u);
    EXPECT_EQ(pose.cameras[0].name, "hall");
    EXPECT_EQ(pose.cameras[1].name, "garden");
    EXPECT_EQ(pose.cameras[2].name, "hall") << "a node without a name leaves the camera's";
    EXPECT_FLOAT_EQ(pose.cameras[1].yfov, 0.8f);
}

TEST(GltfNode, SkinsKeepTheRestPose) {
    GltfBuilder b;
    b.show({{"attributes", b.triangle()}});
    b.json["nodes"][0]["skin"] = 0;
    b.json["skins"] = {{{"joints", {0}}}};
    const auto loaded = read(b);
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_THAT(loaded->warnings, ElementsAre(HasSubstr("skin")));
}

}  // namespace
}  // namespace probegi::test

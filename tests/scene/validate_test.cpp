#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "scene/mesh_checks.h"

namespace probegi {
namespace {

using ::testing::HasSubstr;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// One of everything, all valid.
Scene fullScene() {
    Scene s = test::sceneOf(test::triangle());
    s.meshes[0].name = "wall";
    s.materials[0].name = "brick";
    Primitive& p = s.meshes[0].primitives[0];
    p.normals.assign(3, {0, 0, 1});
    p.tangents.assign(3, {1, 0, 0, 1});
    p.uv0.assign(3, {0, 0});
    p.uv1.assign(3, {0, 0});
    s.images.push_back({2, 2, std::vector<std::uint8_t>(16), "image"});
    s.materials[0].baseColorTexture.image = 0;
    s.lights.emplace_back().name = "lamp";
    s.lights[0].type = LightType::spot;
    s.cameras.emplace_back().name = "front";
    s.nodes[0].name = "root";
    s.nodes[0].light = 0;
    s.nodes[0].camera = 0;
    AnimationChannel channel;
    channel.node = 0;
    channel.times = {0, 1};
    channel.values = {{0, 0, 0, 0}, {1, 0, 0, 0}};
    s.animations.push_back(channel);
    s.sky.radiance = {1, 1, 1};
    s.sky.image = HdrImage(2, 1, {1, 1, 1});
    s.grid = VolumeDesc{};
    return s;
}

struct Defect {
    const char* name;
    void (*apply)(Scene&);
    std::vector<const char*> sentence;  ///< parts of the message
};

Primitive& primitive(Scene& s) {
    return s.meshes[0].primitives[0];
}

const Defect kDefects[] = {
    {"imageSize", [](Scene& s) { s.images[0].width = 0; }, {"image 0 'image'", "0 x 2"}},
    {"imageBytes", [](Scene& s) { s.images[0].rgba.pop_back(); }, {"image 0", "15 bytes", "needs 16"}},
    {"baseColourRange", [](Scene& s) { s.materials[0].baseColor.y = 1.5f; }, {"material 0 'brick'", "1.5", "0..1"}},
    {"baseColourNan", [](Scene& s) { s.materials[0].baseColor.w = kNan; }, {"material 0", "base colour"}},
    {"metallic", [](Scene& s) { s.materials[0].metallic = -1; }, {"material 0", "metallic -1"}},
    {"roughness", [](Scene& s) { s.materials[0].roughness = 2; }, {"material 0", "roughness 2"}},
    {"emission", [](Scene& s) { s.materials[0].emission.z = -3; }, {"material 0", "emission", "-3"}},
    {"emissionTooBright", [](Scene& s) { s.materials[0].emission.z = 3e38f; }, {"material 0", "emission", "1e+20"}},
    {"emissionInfinite", [](Scene& s) { s.materials[0].emission.z = kInfinity; }, {"material 0", "emission", "inf"}},
    {"normalScale", [](Scene& s) { s.materials[0].normalScale = kNan; }, {"material 0", "normal scale"}},
    {"alphaCutoff", [](Scene& s) { s.materials[0].alphaCutoff = 7; }, {"material 0", "alpha cutoff 7"}},
    {"baseColourImage",
     [](Scene& s) { s.materials[0].baseColorTexture.image = 1; },
     {"base colour texture uses image 1"}},
    {"metallicImage", [](Scene& s) { s.materials[0].metallicRoughnessTexture.image = -2; }, {"uses image -2"}},
    {"normalUvSet", [](Scene& s) { s.materials[0].normalTexture.texCoord = 2; }, {"normal texture uses uv set 2"}},
    {"emissiveUv", [](Scene& s) { s.materials[0].emissiveTexture.uvTransform[2][0] = kNan; }, {"emissive texture"}},
    {"material", [](Scene& s) { primitive(s).material = 1; }, {"mesh 0 'wall', primitive 0", "material 1", "has 1"}},
    {"materialNegative", [](Scene& s) { primitive(s).material = -1; }, {"mesh 0", "material -1"}},
    {"positionNan", [](Scene& s) { primitive(s).positions[2].y = kNan; }, {"mesh 0", "vertex 2", "positions"}},
    {"positionFar", [](Scene& s) { primitive(s).positions[1].x = 1e30f; }, {"mesh 0", "vertex 1", "too far"}},
    {"normalsLength", [](Scene& s) { primitive(s).normals.pop_back(); }, {"mesh 0", "2 normals for 3 positions"}},
    {"normalNan", [](Scene& s) { primitive(s).normals[0].x = kNan; }, {"vertex 0", "normals"}},
    {"tangentsLength", [](Scene& s) { primitive(s).tangents.emplace_back(); }, {"4 tangents for 3"}},
    {"uv0Length", [](Scene& s) { primitive(s).uv0.pop_back(); }, {"2 uv0"}},
    {"uv1Nan", [](Scene& s) { primitive(s).uv1[1].x = kInfinity; }, {"vertex 1", "uv1"}},
    {"indexCount", [](Scene& s) { primitive(s).indices.push_back(0); }, {"4 indices", "whole number of triangles"}},
    {"index", [](Scene& s) { primitive(s).indices[2] = 3; }, {"index 2 is vertex 3", "there are 3"}},
    {"lightIntensity", [](Scene& s) { s.lights[0].intensity.x = -1; }, {"light 0 'lamp'", "intensity (-1"}},
    {"lightRange", [](Scene& s) { s.lights[0].range = kNan; }, {"light 0", "range"}},
    {"lightOuterCone", [](Scene& s) { s.lights[0].outerConeAngle = 2; }, {"light 0", "outer cone angle 2"}},
    {"lightNoCone", [](Scene& s) { s.lights[0].outerConeAngle = 0; }, {"light 0", "outer cone angle 0"}},
    {"lightInnerCone", [](Scene& s) { s.lights[0].innerConeAngle = 1; }, {"light 0", "inner cone angle 1"}},
    {"cameraFov", [](Scene& s) { s.cameras[0].yfov = 4; }, {"camera 0 'front'", "4"}},
    {"cameraNoFov", [](Scene& s) { s.cameras[0].yfov = 0; }, {"camera 0", "above 0"}},
    {"cameraNear", [](Scene& s) { s.cameras[0].znear = -1; }, {"camera 0", "near plane -1"}},
    {"parentItself", [](Scene& s) { s.nodes[0].parent = 0; }, {"node 0 'root'", "parent 0"}},
    {"parentNegative", [](Scene& s) { s.nodes[0].parent = -2; }, {"node 0", "parent -2"}},
    {"translation", [](Scene& s) { s.nodes[0].translation.x = kNan; }, {"node 0", "translation"}},
    {"scale", [](Scene& s) { s.nodes[0].scale.x = kInfinity; }, {"node 0", "scale"}},
    {"rotation", [](Scene& s) { s.nodes[0].rotation = glm::quat(0, 0, 0, 0); }, {"node 0", "rotation", "not zero"}},
    {"matrixNan", [](Scene& s) { s.nodes[0].matrix = glm::mat4(kNan); }, {"node 0", "matrix"}},
    {"matrixPerspective", [](Scene& s) { s.nodes[0].matrix = glm::mat4(2); }, {"node 0", "last row", "(0, 0, 0, 2)"}},
    {"nodeMesh", [](Scene& s) { s.nodes[0].mesh = 1; }, {"node 0", "mesh 1", "has 1"}},
    {"nodeLight", [](Scene& s) { s.nodes[0].light = -5; }, {"node 0", "light -5"}},
    {"nodeCamera", [](Scene& s) { s.nodes[0].camera = 2; }, {"node 0", "camera 2"}},
    {"channelNode", [](Scene& s) { s.animations[0].node = 1; }, {"animation channel 0", "node 1"}},
    {"channelEmpty", [](Scene& s) { s.animations[0].times.clear(); }, {"animation channel 0", "no keyframe"}},
    {"channelOrder", [](Scene& s) { s.animations[0].times[1] = 0; }, {"key 1 at 0 s", "after key 0"}},
    {"channelTimeNan", [](Scene& s) { s.animations[0].times[1] = kNan; }, {"time of key 1"}},
    {"channelLength", [](Scene& s) { s.animations[0].values.pop_back(); }, {"1 values for 2 keys"}},
    {"channelSplineLength",
     [](Scene& s) { s.animations[0].interpolation = Interpolation::cubicSpline; },
     {"2 values for 2 keys", "3 a key"}},
    {"channelValueNan", [](Scene& s) { s.animations[0].values[1].x = kNan; }, {"value 1 is not finite"}},
    {"channelZeroRotation",
     [](Scene& s) { s.animations[0].path = AnimationPath::rotation; },
     {"value 0 is a rotation of length zero"}},
    {"skyTooBright", [](Scene& s) { s.sky.radiance.y = 3e38f; }, {"sky", "1e+20"}},
    {"skyImageTooBright", [](Scene& s) { s.sky.image.pixels[1].x = 3e38f; }, {"sky image", "pixel 1", "1e+20"}},
    {"skyFactorTooBright",
     [](Scene& s) {
         s.sky.image.pixels[1].x = 1e15f;
         s.sky.radiance.x = 1e15f;
     },
     {"sky image", "pixel 1"}},
    {"skyRadiance", [](Scene& s) { s.sky.radiance.y = -1; }, {"sky", "radiance"}},
    {"skyPixels", [](Scene& s) { s.sky.image.pixels.pop_back(); }, {"sky image", "1 pixels", "2 x 1"}},
    {"skyPixelNan", [](Scene& s) { s.sky.image.pixels[1].x = kNan; }, {"sky image", "pixel 1"}},
    {"exposure", [](Scene& s) { s.exposure = 0; }, {"exposure 0"}},
    {"gridOrigin", [](Scene& s) { s.grid->origin.x = kNan; }, {"probe grid", "origin"}},
    {"gridSpacing", [](Scene& s) { s.grid->spacing.y = 0; }, {"probe grid", "spacing"}},
    {"gridCount", [](Scene& s) { s.grid->counts.z = 1; }, {"probe grid", "1 probes along axis z"}},
    {"secondGrid",
     [](Scene& s) {
         s.furtherGrids = {VolumeDesc{}, VolumeDesc{}};
         s.furtherGrids[1].spacing.x = -1;
     },
     {"probe grid 2", "spacing"}},
    {"gridsTotal",
     [](Scene& s) {
         s.furtherGrids.assign(5, VolumeDesc{});
         for (VolumeDesc& grid : s.furtherGrids) grid.counts = glm::ivec3(150);
     },
     {"probe grid 5", "2^24"}},
    {"gridsWithoutAFirst",
     [](Scene& s) {
         s.grid.reset();
         s.furtherGrids = {VolumeDesc{}};
     },
     {"without a first"}},
    {"tooManyGrids", [](Scene& s) { s.furtherGrids.assign(32, VolumeDesc{}); }, {"33 probe grids"}},
    {"gridTotal", [](Scene& s) { s.grid->counts = glm::ivec3(1024, 1024, 17); }, {"probe grid", "17825792", "2^24"}},
    {"worldOverflow", [](Scene& s) { s.nodes[0].scale = glm::vec3(1e20f); }, {"node 0", "too large"}},
    {"worldTooFar", [](Scene& s) { s.nodes[0].scale = glm::vec3(1e12f); }, {"coordinates beyond"}},
};

class ValidateTest : public ::testing::TestWithParam<Defect> {};

TEST_P(ValidateTest, NamesTheFirstThingThatIsWrong) {
    Scene scene = fullScene();
    ASSERT_TRUE(validate(scene));
    GetParam().apply(scene);
    const Result<void> result = validate(scene);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::malformed);
    for (const char* part : GetParam().sentence) EXPECT_THAT(result.error().message, HasSubstr(part));
}

INSTANTIATE_TEST_SUITE_P(Defects, ValidateTest, ::testing::ValuesIn(kDefects),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(Validate, AcceptsAnEmptyScene) {
    EXPECT_TRUE(validate(Scene{}));
}

TEST(Validate, AcceptsAMeshWithoutTriangles) {
    EXPECT_TRUE(validate(test::sceneOf(Primitive{})));
}

TEST(Validate, LeavesTheLengthOfNormalsToTheirReaders) {
    Scene scene = fullScene();
    primitive(scene).normals[0] = {0, 0, 0};
    EXPECT_TRUE(validate(scene));
}

}  // namespace
}  // namespace probegi

#include "reading.h"

namespace probegi::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// A node "a" and an animation with one channel.
GltfBuilder animated(const char* path, const char* interpolation, int times, int values) {
    GltfBuilder b;
    b.json["nodes"] = {{{"name", "a"}}, {{"name", "b"}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}}};
    b.json["scenes"][0]["nodes"] = {0, 1};
    b.append("animations", {{"samplers", {{{"input", times}, {"output", values}, {"interpolation", interpolation}}}},
                            {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", path}}}}}}});
    return b;
}
void addData(GltfBuilder& b, const std::vector<float>& times, const std::vector<float>& values, const char* type) {
    b.addFloats(times, "SCALAR");
    b.addFloats(values, type);
}

TEST(GltfAnimation, ReadsAllInterpolationsAndPaths) {
    const Scene scene = readClean(richScene());
    ASSERT_EQ(scene.animations.size(), 3u);
    const AnimationChannel& turn = scene.animations[0];
    EXPECT_EQ(turn.path, AnimationPath::rotation);
    EXPECT_EQ(turn.interpolation, Interpolation::linear);
    EXPECT_EQ(turn.values.at(1), glm::vec4(0, 1, 0, 0)) << "normalised shorts";
    EXPECT_EQ(scene.nodes.at(std::size_t(turn.node)).camera, 0) << "renumbered like the nodes";
    const AnimationChannel& move = scene.animations[1];
    EXPECT_EQ(move.path, AnimationPath::translation);
    EXPECT_EQ(move.interpolation, Interpolation::step);
    EXPECT_THAT(move.times, ElementsAre(0, 1));
    EXPECT_EQ(move.values.at(1), glm::vec4(1, 2, 3, 0));
    EXPECT_EQ(scene.animations[2].path, AnimationPath::scale);
    EXPECT_EQ(scene.animations[2].interpolation, Interpolation::cubicSpline);
    EXPECT_EQ(scene.animations[2].values.size(), 6u);
}

TEST(GltfAnimation, SplineTangentsAreNotNormalised) {
    GltfBuilder b = animated("rotation", "CUBICSPLINE", 0, 1);
    addData(b, {0}, {5, 0, 0, 0, 0, 0, 0, 2, 0, 0, 0, 0}, "VEC4");
    const Scene scene = readClean(b);
    ASSERT_EQ(scene.animations.size(), 1u);
    EXPECT_THAT(scene.animations[0].values, ElementsAre(glm::vec4(5, 0, 0, 0), glm::vec4(0, 0, 0, 1), glm::vec4(0)));
}

TEST(GltfAnimation, WarnsOfWhatStaysStill) {
    GltfBuilder b = animated("translation", "LINEAR", 0, 1);
    addData(b, {0, 1}, {0, 0, 0, 1, 1, 1}, "VEC3");
    b.json["animations"][0]["channels"].push_back({{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}});
    b.json["animations"][0]["channels"].push_back({{"sampler", 0}, {"target", {{"node", 1}, {"path", "scale"}}}});
    b.json["animations"].push_back(b.json["animations"][0]);
    b.json["animations"][1]["channels"].erase(2);
    b.json["animations"][1]["channels"].erase(1);
    const auto loaded = read(b);
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded->scene.animations.size(), 1u);
    EXPECT_THAT(loaded->warnings, ElementsAre(HasSubstr("morph"), HasSubstr("matrix"), HasSubstr("another channel")));
}

TEST(GltfAnimation, RefusesBrokenKeys) {
    const auto expect = [](const std::vector<float>& times, const std::vector<float>& values, const char* words) {
        GltfBuilder b = animated("translation", "LINEAR", 0, 1);
        addData(b, times, values, "VEC3");
        expectRefused(b, ErrorCode::malformed, words);
    };
    expect({0, 1}, {0, 0, 0}, "1 values for 2 keys");
    expect({0, 0}, {0, 0, 0, 1, 1, 1}, "must increase");
    expect({0, NAN}, {0, 0, 0, 1, 1, 1}, "must increase");
    expect({0}, {0, INFINITY, 0}, "not finite");
    GltfBuilder b = animated("rotation", "LINEAR", 0, 1);
    addData(b, {0}, {0, 0, 0, 0}, "VEC4");
    expectRefused(b, ErrorCode::malformed, "not a rotation");
    b = animated("rotation", "LINEAR", 0, 9);
    addData(b, {0}, {0, 0, 0, 1}, "VEC4");
    expectRefused(b, ErrorCode::malformed, "accessor 9");
    b = animated("rotation", "LINEAR", 0, 1);
    addData(b, {0}, {0, 0, 0}, "VEC3");
    expectRefused(b, ErrorCode::malformed, "3 components");
}

}  // namespace
}  // namespace probegi::test

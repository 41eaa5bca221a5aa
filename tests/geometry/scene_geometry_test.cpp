// Which meshes are merged, which are placed.
#include "geometry/scene_geometry.h"

#include "tracer/tracer_scene.h"

namespace probegi::test {

namespace {

const glm::mat4 kAside = glm::translate(glm::mat4(1.0f), {5, 0, 0});
const glm::mat4 kFlat = glm::scale(glm::mat4(1.0f), {1, 1, 0});

/// Three root nodes, the second with a child; each has a mesh of its own.
Scene hierarchy() {
    TestScene s;
    for (const int parent : {-1, -1, 1, -1}) {
        Node node;
        node.parent = parent;
        node.mesh = s.addMesh(quad());
        s.scene.addNode(node);
    }
    return s.scene;
}

AnimationChannel slide(int node) {
    return {node, AnimationPath::translation, Interpolation::linear, {0.0f, 1.0f}, {{0, 0, 0, 0}, {1, 0, 0, 0}}};
}

}  // namespace

TEST(SceneGeometry, MergesMeshesPlacedOnceAndPlacesTheOthers) {
    TestScene s;
    s.add(quad(), kAside);
    const int shared = s.addMesh(quad());
    s.place(shared);
    s.place(shared, kAside);
    const SceneGeometry g = SceneGeometry::gather(s.scene, s.pose);
    EXPECT_EQ(g.world.opaque.triangles.size(), 2u);
    EXPECT_EQ(g.world.opaque.vertices[0].position, glm::vec3(4, 0, -1));
    ASSERT_EQ(g.groups.size(), 1u);
    EXPECT_EQ(g.groups[0].opaque.vertices[0].position, glm::vec3(-1, 0, -1));
    ASSERT_EQ(g.placements.size(), 2u);
    EXPECT_EQ(g.placements[1].toWorld, kAside);
    EXPECT_EQ(&g.group(g.placements[1]), &g.groups[0]);
}

TEST(SceneGeometry, AppliesWhatCannotBeUndone) {
    TestScene s;
    const int shared = s.addMesh(quad());
    s.place(shared);
    s.place(shared, kFlat);
    const auto everything = [](const Instance&) { return true; };
    for (const InstancePredicate& movable : {InstancePredicate(), InstancePredicate(everything)}) {
        const SceneGeometry g = SceneGeometry::gather(s.scene, s.pose, movable);
        EXPECT_EQ(g.placements.size(), 1u);
        ASSERT_EQ(g.world.opaque.triangles.size(), 2u);
        EXPECT_EQ(g.world.opaque.vertices[0].position, glm::vec3(-1, 0, 0));
    }
}

TEST(SceneGeometry, BoundsAreTheTracers) {
    TestScene s;
    EXPECT_EQ(SceneGeometry::gather(s.scene, s.pose).bounds().size(), glm::vec3(0));
    const int shared = s.addMesh(quad());
    s.place(shared, glm::rotate(kAside, 0.7f, {0.6f, 0.0f, 0.8f}));
    s.place(shared, glm::scale(kAside, {-2, 1, 3}));
    for (const bool withWorld : {false, true}) {
        if (withWorld) s.add(quad(), glm::translate(glm::mat4(1.0f), {0, -7, 0}));
        const Bounds ours = SceneGeometry::gather(s.scene, s.pose).bounds(),
                     tracers = trace(tracerMakers().front(), s)->bounds();
        expectNear(ours.lower, tracers.lower, 1e-5f);
        expectNear(ours.upper, tracers.upper, 1e-5f);
    }
}

TEST(SceneGeometry, KeepsApartWhatAnimationsMove) {
    Scene scene = hierarchy();
    scene.animations = {slide(1)};
    const SceneGeometry g = SceneGeometry::gather(scene, poseAt(scene), animatedInstances(scene));
    ASSERT_EQ(g.placements.size(), 2u);
    EXPECT_EQ(g.placements[0].node, 1);
    EXPECT_EQ(g.placements[1].node, 2) << "moved by its parent";
    EXPECT_EQ(g.world.opaque.triangles.size(), 4u);
    EXPECT_TRUE(SceneGeometry::gather(scene, poseAt(scene)).placements.empty()) << "unless nobody asks";
}

TEST(SceneGeometry, KeepsApartWhatAnEngineMovesItself) {
    Scene scene = hierarchy();
    scene.animations = {slide(3)};
    const std::vector<int> nodes{1};
    const auto moved = [&](bool animated) {
        std::vector<int> result;
        for (const Placement& placement :
             SceneGeometry::gather(scene, poseAt(scene), movableInstances(scene, animated, nodes)).placements)
            result.push_back(placement.node);
        return result;
    };
    EXPECT_EQ(moved(false), (std::vector<int>{1, 2})) << "the node and its child, not what is animated";
    EXPECT_EQ(moved(true), (std::vector<int>{1, 2, 3}));
}

TEST(SceneGeometry, KeepsApartWhatThePredicateNames) {
    const Scene scene = hierarchy();
    const SceneGeometry g =
        SceneGeometry::gather(scene, poseAt(scene), [](const Instance& instance) { return instance.node == 3; });
    ASSERT_EQ(g.placements.size(), 1u);
    EXPECT_EQ(g.placements[0].node, 3);
    EXPECT_FALSE(animatedInstances(scene)(poseAt(scene).instances[3]));
}

}  // namespace probegi::test

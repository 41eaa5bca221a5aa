#include "probegi/shapes.h"
#include "sdf_scene.h"
#include "support/sdf_tracers.h"
#include "tracer_scene.h"

namespace probegi::test {
namespace {

using SdfPose = EverySdfTracer;

// A scene with a node 'door' that has a mesh, and a node 'hinge' that has none.
Scene sceneWithADoor() {
    Scene scene;
    scene.materials.emplace_back();
    Primitive door;
    addBox(door, {-1, -1, -1}, {1, 1, 1});
    addObject(scene, door, "door");
    Node hinge;
    hinge.name = "hinge";
    scene.addNode(hinge);
    return scene;
}

SdfScene riding(const char* node) {
    SdfPrimitive box = sdfBox({-1, -1, -1}, {1, 1, 1});
    box.name = "panel";
    box.node = node;
    return {{sdfSphere({50, 0, 0}, 1), box}};
}

TEST_P(SdfPose, primitivesRideOnNodes) {
    Scene scene = sceneWithADoor();
    scene.nodes[0].translation = {3, 0, 0};
    const auto tracer = make(riding("door"), scene);
    const Ray ray = rayAlong({0, 0, 0}, {1, 0, 0});
    EXPECT_NEAR(shoot(*tracer, ray).hit.distance, 2, 1e-5);
    scene.nodes[0].translation = {10, 0, 0};
    scene.nodes[0].rotation = glm::angleAxis(0.78539816f, glm::vec3(0, 1, 0));
    scene.nodes[0].scale = glm::vec3(2);
    tracer->setPose(poseAt(scene)).value();
    EXPECT_NEAR(shoot(*tracer, ray).hit.distance, 10 - 2 * std::sqrt(2.0f), 1e-4);
    EXPECT_NEAR(tracer->bounds().lower.x, 10 - 2 * std::sqrt(2.0f), 1e-4);
}

TEST_P(SdfPose, refusesNodesOnWhichNothingCanRide) {
    const auto fault = [&](const SdfScene& sdf, const Scene& scene) {
        const auto made = GetParam().make(makeContext(), sdf, scene, poseAt(scene));
        EXPECT_FALSE(made);
        return made ? std::string() : made.error().message;
    };
    Scene scene = sceneWithADoor();
    EXPECT_EQ(fault(riding("dor"), scene),
              "primitive 1 'panel' rides on node 'dor', which the scene does not have; correct the name or remove it");
    EXPECT_EQ(fault(riding("hinge"), scene),
              "primitive 1 'panel' rides on node 'hinge', which has no mesh; name the node whose mesh it stands for");
    scene.nodes[0].scale = {1, 2, 1};
    EXPECT_THAT(fault(riding("door"), scene), testing::HasSubstr("is not scaled alike along all axes"));
    SdfScene broken = riding("");
    broken.primitives[1].halfSize.x = -1;
    EXPECT_THAT(fault(broken, scene), testing::HasSubstr("half size along x -1"));
}

TEST_P(SdfPose, aRefusedPoseChangesNothing) {
    Scene scene = sceneWithADoor();
    const auto tracer = make(riding("door"), scene);
    scene.nodes[0].translation = {10, 0, 0};
    scene.nodes[0].scale = {1, 2, 1};
    EXPECT_FALSE(tracer->setPose(poseAt(scene)));
    EXPECT_FALSE(tracer->setPose(ScenePose{}));
    EXPECT_NEAR(shoot(*tracer, rayAlong({-5, 0, 0}, {1, 0, 0})).hit.distance, 4, 1e-5);
}

INSTANTIATE_TEST_SUITE_P(All, SdfPose, testing::ValuesIn(sdfTracerMakers()), nameOf<SdfTracerMaker>);

}  // namespace
}  // namespace probegi::test

#pragma once

#include "probegi/context.h"
#include "probegi/scene.h"
#include "probegi/sdf.h"
#include "probegi/sdf_fit.h"
#include "probegi/shapes.h"
#include "probegi/tracer.h"

namespace probegi::test {

/// A scene of boxes, traced.
struct BoxScene {
    Scene scene;
    ScenePose pose;
    std::unique_ptr<Tracer> tracer;

    explicit BoxScene(const Scene& made) : scene(made), pose(poseAt(scene)) {
        tracer = makeEmbreeTracer(Context::create().value(), scene, pose).value();
    }
};

inline int addMaterial(Scene& scene, const char* name, glm::vec3 colour, glm::vec3 emission = glm::vec3(0.0f)) {
    Material material;
    material.name = name;
    material.baseColor = glm::vec4(colour, 1.0f);
    material.emission = emission;
    scene.materials.push_back(material);
    return int(scene.materials.size()) - 1;
}

inline void addSolidBox(Scene& scene, int material, glm::vec3 lower, glm::vec3 upper) {
    Primitive box;
    box.material = material;
    addBox(box, lower, upper);
    addObject(scene, box);
}

/// A room of 6 x 3 x 5 m inside, with walls of 0.2 m, and in the wall at +X, if asked for, a window of 2 x 1 m. Its
/// camera stands inside.
inline Scene roomScene(bool window) {
    Scene scene;
    const int wall = addMaterial(scene, "wall", {0.7f, 0.6f, 0.5f});
    const int floor = addMaterial(scene, "floor", {0.2f, 0.3f, 0.1f});
    addSolidBox(scene, floor, {-0.2f, -0.2f, -0.2f}, {6.2f, 0, 5.2f});
    addSolidBox(scene, wall, {-0.2f, 3, -0.2f}, {6.2f, 3.2f, 5.2f});
    addSolidBox(scene, wall, {-0.2f, 0, -0.2f}, {0, 3, 5.2f});
    addSolidBox(scene, wall, {0, 0, -0.2f}, {6.2f, 3, 0});
    addSolidBox(scene, wall, {0, 0, 5}, {6.2f, 3, 5.2f});
    if (window) {
        addSolidBox(scene, wall, {6, 0, 0}, {6.2f, 1, 5});
        addSolidBox(scene, wall, {6, 2, 0}, {6.2f, 3, 5});
        addSolidBox(scene, wall, {6, 1, 0}, {6.2f, 2, 1.5f});
        addSolidBox(scene, wall, {6, 1, 3.5f}, {6.2f, 2, 5});
    } else {
        addSolidBox(scene, wall, {6, 0, 0}, {6.2f, 3, 5});
    }
    scene.cameras.push_back({});
    Node camera;
    camera.translation = {2, 1.5f, 2};
    camera.camera = 0;
    scene.addNode(camera);
    return scene;
}

/// The scene turned about the vertical.
inline Scene turned(Scene scene, float degrees) {
    const glm::quat turn = glm::angleAxis(glm::radians(degrees), glm::vec3(0, 1, 0));
    for (Node& node : scene.nodes) {
        node.translation = turn * node.translation;
        node.rotation = turn * node.rotation;
    }
    return scene;
}

/// Small enough for tests.
inline SdfFitDesc quickFit(int primitives) {
    SdfFitDesc desc;
    desc.maxPrimitives = primitives;
    desc.rays = 24'000;
    desc.rounds = 2;
    return desc;
}

inline SdfPrimitive boxBetween(glm::vec3 lower, glm::vec3 upper) {
    SdfPrimitive box;
    box.centre = 0.5f * (lower + upper);
    box.halfSize = 0.5f * (upper - lower);
    return box;
}

}  // namespace probegi::test

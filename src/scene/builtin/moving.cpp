#include "scene/builtin/box_solid.h"
#include "scene/builtin/builtin.h"
#include "scene/builtin/scene_parts.h"

namespace probegi::builtin {

namespace {

constexpr float kHalf = 2.0f, kHeight = 2.6f, kWall = 0.2f;

void addWalls(Scene& scene) {
    const int white = addMaterial(scene, "white", {0.73f, 0.72f, 0.7f});
    const int red = addMaterial(scene, "red", {0.6f, 0.12f, 0.08f});
    const int blue = addMaterial(scene, "blue", {0.12f, 0.2f, 0.55f});
    BoxSolid room;
    room.fill({-kHalf - kWall, -kWall, -kHalf - kWall}, {kHalf + kWall, kHeight + kWall, kHalf + kWall}, white);
    Paint paint = Paint::all(white);
    paint.byNormal[0] = red;
    paint.byNormal[1] = blue;
    room.carve({-kHalf, 0, -kHalf}, {kHalf, kHeight, kHalf}, paint);
    place(scene, addMesh(scene, room.build("walls")));
}

/// A glowing cube with a point light below it, which travels along X below the ceiling.
void addLamp(Scene& scene) {
    const int glow = addEmitter(scene, "lamp", {9.0f, 7.5f, 5.0f});
    MeshBuilder cube(glow);
    cube.box({-0.1f, -0.1f, -0.1f}, {0.1f, 0.1f, 0.1f});
    const int lamp = place(scene, addMesh(scene, "lamp", {std::move(cube)}));
    const int light = addPointLight(scene, "light", {0, -0.3f, 0}, {1.6f, 1.4f, 1.1f});
    scene.nodes[std::size_t(light)].parent = lamp;
    addMotion(scene, lamp, {0.0f, 4.0f}, {{-1.3f, 2.1f, -0.4f}, {1.3f, 2.1f, -0.4f}});
}

/// Stands for a second, then slides through the room within two. It floats: see block() in cornell.cpp.
void addBox(Scene& scene) {
    const int wood = addMaterial(scene, "wood", {0.5f, 0.36f, 0.2f});
    MeshBuilder box(wood);
    box.box({-0.35f, 0.0005f, -0.35f}, {0.35f, 1.1f, 0.35f});
    const int node = place(scene, addMesh(scene, "box", {std::move(box)}));
    addMotion(scene, node, {1.0f, 3.0f}, {{-1.2f, 0, 0.6f}, {1.2f, 0, 0.6f}});
}

}  // namespace

Result<Scene> makeMoving(const BuiltinParams&) {
    Scene scene;
    scene.name = "moving";
    addWalls(scene);
    addLamp(scene);
    addBox(scene);
    addCamera(scene, "still", {0.0f, 1.6f, 1.9f}, {0, 1.0f, -1.0f}, 75);
    const int tracking = addCamera(scene, "tracking", {-0.8f, 1.6f, 1.9f}, {-0.3f, 1.0f, -1.0f}, 70);
    addMotion(scene, tracking, {0.0f, 4.0f}, {{-0.8f, 1.6f, 1.9f}, {0.8f, 1.6f, 1.9f}});
    scene.exposure = 1.0f;
    return scene;
}

}  // namespace probegi::builtin

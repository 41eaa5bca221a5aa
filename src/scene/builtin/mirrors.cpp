#include <array>

#include "scene/builtin/box_solid.h"
#include "scene/builtin/builtin.h"
#include "scene/builtin/scene_parts.h"

namespace probegi::builtin {

namespace {

constexpr float kHalfX = 2.4f, kHalfZ = 2.0f, kHeight = 2.8f, kWall = 0.2f;
constexpr float kGap = 0.0005f;  // see block() in cornell.cpp

int addMetal(Scene& scene, std::string name, glm::vec3 reflectance, float roughness) {
    const int material = addMaterial(scene, std::move(name), reflectance, roughness);
    scene.materials[std::size_t(material)].metallic = 1.0f;
    return material;
}

void addWalls(Scene& scene) {
    const int white = addMaterial(scene, "plaster", {0.72f, 0.7f, 0.66f}, 0.9f);
    const int blue = addMaterial(scene, "blue wall", {0.12f, 0.25f, 0.6f}, 0.9f);
    const int floor = addMaterial(scene, "floor", {0.45f, 0.2f, 0.1f}, 0.45f);
    BoxSolid room;
    room.fill({-kHalfX - kWall, -kWall, -kHalfZ - kWall}, {kHalfX + kWall, kHeight + kWall, kHalfZ + kWall}, white);
    Paint paint = Paint::room(white, floor, white);
    paint.byNormal[4] = blue;
    room.carve({-kHalfX, 0, -kHalfZ}, {kHalfX, kHeight, kHalfZ}, paint);
    place(scene, addMesh(scene, room.build("walls")));
}

/// Plates on the walls at both ends of X: each sees itself in the other.
void addMirrors(Scene& scene) {
    const int mirror = addMetal(scene, "mirror", {0.85f, 0.85f, 0.84f}, 0.0f);
    for (const float side : {-1.0f, 1.0f}) {
        MeshBuilder plate(mirror);
        const float inner = side * (kHalfX - 0.03f), outer = side * (kHalfX - kGap);
        plate.box({std::min(inner, outer), 0.3f, -1.5f}, {std::max(inner, outer), 2.4f, 1.5f});
        place(scene, addMesh(scene, "mirror", {std::move(plate)}));
    }
}

void addRobot(Scene& scene) {
    const int steel = addMetal(scene, "steel", {0.62f, 0.6f, 0.58f}, 0.15f);
    const int red = addMaterial(scene, "red lacquer", {0.65f, 0.05f, 0.04f}, 0.2f);
    const int rubber = addMaterial(scene, "rubber", {0.06f, 0.06f, 0.06f}, 0.8f);
    MeshBuilder metal(steel), lacquer(red), dark(rubber);
    lacquer.bevelledBox({-0.22f, 0.7f, -0.16f}, {0.22f, 1.2f, 0.16f}, 0.04f);
    metal.bevelledBox({-0.15f, 1.24f, -0.13f}, {0.15f, 1.5f, 0.13f}, 0.04f);
    for (const float side : {-1.0f, 1.0f}) {
        metal.bevelledBox({side * 0.3f - 0.06f, 0.62f, -0.06f}, {side * 0.3f + 0.06f, 1.18f, 0.06f}, 0.02f);
        metal.bevelledBox({side * 0.12f - 0.07f, 0.14f, -0.07f}, {side * 0.12f + 0.07f, 0.68f, 0.07f}, 0.02f);
        dark.bevelledBox({side * 0.12f - 0.09f, 0, -0.1f}, {side * 0.12f + 0.09f, 0.12f, 0.18f}, 0.02f);
    }
    const int robot = addMesh(scene, "robot", {std::move(metal), std::move(lacquer), std::move(dark)});
    place(scene, robot, {0, kGap, -0.5f}, 0.6f);
}

/// Balls of gold and steel, from polished to rough.
void addBalls(Scene& scene) {
    constexpr std::array kRoughness{0.05f, 0.2f, 0.35f, 0.5f, 0.7f};
    for (std::size_t i = 0; i < kRoughness.size(); ++i) {
        const bool gold = i % 2 == 0;
        const int metal =
            addMetal(scene, gold ? "gold" : "nickel",
                     gold ? glm::vec3(0.85f, 0.62f, 0.25f) : glm::vec3(0.62f, 0.58f, 0.54f), kRoughness[i]);
        MeshBuilder ball(metal);
        addGeodesicSphere(ball, 4, [](glm::vec3) { return 0.22f; });
        place(scene, addMesh(scene, "ball", {std::move(ball)}), {-1.2f + 0.6f * float(i), 0.22f + kGap, 0.75f});
    }
}

}  // namespace

/// A closed room of 4.8 x 2.8 x 4 m around them, lit by a panel in the ceiling and a small lamp.
Result<Scene> makeMirrors(const BuiltinParams&) {
    Scene scene;
    scene.name = "mirrors";
    addWalls(scene);
    addMirrors(scene);
    addRobot(scene);
    addBalls(scene);
    const int glow = addEmitter(scene, "lamp", {9.0f, 8.0f, 6.5f});
    MeshBuilder panel(glow);
    panel.box({-0.6f, kHeight - 0.04f, -0.6f}, {0.6f, kHeight - kGap, 0.2f});
    place(scene, addMesh(scene, "lamp", {std::move(panel)}));
    addPointLight(scene, "spot", {1.2f, 2.2f, 1.4f}, {2.5f, 2.3f, 2.0f});
    addCamera(scene, "robot", {1.6f, 1.5f, 1.75f}, {-0.9f, 0.8f, -0.6f}, 65);
    addCamera(scene, "mirror", {1.7f, 1.5f, 0.9f}, {-2.4f, 1.2f, -0.3f}, 60);
    scene.exposure = 1.0f;
    return scene;
}

}  // namespace probegi::builtin

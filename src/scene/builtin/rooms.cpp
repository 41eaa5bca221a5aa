#include <algorithm>

#include "scene/builtin/box_solid.h"
#include "scene/builtin/builtin.h"
#include "scene/builtin/scene_parts.h"
#include "scene/builtin/textures.h"

namespace probegi::builtin {

namespace {

/// Two rooms along X, 5 x 2.8 x 5 m each, on open ground; the wall between them is centred on x = 0. All walls and the
/// roof are `thickness` metres thick.
struct Rooms {
    float thickness;
    float width = 5.0f, height = 2.8f, depth = 5.0f;
    float left() const { return -width - 0.5f * thickness; }  ///< inner face of the first room's far wall
    float right() const { return width + 0.5f * thickness; }
    float wall() const { return 0.5f * thickness; }
    float back() const { return -0.5f * depth; }
    float front() const { return 0.5f * depth; }
};

struct Materials {
    int ground, outside, plaster, floor, ceiling, accentA, accentB;
};

Materials addMaterials(Scene& scene) {
    Materials m;
    m.ground = addTextured(scene, "ground", squareTilesTexture({0.2f, 0.18f, 0.15f}, {0.1f, 0.1f, 0.09f}, 4, 3), 3.0f);
    m.outside =
        addTextured(scene, "bricks", masonryTexture({0.3f, 0.13f, 0.08f}, {0.25f, 0.22f, 0.2f}, 6, 16, 17), 1.4f);
    m.plaster = addTextured(scene, "plaster", plasterTexture({0.74f, 0.72f, 0.68f}, 5), 2.5f);
    m.floor = addTextured(scene, "planks", plankTexture({0.58f, 0.38f, 0.22f}, 8, 21), 1.6f, 0.6f);
    m.ceiling = addMaterial(scene, "ceiling", {0.8f, 0.8f, 0.78f});
    m.accentA = addTextured(scene, "terracotta wall", plasterTexture({0.62f, 0.23f, 0.12f}, 8), 2.5f);
    m.accentB = addTextured(scene, "blue wall", plasterTexture({0.14f, 0.3f, 0.52f}, 9), 2.5f);
    return m;
}

/// The shell with both rooms carved out, without openings.
BoxSolid shell(const Rooms& r, const Materials& m) {
    const float t = r.thickness;
    BoxSolid solid;
    solid.fill({-10, -0.4f, -6}, {10, -0.05f, 10}, m.ground);
    solid.fill({r.left() - t, -0.4f, r.back() - t}, {r.right() + t, r.height + t, r.front() + t}, m.outside);
    Paint first = Paint::room(m.plaster, m.floor, m.ceiling);
    first.byNormal[0] = m.accentA;
    solid.carve({r.left(), 0, r.back()}, {-r.wall(), r.height, r.front()}, first);
    Paint second = Paint::room(m.plaster, m.floor, m.ceiling);
    second.byNormal[1] = m.accentB;
    solid.carve({r.wall(), 0, r.back()}, {r.right(), r.height, r.front()}, second);
    return solid;
}

/// A window nearly as wide as the room, in the front wall of the first room.
void openWindow(BoxSolid& solid, const Rooms& r, const Materials& m) {
    solid.carve({r.left() + 0.5f, 0.5f, r.front()}, {-r.wall() - 0.5f, 2.4f, r.front() + r.thickness},
                Paint::all(m.plaster));
}

/// Half a millimetre above the floor: see block() in cornell.cpp.
constexpr float kGap = 0.0005f;

void addTable(Scene& scene, int material, glm::vec3 position, float yaw) {
    MeshBuilder out(material);
    out.bevelledBox({-0.8f, 0.70f, -0.45f}, {0.8f, 0.75f, 0.45f}, 0.01f);
    for (const float x : {-0.7f, 0.7f}) {
        for (const float z : {-0.36f, 0.36f}) {
            out.box({x - 0.035f, 0, z - 0.035f}, {x + 0.035f, 0.71f, z + 0.035f});
        }
    }
    place(scene, addMesh(scene, "table", {std::move(out)}), position + glm::vec3(0, kGap, 0), yaw);
}

void addBall(Scene& scene, int material, glm::vec3 floor, float radius) {
    MeshBuilder out(material);
    addGeodesicSphere(out, 4, [&](glm::vec3) { return radius; });
    place(scene, addMesh(scene, "ball", {std::move(out)}), floor + glm::vec3(0, radius + kGap, 0));
}

void addCrate(Scene& scene, int material, glm::vec3 floor, glm::vec3 size, float yaw) {
    MeshBuilder out(material);
    const glm::vec3 half(0.5f * size.x, 0, 0.5f * size.z);
    out.bevelledBox(-half, half + glm::vec3(0, size.y, 0), 0.015f);
    place(scene, addMesh(scene, "crate", {std::move(out)}), floor + glm::vec3(0, kGap, 0), yaw);
}

void furnish(Scene& scene, float side) {
    const int wood = addTextured(scene, "wood", plankTexture({0.5f, 0.33f, 0.18f}, 4, 33), 0.8f, 0.5f);
    const int yellow = addMaterial(scene, "yellow", {0.75f, 0.5f, 0.08f});
    const int white = addMaterial(scene, "white", {0.8f, 0.8f, 0.8f});
    const int teal = addMaterial(scene, "teal", {0.06f, 0.4f, 0.38f});
    addTable(scene, wood, {side * 2.9f, 0, -0.9f}, 0.3f);
    addBall(scene, white, {side * 2.8f, 0.75f, -0.9f}, 0.2f);
    addCrate(scene, yellow, {side * 4.2f, 0, -1.7f}, {0.8f, 0.8f, 0.8f}, 0.5f);
    addCrate(scene, teal, {side * 1.0f, 0, -1.95f}, {0.6f, 1.4f, 0.6f}, 0.15f);
    addBall(scene, yellow, {side * 1.7f, 0, 0.6f}, 0.35f);
}

/// What is between the rooms.
enum class Passage { none, doorway, door };

/// Of the doorway with a door, along Z.
constexpr float kDoorFrom = -0.6f, kDoorTo = 0.5f, kDoorHeight = 2.2f;

void openPassage(BoxSolid& solid, const Rooms& r, const Materials& m, Passage passage) {
    if (passage == Passage::none) return;
    const float to = passage == Passage::door ? kDoorTo : 1.2f;
    solid.carve({-r.wall(), 0, kDoorFrom}, {r.wall(), kDoorHeight, to}, Paint::room(m.plaster, m.floor, m.plaster));
}

/// Closed for a second, then it opens into the second room within two.
void hangDoor(Scene& scene, const Rooms& r) {
    constexpr float kGaps = 0.005f;  // on all sides
    const float half = std::min(0.02f, 0.4f * r.thickness);
    const int paint = addMaterial(scene, "door", {0.75f, 0.75f, 0.73f}, 0.5f);
    MeshBuilder out(paint);
    out.box({-half, kGaps, kGaps}, {half, kDoorHeight - kGaps, kDoorTo - kDoorFrom - kGaps});
    const int node = place(scene, addMesh(scene, "door", {std::move(out)}), {0, 0, kDoorFrom});
    addRotation(scene, node, {0, 1, 0}, {1.0f, 2.0f, 3.0f}, {0.0f, 50.0f, 100.0f});
}

Result<Scene> makeRooms(const BuiltinParams& params, const char* name, Passage passage) {
    if (auto r = requireWithin("wallThickness", params.wallThickness, 0.02f, 0.30f); !r) {
        return r.error();
    }
    const Rooms r{params.wallThickness};
    Scene scene;
    scene.name = name;
    const Materials m = addMaterials(scene);
    BoxSolid solid = shell(r, m);
    openWindow(solid, r, m);
    openPassage(solid, r, m, passage);
    place(scene, addMesh(scene, solid.build("walls")));
    if (passage == Passage::door) hangDoor(scene, r);
    furnish(scene, -1);
    furnish(scene, 1);

    addSun(scene, {0.45f, -0.9f, -1.0f}, glm::vec3(10.0f, 9.0f, 7.6f));
    scene.sky.radiance = {0.4f, 0.55f, 0.85f};
    addCamera(scene, "lit", {-0.5f, 1.6f, 2.1f}, {-3.4f, 0.9f, -1.2f}, 65);
    return scene;
}

}  // namespace

Result<Scene> makeTwoRooms(const BuiltinParams& params) {
    auto scene = makeRooms(params, "two-rooms", Passage::doorway);
    if (!scene) return scene;
    addCamera(*scene, "second", {4.5f, 1.6f, 1.9f}, {0, 1.1f, -0.1f}, 68);
    addCamera(*scene, "doorway", {-4.5f, 1.6f, 0.6f}, {4, 1.0f, 0.2f}, 60);
    addCamera(*scene, "outside", {-6.5f, 4.2f, 10.5f}, {-0.6f, 1, 0}, 45);
    scene->exposure = 1.5f;
    return scene;
}

/// The second room is dark until the door opens.
Result<Scene> makeDoor(const BuiltinParams& params) {
    auto scene = makeRooms(params, "door", Passage::door);
    if (!scene) return scene;
    addCamera(*scene, "second", {4.5f, 1.6f, 1.9f}, {0, 1.1f, -0.1f}, 68);
    scene->exposure = 3.0f;
    return scene;
}

/// The second room has no opening: its walls, floor and ceiling are one closed surface.
Result<Scene> makeDarkRoom(const BuiltinParams& params) {
    auto scene = makeRooms(params, "dark-room", Passage::none);
    if (!scene) return scene;
    addCamera(*scene, "dark", {4.5f, 1.6f, 1.9f}, {0, 1.1f, -0.1f}, 68);
    addCamera(*scene, "outside", {-6.5f, 4.2f, 10.5f}, {-0.6f, 1, 0}, 45);
    scene->exposure = 1.5f;
    return scene;
}

}  // namespace probegi::builtin

#include "scene/builtin/box_solid.h"
#include "scene/builtin/builtin.h"
#include "scene/builtin/desk_clutter.h"
#include "scene/builtin/house_furniture.h"
#include "scene/builtin/scene_parts.h"
#include "scene/builtin/textures.h"

namespace probegi::builtin {

namespace {

constexpr float kHalfX = 1.6f, kHalfZ = 1.4f, kHeight = 2.6f, kWall = 0.2f;
constexpr float kGap = 0.0005f;  // see block() in cornell.cpp
constexpr glm::vec3 kTable(1.5f, 0.74f, 0.7f);
constexpr float kTableZ = -kHalfZ + 0.5f * kTable.z + 0.02f;  // of its middle: the desk stands at the wall

struct Materials {
    int wall, floor, wood, darkWood, seat, paper, card, glaze, steel, bulb;
    std::vector<int> covers;
};

Materials addMaterials(Scene& scene) {
    Materials m;
    m.wall = addTextured(scene, "plaster", plasterTexture({0.72f, 0.7f, 0.64f}, 11), 2.0f);
    m.floor = addTextured(scene, "boards", plankTexture({0.42f, 0.27f, 0.15f}, 4, 12), 1.6f, 0.6f);
    m.wood = addTextured(scene, "desk", plankTexture({0.55f, 0.38f, 0.2f}, 2, 13), 1.1f, 0.6f);
    m.darkWood = addMaterial(scene, "dark wood", {0.22f, 0.13f, 0.08f}, 0.7f);
    m.seat = addMaterial(scene, "seat", {0.12f, 0.2f, 0.34f});
    m.paper = addMaterial(scene, "paper", {0.82f, 0.81f, 0.77f});
    m.card = addMaterial(scene, "card", {0.5f, 0.35f, 0.2f});
    m.glaze = addMaterial(scene, "glaze", {0.75f, 0.3f, 0.12f}, 0.3f);
    m.steel = addMaterial(scene, "lacquer", {0.1f, 0.3f, 0.24f}, 0.4f);
    m.bulb = addEmitter(scene, "bulb", {12.0f, 9.5f, 6.0f});
    const glm::vec3 colours[] = {
        {0.5f, 0.07f, 0.05f}, {0.07f, 0.16f, 0.4f}, {0.1f, 0.32f, 0.12f}, {0.68f, 0.52f, 0.18f}, {0.7f, 0.68f, 0.62f}};
    for (const glm::vec3& colour : colours) m.covers.push_back(addMaterial(scene, "cover", colour, 0.8f));
    return m;
}

/// Four walls with a window in the one at +X, a skirting board and a shelf over the desk.
void addRoomWalls(Scene& scene, const Materials& m) {
    BoxSolid room;
    room.fill({-kHalfX - kWall, -kWall, -kHalfZ - kWall}, {kHalfX + kWall, kHeight + kWall, kHalfZ + kWall}, m.wall);
    room.carve({-kHalfX, 0, -kHalfZ}, {kHalfX, kHeight, kHalfZ}, Paint::room(m.wall, m.floor, m.wall));
    room.carve({kHalfX - 0.01f, 0.95f, -0.75f}, {kHalfX + kWall + 0.1f, 2.15f, 0.55f}, Paint::all(m.wall));
    room.fill({-0.6f, 1.32f, -kHalfZ - 0.01f}, {0.75f, 1.345f, -kHalfZ + 0.22f}, m.darkWood);
    place(scene, addMesh(scene, room.build("room")));
}

void addThingsOnTheDesk(Scene& scene, const Materials& m) {
    const float y = kTable.y + kGap;
    const auto put = [&](int mesh, float x, float z, float yaw) { place(scene, mesh, {x, y, kTableZ + z}, yaw); };
    put(addDeskLamp(scene, m.steel, m.bulb), -0.52f, -0.12f, 0.6f);
    put(addMug(scene, m.glaze), -0.18f, 0.14f, 0.7f);
    put(addPaperStack(scene, m.paper, 0.06f, 1), 0.08f, 0.06f, 0.15f);
    put(addPaperStack(scene, m.paper, 0.025f, 2), -0.42f, 0.18f, -0.25f);
    put(addBookPile(scene, m.covers, 5, 3), 0.42f, 0.1f, 0.3f);
    put(addOpenBox(scene, m.card, {0.26f, 0.14f, 0.2f}), 0.56f, -0.2f, -0.12f);
    put(addBookRow(scene, m.covers, 9, 4), -0.05f, -0.24f, 0.0f);
    place(scene, addBookRow(scene, m.covers, 14, 5), {-0.5f, 1.345f + kGap, -kHalfZ + 0.1f});
    place(scene, addBookPile(scene, m.covers, 4, 6), {0.4f, 1.345f + kGap, -kHalfZ + 0.12f}, 1.4f);
}

void addThingsBelow(Scene& scene, const Materials& m) {
    place(scene, addChair(scene, m.darkWood, m.seat), {0.12f, kGap, kTableZ + 0.55f}, 3.5f);
    place(scene, addBasket(scene, m.steel), {-0.56f, kGap, kTableZ + 0.05f});
    place(scene, addOpenBox(scene, m.card, {0.34f, 0.3f, 0.3f}), {0.52f, kGap, kTableZ - 0.05f}, 0.2f);
    place(scene, addBookPile(scene, m.covers, 7, 7), {-0.22f, kGap, kTableZ - 0.12f}, 0.8f);
    place(scene, addPaperStack(scene, m.paper, 0.1f, 8), {0.95f, kGap, -kHalfZ + 0.2f}, 1.2f);
    place(scene, addBookPile(scene, m.covers, 8, 9), {-1.2f, kGap, -kHalfZ + 0.22f}, 0.2f);
}

}  // namespace

/// A study of 3.2 x 2.6 x 2.8 m: its light comes through a window at +X and from a lamp on the desk. What lies on,
/// under and beside the desk is smaller than a cell of the grid that comes with it, 45 cm.
Result<Scene> makeDesk(const BuiltinParams&) {
    Scene scene;
    scene.name = "desk";
    const Materials m = addMaterials(scene);
    addRoomWalls(scene, m);
    place(scene, addTable(scene, m.wood, kTable), {0, kGap, kTableZ});
    addThingsOnTheDesk(scene, m);
    addThingsBelow(scene, m);
    addSun(scene, {-1.0f, -0.75f, 0.25f}, glm::vec3(9.0f, 8.2f, 7.0f));
    addPointLight(scene, "lamp", {-0.396f, kTable.y + 0.355f, kTableZ + 0.062f}, {0.5f, 0.4f, 0.25f});
    scene.sky.radiance = {0.6f, 0.8f, 1.2f};
    addCamera(scene, "desk", {0.55f, 1.35f, 0.45f}, {-0.05f, 0.72f, -1.1f}, 55);
    addCamera(scene, "below", {0.95f, 0.55f, 0.5f}, {-0.1f, 0.25f, -1.2f}, 60);
    scene.grid = VolumeDesc{.origin = {-1.9f, -0.25f, -1.65f}, .spacing = glm::vec3(0.45f), .counts = {9, 8, 9}};
    scene.exposure = 1.6f;
    return scene;
}

}  // namespace probegi::builtin

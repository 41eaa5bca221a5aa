#include <array>
#include <glm/gtc/constants.hpp>

#include "scene/builtin/box_solid.h"
#include "scene/builtin/builtin.h"
#include "scene/builtin/house_furniture.h"
#include "scene/builtin/scene_parts.h"
#include "scene/builtin/textures.h"

namespace probegi::builtin {

namespace {

constexpr float kPi = glm::pi<float>();

// 13 x 8 m, two storeys; +Z is the sunny side. Inner walls are 0.2 m thick, outer ones 0.3 m.
constexpr float kWidth = 13.0f, kDepth = 8.0f, kOuter = 0.3f;
constexpr float kGround = 2.7f;                ///< ceiling of the ground floor
constexpr float kUpper = 3.0f, kAttic = 5.6f;  ///< upper storey: floor and ceiling
constexpr float kEaves = 5.9f;
constexpr float kGap = 0.0005f;  ///< below objects on a floor: see block() in cornell.cpp

// Stairs rise along -Z in the hall.
constexpr int kSteps = 16;
constexpr float kStairX0 = 7.4f, kStairX1 = 8.4f, kStairZ0 = 1.9f, kStairZ1 = 6.0f;

struct Materials {
    int facade, plinth, wood, planks, tiles, bath, white, ceiling, cream, blue, green, yellow, rose, grass, path, roof,
        frame, sofa, sheet, rug, lampShade, metal, bark, foliage;
};

Materials addMaterials(Scene& scene) {
    const auto plaster = [&](const char* name, glm::vec3 colour, int seed) {
        return addTextured(scene, name, plasterTexture(colour, seed), 2.5f);
    };
    Materials m;
    m.facade = plaster("facade", {0.31f, 0.24f, 0.15f}, 1);
    m.plinth = addTextured(scene, "plinth", masonryTexture({0.2f, 0.18f, 0.16f}, {0.12f, 0.12f, 0.11f}, 4, 6, 2), 1.5f);
    m.wood = addTextured(scene, "wood", plankTexture({0.45f, 0.27f, 0.14f}, 3, 3), 0.9f, 0.6f);
    m.planks = addTextured(scene, "planks", plankTexture({0.55f, 0.35f, 0.19f}, 8, 4), 1.6f, 0.6f);
    m.tiles =
        addTextured(scene, "kitchen tiles",
                    inlayFloorTexture({0.6f, 0.57f, 0.5f}, {0.5f, 0.46f, 0.4f}, {0.12f, 0.14f, 0.16f}), 1.0f, 0.5f);
    m.bath =
        addTextured(scene, "bath tiles", squareTilesTexture({0.3f, 0.5f, 0.55f}, {0.6f, 0.6f, 0.6f}, 8, 6), 1.6f, 0.4f);
    m.white = plaster("white wall", {0.76f, 0.75f, 0.72f}, 7);
    m.ceiling = addMaterial(scene, "ceiling", {0.8f, 0.8f, 0.79f});
    m.cream = plaster("cream wall", {0.74f, 0.64f, 0.46f}, 8);
    m.blue = plaster("blue wall", {0.16f, 0.32f, 0.55f}, 9);
    m.green = plaster("green wall", {0.28f, 0.48f, 0.2f}, 10);
    m.yellow = plaster("yellow wall", {0.76f, 0.55f, 0.14f}, 11);
    m.rose = plaster("red wall", {0.6f, 0.14f, 0.1f}, 12);
    m.grass = addTextured(scene, "grass", grassTexture({0.055f, 0.105f, 0.03f}, 13), 3.0f);
    m.path = addTextured(scene, "path", squareTilesTexture({0.22f, 0.2f, 0.17f}, {0.09f, 0.09f, 0.07f}, 3, 14), 1.5f);
    m.roof = addTextured(scene, "roof tiles", roofTexture({0.28f, 0.09f, 0.05f}, 15), 1.8f);
    m.frame = addMaterial(scene, "frames", {0.75f, 0.75f, 0.73f}, 0.5f);
    m.sofa = addMaterial(scene, "sofa", {0.1f, 0.26f, 0.3f});
    m.sheet = addMaterial(scene, "sheet", {0.8f, 0.8f, 0.8f});
    m.rug =
        addTextured(scene, "rug", clothTexture({0.5f, 0.08f, 0.06f}, {0.6f, 0.42f, 0.2f}, {0.1f, 0.1f, 0.25f}), 1.4f);
    m.lampShade = addEmitter(scene, "lamp shade", {5.0f, 3.4f, 1.8f});
    m.metal = addMaterial(scene, "steel", {0.6f, 0.6f, 0.6f}, 0.35f);
    scene.materials[std::size_t(m.metal)].metallic = 1;
    m.bark = addTextured(scene, "bark", plankTexture({0.16f, 0.1f, 0.06f}, 5, 16), 0.8f);
    m.foliage = addTextured(scene, "foliage", grassTexture({0.045f, 0.11f, 0.025f}, 17), 1.0f);
    return m;
}

/// Hollows out a room and paints it; one wall, by its normal (as in Paint), may differ.
void room(BoxSolid& s, glm::vec3 lower, glm::vec3 upper, int wall, int floor, int ceiling, int accentSide = -1,
          int accent = -1) {
    Paint paint = Paint::room(wall, floor, ceiling);
    if (accentSide >= 0) paint.byNormal[std::size_t(accentSide)] = accent;
    s.carve(lower, upper, paint);
}

void carveRooms(BoxSolid& s, const Materials& m) {
    const float back = kOuter, front = kDepth - kOuter, right = kWidth - kOuter;
    room(s, {kOuter, 0, back}, {6.0f, kGround, front}, m.cream, m.planks, m.ceiling, 0, m.rose);      // living room
    room(s, {6.2f, 0, back}, {8.4f, kGround, front}, m.white, m.tiles, m.ceiling);                    // hall
    room(s, {8.6f, 0, 3.4f}, {right, kGround, front}, m.white, m.tiles, m.ceiling, 1, m.yellow);      // kitchen
    room(s, {8.6f, 0, back}, {right, kGround, 3.2f}, m.green, m.planks, m.ceiling);                   // study
    room(s, {kOuter, kUpper, 3.9f}, {6.0f, kAttic, front}, m.white, m.planks, m.ceiling, 0, m.blue);  // bedroom
    room(s, {kOuter, kUpper, back}, {6.0f, kAttic, 3.7f}, m.yellow, m.planks, m.ceiling);             // workroom
    room(s, {6.2f, kUpper, back}, {8.4f, kAttic, front}, m.white, m.planks, m.ceiling);               // landing
    room(s, {8.6f, kUpper, 3.4f}, {right, kAttic, front}, m.white, m.planks, m.ceiling, 1, m.green);  // child's room
    room(s, {8.6f, kUpper, back}, {right, kAttic, 3.2f}, m.white, m.bath, m.ceiling);                 // bath
}

void carveDoors(BoxSolid& s, const Materials& m) {
    const Paint paint = Paint::room(m.frame, m.planks, m.frame);
    const auto acrossX = [&](float x0, float x1, float floor, float z, float width) {
        s.carve({x0, floor, z}, {x1, floor + 2.1f, z + width}, paint);
    };
    acrossX(6.0f, 6.2f, 0, 4.2f, 1.8f);                                          // hall - living room, wide
    acrossX(8.4f, 8.6f, 0, 6.4f, 0.9f);                                          // hall - kitchen
    acrossX(6.0f, 6.2f, kUpper, 6.3f, 0.9f);                                     // landing - bedroom
    acrossX(6.0f, 6.2f, kUpper, 1.6f, 0.9f);                                     // landing - workroom
    acrossX(8.4f, 8.6f, kUpper, 6.5f, 0.9f);                                     // landing - child's room
    acrossX(8.4f, 8.6f, kUpper, 0.6f, 0.9f);                                     // landing - bath
    s.carve({9.2f, 0, 3.2f}, {10.1f, 2.1f, 3.4f}, paint);                        // kitchen - study
    s.carve({6.35f, 0, kDepth - kOuter}, {7.35f, 2.15f, kDepth + 0.1f}, paint);  // front door, open
    s.carve({kStairX0, kGround, kStairZ0}, {kStairX1, kUpper, kStairZ1}, Paint::all(m.white));
}

/// Carves windows and collects their cross bars.
class Windows {
public:
    Windows(BoxSolid& solid, const Materials& m) : m_solid(solid), m_bars(m.frame), m_paint(Paint::all(m.frame)) {}

    /// In a wall along X with centre plane z.
    void alongX(float x0, float x1, float y0, float y1, float z) { add({x0, y0, z}, {x1, y1, z}, 0); }
    void alongZ(float z0, float z1, float y0, float y1, float x) { add({x, y0, z0}, {x, y1, z1}, 2); }
    MeshBuilder takeBars() { return std::move(m_bars); }

private:
    void add(glm::vec3 lower, glm::vec3 upper, int axis) {
        glm::vec3 through(0), bar(0.025f);
        through[2 - axis] = 0.5f * kOuter + 0.05f;
        m_solid.carve(lower - through, upper + through, m_paint);
        const glm::vec3 middle = 0.5f * (lower + upper);
        glm::vec3 a = lower, b = upper;
        a[axis] = b[axis] = middle[axis];
        m_bars.box(a - bar, b + bar);
        a = lower, b = upper;
        a.y = b.y = lower.y + 0.68f * (upper.y - lower.y);
        // Thinner, so that no face coincides with the upright bar's.
        bar[2 - axis] = 0.02f;
        m_bars.box(a - bar, b + bar);
    }

    BoxSolid& m_solid;
    MeshBuilder m_bars;
    Paint m_paint;
};

MeshBuilder carveWindows(BoxSolid& s, const Materials& m) {
    Windows windows(s, m);
    const float front = kDepth - 0.5f * kOuter, back = 0.5f * kOuter, left = 0.5f * kOuter, right = kWidth - left;
    windows.alongX(0.9f, 2.9f, 0.5f, 2.3f, front);
    windows.alongX(3.5f, 5.5f, 0.5f, 2.3f, front);
    windows.alongX(9.3f, 11.9f, 1.0f, 2.3f, front);
    windows.alongX(1.2f, 2.6f, kUpper + 0.8f, kUpper + 2.2f, front);
    windows.alongX(3.8f, 5.2f, kUpper + 0.8f, kUpper + 2.2f, front);
    windows.alongX(6.6f, 8.0f, kUpper + 0.9f, kUpper + 2.2f, front);
    windows.alongX(9.9f, 11.5f, kUpper + 0.8f, kUpper + 2.2f, front);
    windows.alongX(2.0f, 3.8f, 0.9f, 2.2f, back);
    windows.alongX(10.2f, 11.4f, 0.9f, 2.2f, back);
    windows.alongX(2.4f, 3.8f, kUpper + 0.9f, kUpper + 2.2f, back);
    windows.alongX(10.4f, 11.2f, kUpper + 1.3f, kUpper + 2.2f, back);
    windows.alongX(6.7f, 7.9f, kUpper + 0.9f, kUpper + 2.2f, back);
    windows.alongZ(3.0f, 5.0f, 0.7f, 2.3f, left);
    windows.alongZ(1.2f, 2.6f, kUpper + 0.9f, kUpper + 2.2f, left);
    windows.alongZ(4.6f, 6.4f, 1.0f, 2.3f, right);
    windows.alongZ(1.0f, 2.2f, 0.9f, 2.2f, right);
    return windows.takeBars();
}

void addShell(Scene& scene, const Materials& m) {
    BoxSolid s;
    s.fill({-9, -0.5f, -6}, {22, -0.15f, 20}, m.grass);
    s.fill({6.1f, -0.5f, kDepth + 0.1f}, {7.6f, -0.1f, 20}, m.path);
    s.fill({0, -0.5f, 0}, {kWidth, kEaves, kDepth}, m.facade);
    s.fill({-0.06f, -0.5f, -0.06f}, {kWidth + 0.06f, 0.35f, kDepth + 0.06f}, m.plinth);
    carveRooms(s, m);
    carveDoors(s, m);
    MeshBuilder bars = carveWindows(s, m);
    s.fill({6.1f, -0.3f, kDepth - 0.1f}, {7.6f, 0, kDepth + 0.9f}, m.path);  // doorstep
    for (int i = 0; i < kSteps; ++i) {
        const float rise = kUpper / kSteps, run = (kStairZ1 - kStairZ0) / kSteps;
        const float z1 = kStairZ1 - run * float(i);
        const float y1 = rise * float(i + 1), y0 = std::max(0.0f, y1 - 2.4f * rise);
        s.fill({kStairX0, y0, z1 - run}, {kStairX1, y1, z1}, m.wood);
    }
    place(scene, addMesh(scene, s.build("house")));
    place(scene, addMesh(scene, "window bars", {std::move(bars)}));
}

void addRoof(Scene& scene, const Materials& m) {
    MeshBuilder roof(m.roof), wood(m.wood), chimney(m.plinth);
    constexpr float kOverhang = 0.6f, kRidge = 8.4f, kMiddle = 0.5f * kDepth;
    const std::array<glm::vec2, 5> outline{{{kDepth + kOverhang, kEaves + kGap},
                                            {-kOverhang, kEaves + kGap},
                                            {-kOverhang, kEaves + 0.12f},
                                            {kMiddle, kRidge},
                                            {kDepth + kOverhang, kEaves + 0.12f}}};
    addPrism(roof, outline, -0.5f, kWidth + 0.5f);
    chimney.bevelledBox({9.4f, 6.4f, 2.2f}, {10.2f, 9.0f, 2.9f}, 0.02f);
    chimney.bevelledBox({9.3f, 8.9f, 2.1f}, {10.3f, 9.1f, 3.0f}, 0.02f);
    place(scene, addMesh(scene, "roof", {std::move(roof)}));
    place(scene, addMesh(scene, "chimney", {std::move(chimney)}));

    // Banisters around the stairwell.
    const auto post = [&](float x, float z) {
        wood.box({x - 0.02f, kUpper, z - 0.02f}, {x + 0.02f, kUpper + 0.92f, z + 0.02f});
    };
    for (int i = 0; i <= 22; ++i) post(kStairX0 - 0.05f, kStairZ0 + (kStairZ1 + 0.05f - kStairZ0) * float(i) / 22);
    for (int i = 1; i <= 5; ++i) post(kStairX0 - 0.05f + 1.02f * float(i) / 5, kStairZ1 + 0.05f);
    wood.bevelledBox({kStairX0 - 0.09f, kUpper + 0.9f, kStairZ0 - 0.05f},
                     {kStairX0 - 0.01f, kUpper + 0.96f, kStairZ1 + 0.09f}, 0.01f);
    wood.bevelledBox({kStairX0 - 0.02f, kUpper + 0.905f, kStairZ1 + 0.015f},
                     {kStairX1 + 0.01f, kUpper + 0.955f, kStairZ1 + 0.085f}, 0.01f);
    place(scene, addMesh(scene, "banisters", {std::move(wood)}), {0, kGap, 0});
}

void furnishGroundFloor(Scene& scene, const Materials& m) {
    const int sofa = addSofa(scene, m.sofa, 2.2f), lamp = addLamp(scene, m.metal, m.lampShade);
    const int chair = addChair(scene, m.wood, m.rose);
    place(scene, addRug(scene, m.rug, 2.8f, 2.0f), {2.3f, kGap, 3.9f});
    place(scene, sofa, {1.0f, kGap, 3.9f}, 0.5f * kPi);
    place(scene, sofa, {2.5f, kGap, 2.3f}, 0);
    place(scene, addTable(scene, m.wood, {1.1f, 0.42f, 0.7f}), {2.4f, 0.016f, 3.9f}, 0.5f * kPi);
    place(scene, addBookcase(scene, m.wood, {m.rose, m.blue, m.green, m.cream, m.sheet, m.yellow}),
          {4.6f, kGap, 0.47f});
    place(scene, lamp, {0.75f, kGap, 2.3f});
    place(scene, addTable(scene, m.wood, {1.7f, 0.74f, 0.9f}), {4.4f, kGap, 6.3f});
    for (const float x : {3.9f, 4.9f}) {
        place(scene, chair, {x, kGap, 5.7f}, 0.08f * x);
        place(scene, chair, {x, kGap, 6.95f}, kPi - 0.05f * x);
    }
    place(scene, addKitchenBlock(scene, m.blue, m.sheet, 3.2f), {11.0f, kGap, 3.72f});
    place(scene, addKitchenBlock(scene, m.blue, m.wood, 1.6f), {11.0f, kGap, 5.7f}, kPi);
    place(scene, chair, {10.5f, kGap, 6.5f}, kPi + 0.2f);
    place(scene, chair, {11.4f, kGap, 6.45f}, kPi - 0.2f);
    place(scene, addTable(scene, m.wood, {1.5f, 0.74f, 0.7f}), {10.9f, kGap, 0.75f});
    place(scene, chair, {10.8f, kGap, 1.4f}, kPi);
}

void furnishUpperFloor(Scene& scene, const Materials& m) {
    constexpr float kFloor = kUpper + kGap;
    place(scene, addBed(scene, m.wood, m.sheet, m.blue), {1.5f, kFloor, 5.8f}, 0.5f * kPi);
    place(scene, addRug(scene, m.rug, 1.6f, 2.4f), {3.7f, kFloor, 5.7f});
    place(scene, addBed(scene, m.wood, m.sheet, m.rose), {11.6f, kFloor, 5.0f}, -0.5f * kPi);
    place(scene, addBookcase(scene, m.wood, {m.yellow, m.rose, m.green, m.sheet}), {9.6f, kFloor, 3.57f});
    place(scene, addTable(scene, m.wood, {1.6f, 0.74f, 0.8f}), {3.1f, kFloor, 1.0f});
    place(scene, addChair(scene, m.wood, m.green), {3.1f, kFloor, 1.7f}, kPi);
    place(scene, addKitchenBlock(scene, m.frame, m.sheet, 1.6f), {11.5f, kFloor, 0.62f});
}

}  // namespace

/// A house with nine rooms. Its windows and front door are open; the sun comes in from +Z, skylight from all sides.
Result<Scene> makeHouse(const BuiltinParams&) {
    Scene scene;
    scene.name = "house";
    const Materials m = addMaterials(scene);
    addShell(scene, m);
    addRoof(scene, m);
    furnishGroundFloor(scene, m);
    furnishUpperFloor(scene, m);
    const int tree = addTree(scene, m.bark, m.foliage, 3);
    place(scene, tree, {-4.6f, -0.15f, 8.8f}, 0, 1.2f);
    place(scene, tree, {15.8f, -0.15f, 9.0f}, 2.1f, 1.3f);
    place(scene, tree, {-5.0f, -0.15f, 1.0f}, 4.0f, 1.5f);

    addSun(scene, {0.35f, -0.75f, -0.85f}, glm::vec3(11.0f, 9.9f, 8.3f));
    scene.sky.radiance = {0.3f, 0.42f, 0.65f};
    addCamera(scene, "living room", {5.6f, 1.65f, 1.0f}, {1.6f, 1.0f, 5.2f}, 68);
    addCamera(scene, "outside", {-3.6f, 3.2f, 19.0f}, {6.4f, 3.1f, 4.0f}, 45);
    addCamera(scene, "hall", {6.6f, 1.65f, 7.4f}, {7.6f, 1.4f, 2.0f}, 68);
    addCamera(scene, "kitchen", {9.0f, 1.65f, 7.3f}, {11.8f, 0.9f, 4.2f}, 68);
    addCamera(scene, "bedroom", {5.6f, kUpper + 1.65f, 4.3f}, {1.5f, kUpper + 0.7f, 6.4f}, 68);
    addCamera(scene, "landing", {6.6f, kUpper + 1.65f, 0.8f}, {7.3f, kUpper + 0.6f, 6.0f}, 68);
    scene.exposure = 1.9f;
    return scene;
}

}  // namespace probegi::builtin

#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "scene/builtin/atrium_parts.h"
#include "scene/builtin/box_solid.h"
#include "scene/builtin/builtin.h"
#include "scene/builtin/scene_parts.h"
#include "scene/builtin/textures.h"

namespace probegi::builtin {

namespace {

constexpr float kPi = glm::pi<float>();

// Plan: arcades on a rectangle of kLong x kShort bays around the court, with aisles behind them.
constexpr float kBay = 3.0f;
constexpr int kLong = 8, kShort = 3;
constexpr float kArcadeX = 0.5f * kBay * kLong, kArcadeZ = 0.5f * kBay * kShort;
constexpr float kAisle = 3.4f;
constexpr float kWallX = kArcadeX + kAisle, kWallZ = kArcadeZ + kAisle;
constexpr float kWall = 0.6f;   ///< thickness of the outer walls
constexpr float kEdge = 0.42f;  ///< projection of the floors beyond the arcades' centre line

// Section.
constexpr float kAisleFloor = 0.15f, kLowerSpring = 3.4f, kGallery = 5.2f, kUpperSpring = 8.0f, kRoof = 9.7f,
                kTop = 10.3f;
/// Half a millimetre below pieces on a floor: see block() in cornell.cpp.
constexpr float kGap = 0.0005f;

struct Materials {
    int stone, masonry, plaster, ochre, dado, court, aisle, beam, terracotta, earth, leaf, water, rod;
    std::array<int, 3> cloth;
};

Materials addMaterials(Scene& scene) {
    Materials m;
    m.stone = addTextured(scene, "limestone", plasterTexture({0.62f, 0.55f, 0.44f}, 31), 2.0f, 0.8f);
    m.masonry =
        addTextured(scene, "masonry", masonryTexture({0.6f, 0.51f, 0.39f}, {0.4f, 0.35f, 0.28f}, 4, 6, 41), 2.6f);
    addNormalMap(scene, m.masonry, masonryNormals(4, 6, 41), 1.0f);
    m.plaster = addTextured(scene, "plaster", plasterTexture({0.7f, 0.6f, 0.46f}, 51), 3.0f);
    m.ochre = addTextured(scene, "ochre plaster", plasterTexture({0.62f, 0.4f, 0.2f}, 52), 3.0f);
    m.dado = addTextured(scene, "dado", plasterTexture({0.42f, 0.14f, 0.08f}, 61), 3.0f);
    m.court =
        addTextured(scene, "inlay floor",
                    inlayFloorTexture({0.5f, 0.44f, 0.35f}, {0.36f, 0.3f, 0.23f}, {0.2f, 0.07f, 0.05f}), 1.6f, 0.5f);
    m.aisle = addTextured(scene, "terracotta tiles",
                          squareTilesTexture({0.5f, 0.24f, 0.13f}, {0.3f, 0.26f, 0.22f}, 5, 71), 1.5f, 0.7f);
    m.beam = addTextured(scene, "beams", plankTexture({0.3f, 0.18f, 0.1f}, 2, 81), 1.2f);
    m.terracotta = addTextured(scene, "pots", plasterTexture({0.55f, 0.22f, 0.11f}, 91), 0.8f);
    m.earth = addMaterial(scene, "earth", {0.1f, 0.07f, 0.05f});
    m.leaf = addTextured(scene, "leaf", leafTexture({0.12f, 0.36f, 0.07f}), 1.0f, 0.6f);
    Material& leaf = scene.materials[std::size_t(m.leaf)];
    leaf.alphaMode = AlphaMode::mask;
    leaf.doubleSided = true;
    leaf.baseColorTexture.wrapU = leaf.baseColorTexture.wrapV = Wrap::clampToEdge;
    m.water = addMaterial(scene, "water", {0.1f, 0.24f, 0.26f}, 0.08f);
    m.rod = addMaterial(scene, "brass", {0.7f, 0.5f, 0.2f}, 0.35f);
    scene.materials[std::size_t(m.rod)].metallic = 1;

    const std::array<glm::vec3, 3> ground{{{0.55f, 0.035f, 0.03f}, {0.05f, 0.33f, 0.07f}, {0.04f, 0.1f, 0.46f}}};
    const std::array<glm::vec3, 3> figure{{{0.62f, 0.32f, 0.12f}, {0.38f, 0.45f, 0.12f}, {0.3f, 0.38f, 0.6f}}};
    for (std::size_t i = 0; i < 3; ++i) {
        m.cloth[i] = addTextured(scene, "cloth", clothTexture(ground[i], figure[i], {0.72f, 0.52f, 0.16f}), 1.0f);
        scene.materials[std::size_t(m.cloth[i])].doubleSided = true;
    }
    return m;
}

/// Calls visit(lower, upper) for the four boxes of a frame between two rectangles around the origin.
template <class Visit>
void forEachRingBox(glm::vec2 outer, glm::vec2 inner, float y0, float y1, const Visit& visit) {
    visit(glm::vec3(-outer.x, y0, -outer.y), glm::vec3(outer.x, y1, -inner.y));
    visit(glm::vec3(-outer.x, y0, inner.y), glm::vec3(outer.x, y1, outer.y));
    visit(glm::vec3(-outer.x, y0, -inner.y), glm::vec3(-inner.x, y1, inner.y));
    visit(glm::vec3(inner.x, y0, -inner.y), glm::vec3(outer.x, y1, inner.y));
}

void fillRing(BoxSolid& solid, glm::vec2 outer, glm::vec2 inner, float y0, float y1, int material) {
    forEachRingBox(outer, inner, y0, y1, [&](glm::vec3 lower, glm::vec3 upper) { solid.fill(lower, upper, material); });
}

void carveRing(BoxSolid& solid, glm::vec2 outer, glm::vec2 inner, float y0, float y1, const Paint& paint) {
    forEachRingBox(outer, inner, y0, y1, [&](glm::vec3 lower, glm::vec3 upper) { solid.carve(lower, upper, paint); });
}

/// Flat pilasters, a plinth and a doorway on the aisles' walls of one storey.
void dressWalls(BoxSolid& solid, const Materials& m, float floor, float ceiling) {
    const glm::vec2 wall(kWallX + 0.1f, kWallZ + 0.1f);
    fillRing(solid, wall, glm::vec2(kWallX - 0.05f, kWallZ - 0.05f), floor, floor + 0.9f, m.dado);
    fillRing(solid, wall, glm::vec2(kWallX - 0.07f, kWallZ - 0.07f), floor + 0.9f, floor + 0.98f, m.stone);
    const auto pilaster = [&](glm::vec2 at, glm::vec2 half) {
        solid.fill({at.x - half.x, floor, at.y - half.y}, {at.x + half.x, ceiling, at.y + half.y}, m.stone);
    };
    for (int i = 0; i <= kLong; ++i) {
        const float x = -kArcadeX + kBay * float(i);
        for (const float z : {-kWallZ, kWallZ}) pilaster({x, z}, {0.25f, 0.12f});
    }
    for (int i = 0; i <= kShort; ++i) {
        const float z = -kArcadeZ + kBay * float(i);
        for (const float x : {-kWallX, kWallX}) pilaster({x, z}, {0.12f, 0.25f});
    }
}

/// All rectangular parts as one closed surface: walls, floors, cornices, niches.
Mesh shell(const Materials& m) {
    BoxSolid solid;
    const glm::vec2 inside(kWallX, kWallZ), outside(kWallX + kWall, kWallZ + kWall);
    const auto edge = [](float inset) { return glm::vec2(kArcadeX - inset, kArcadeZ - inset); };
    solid.fill({-outside.x, -0.5f, -outside.y}, {outside.x, kTop, outside.y}, m.masonry);
    solid.carve({-inside.x, 0, -inside.y}, {inside.x, kTop, inside.y}, Paint::room(m.masonry, m.court, m.plaster));

    fillRing(solid, inside, edge(0.5f), 0, kAisleFloor, m.stone);
    carveRing(solid, inside, edge(kEdge), kAisleFloor, kGallery - 0.25f, Paint::room(m.ochre, m.aisle, m.plaster));
    dressWalls(solid, m, 0, kGallery);
    fillRing(solid, inside, edge(kEdge), kGallery - 0.25f, kGallery, m.stone);
    fillRing(solid, edge(-0.2f), edge(kEdge - 0.08f), kGallery - 0.35f, kGallery - 0.25f, m.stone);
    carveRing(solid, inside, edge(kEdge), kGallery, kRoof, Paint::room(m.plaster, m.aisle, m.plaster));
    dressWalls(solid, m, kGallery, kRoof);
    fillRing(solid, outside, edge(kEdge), kRoof, kTop, m.stone);
    fillRing(solid, edge(-0.2f), edge(kEdge - 0.1f), kRoof - 0.15f, kRoof, m.stone);
    fillRing(solid, outside, edge(kEdge + 0.12f), kTop - 0.18f, kTop, m.stone);

    // Doors at both ends, niches in the middle of the long walls' bays.
    for (const float side : {-1.0f, 1.0f}) {
        const auto niche = [&](glm::vec2 at, glm::vec2 half, float y0, float y1, int paint) {
            solid.carve({at.x - half.x, y0, at.y - half.y}, {at.x + half.x, y1, at.y + half.y}, Paint::all(paint));
        };
        niche({side * kWallX, 0}, {0.3f, 0.8f}, kAisleFloor, 3.1f, m.beam);
        for (int i = 0; i < kLong; ++i) {
            const float x = -kArcadeX + kBay * (float(i) + 0.5f);
            niche({x, side * kWallZ}, {0.55f, 0.3f}, 1.35f, 3.3f, m.plaster);
            niche({x, side * kWallZ}, {0.55f, 0.3f}, kGallery + 1.2f, kGallery + 3.1f, m.plaster);
        }
    }
    return solid.build("shell");
}

struct Storey {
    float floor, spring, top, radius;
    Column column;
};

constexpr Storey kLower{kAisleFloor, kLowerSpring, kGallery - 0.1f, 1.16f, {kLowerSpring - kAisleFloor, 0.25f, 20, 5}};
constexpr Storey kUpper{kGallery, kUpperSpring, kRoof + 0.1f, 1.22f, {kUpperSpring - kGallery, 0.185f, 16, 4}};

/// Calls visit(position, yaw) for each of the four sides: the arcade's left end as seen from the court, and its
/// rotation.
template <class Visit>
void forEachSide(const Visit& visit) {
    visit(glm::vec3(-kArcadeX, 0, -kArcadeZ), 0.0f, kLong);
    visit(glm::vec3(kArcadeX, 0, kArcadeZ), kPi, kLong);
    visit(glm::vec3(-kArcadeX, 0, kArcadeZ), 0.5f * kPi, kShort);
    visit(glm::vec3(kArcadeX, 0, -kArcadeZ), -0.5f * kPi, kShort);
}

glm::vec3 alongSide(glm::vec3 start, float yaw, float distance) {
    return start + distance * glm::vec3(std::cos(yaw), 0, -std::sin(yaw));
}

void addStorey(Scene& scene, const Materials& m, const Storey& s) {
    MeshBuilder column(m.stone), corner(m.stone);
    addColumn(column, s.column);
    const int columnMesh = addMesh(scene, "column", {std::move(column)});
    const float height = s.spring - s.floor;
    corner.bevelledBox({-0.42f, 0, -0.42f}, {0.42f, 0.3f, 0.42f}, 0.02f);
    corner.bevelledBox({-0.36f, 0.29f, -0.36f}, {0.36f, height - 0.15f, 0.36f}, 0.02f);
    corner.bevelledBox({-0.41f, height - 0.16f, -0.41f}, {0.41f, height, 0.41f}, 0.02f);
    const int cornerMesh = addMesh(scene, "corner pier", {std::move(corner)});

    forEachSide([&](glm::vec3 start, float yaw, int bays) {
        MeshBuilder arcade(m.stone);
        Arcade a{bays, kBay, s.radius, s.spring, s.top, 0.56f, 28};
        addArcade(arcade, a);
        place(scene, addMesh(scene, "arcade", {std::move(arcade)}), start, yaw);
        place(scene, cornerMesh, start + glm::vec3(0, s.floor + kGap, 0), yaw);
        for (int i = 1; i < bays; ++i) {
            place(scene, columnMesh, alongSide(start, yaw, kBay * float(i)) + glm::vec3(0, s.floor + kGap, 0), yaw);
        }
    });
}

void addBalustrades(Scene& scene, const Materials& m) {
    MeshBuilder bay(m.stone);
    addBalustrade(bay, kBay - 0.44f, 0.95f, 10);
    const int mesh = addMesh(scene, "balustrade", {std::move(bay)});
    forEachSide([&](glm::vec3 start, float yaw, int bays) {
        for (int i = 0; i < bays; ++i) {
            const glm::vec3 at = alongSide(start, yaw, kBay * (float(i) + 0.5f));
            place(scene, mesh, at + glm::vec3(0, kGallery + kGap, 0), yaw);
        }
    });
}

/// Wooden ceilings: joists across both storeys' aisles, their ends buried in wall and arcade.
void addBeams(Scene& scene, const Materials& m) {
    MeshBuilder beams(m.beam);
    for (const float y : {kGallery - 0.5f, kRoof - 0.25f}) {
        for (const float side : {-1.0f, 1.0f}) {
            for (int i = 0; i <= 4 * kLong; ++i) {
                const float x = -kArcadeX + 0.25f * kBay * float(i), w = i % 4 == 0 ? 0.13f : 0.07f;
                const float low = i % 4 == 0 ? y - 0.08f : y;
                const float z0 = kArcadeZ + 0.1f, z1 = kWallZ + 0.2f;
                beams.box({x - w, low, side > 0 ? z0 : -z1}, {x + w, y + 0.28f, side > 0 ? z1 : -z0});
            }
            for (int i = 0; i <= 4 * kShort; ++i) {
                const float z = -kArcadeZ + 0.25f * kBay * float(i), w = i % 4 == 0 ? 0.13f : 0.07f;
                const float low = i % 4 == 0 ? y - 0.08f : y;
                const float x0 = kArcadeX + 0.1f, x1 = kWallX + 0.2f;
                beams.box({side > 0 ? x0 : -x1, low, z - w}, {side > 0 ? x1 : -x0, y + 0.28f, z + w});
            }
        }
    }
    place(scene, addMesh(scene, "beams", {std::move(beams)}));
}

/// Curtains in some of the lower arches, with their rods, and cloths over the gallery's balustrade above others.
void addCloth(Scene& scene, const Materials& m) {
    MeshBuilder rod(m.rod);
    rod.box({-1.3f, -0.02f, -0.02f}, {1.3f, 0.02f, 0.02f});
    const int rodMesh = addMesh(scene, "rod", {std::move(rod)});
    std::array<int, 3> curtains, throws;
    for (std::size_t i = 0; i < 3; ++i) {
        MeshBuilder curtain(m.cloth[i]), thrown(m.cloth[i]);
        addCurtain(curtain, 1.15f, 2.75f, 7, 0.45f);
        addThrow(thrown, 1.5f, 1.0f);
        curtains[i] = addMesh(scene, "curtain", {std::move(curtain)});
        throws[i] = addMesh(scene, "throw", {std::move(thrown)});
    }
    int count = 0;
    forEachSide([&](glm::vec3 start, float yaw, int bays) {
        for (int i = 0; i < bays; ++i, ++count) {
            const glm::vec3 middle = alongSide(start, yaw, kBay * (float(i) + 0.5f));
            const bool end = bays == kShort;
            const auto colour = std::size_t(count % 3);
            if (!end && i % 2 == 1) {
                const glm::vec3 at = middle + glm::vec3(0, kLowerSpring - 0.28f, 0);
                place(scene, rodMesh, at, yaw);
                place(scene, curtains[colour], alongSide(at, yaw, 0.55f) - glm::vec3(0, 0.02f, 0), yaw);
                place(scene, curtains[colour], alongSide(at, yaw, -0.55f) - glm::vec3(0, 0.02f, 0), yaw + kPi);
            }
            if (end ? i == 1 : i % 2 == 0)
                place(scene, throws[colour], middle + glm::vec3(0, kGallery + 0.97f, 0), yaw);
        }
    });
}

void addPlants(Scene& scene, const Materials& m) {
    MeshBuilder pot(m.terracotta), fern(m.leaf), palm(m.leaf);
    addPot(pot, 0.34f, 0.62f);
    fern.setTransform(glm::mat4(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0.55f, 0, 1));
    palm.setTransform(glm::mat4(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0.55f, 0, 1));
    addFronds(fern, 46, 0.85f, 5);
    addFronds(palm, 30, 1.7f, 6);
    const int potMesh = addMesh(scene, "pot", {std::move(pot)});
    const std::array leaves{addMesh(scene, "fern", {std::move(fern)}), addMesh(scene, "palm", {std::move(palm)})};
    int count = 0;
    for (const float x : {-10.6f, -4.5f, 4.5f, 10.6f}) {
        for (const float z : {-3.25f, 3.25f}) {
            const bool large = std::abs(x) > 10;
            const glm::vec3 at(x, kGap, z);
            const float scale = large ? 1.35f : 1.0f, yaw = 1.3f * float(count++);
            place(scene, potMesh, at, yaw, scale);
            place(scene, leaves[large ? 1 : 0], at, yaw, scale);
        }
    }
}

void addMonuments(Scene& scene, const Materials& m) {
    MeshBuilder fountain(m.stone), water(m.water), urn(m.stone);
    addFountain(fountain);
    addWater(water);
    addUrn(urn);
    place(scene, addMesh(scene, "fountain", {std::move(fountain)}), {0, kGap, 0});
    place(scene, addMesh(scene, "water", {std::move(water)}), {0, kGap, 0});
    const int urnMesh = addMesh(scene, "urn", {std::move(urn)});
    for (const float x : {-1.5f, 1.5f}) {
        for (const float z : {-3.3f, 3.3f}) place(scene, urnMesh, {x, kGap, z});
    }
}

}  // namespace

/// A two-storey colonnade around a court that is open to the sky. The sun is high and slightly to one side: it lights
/// half of the court's floor and one arcade; everything else is lit indirectly.
Result<Scene> makeAtrium(const BuiltinParams&) {
    Scene scene;
    scene.name = "atrium";
    const Materials m = addMaterials(scene);
    place(scene, addMesh(scene, shell(m)));
    addStorey(scene, m, kLower);
    addStorey(scene, m, kUpper);
    addBalustrades(scene, m);
    addBeams(scene, m);
    addCloth(scene, m);
    addPlants(scene, m);
    addMonuments(scene, m);

    addSun(scene, {0.28f, -1, 0.36f}, glm::vec3(12.0f, 11.0f, 9.4f));
    scene.sky.radiance = {0.3f, 0.42f, 0.62f};
    addCamera(scene, "nave", {-11.0f, 1.7f, -0.9f}, {0, 3.0f, 0.5f}, 62);
    addCamera(scene, "gallery", {-12.55f, kGallery + 1.7f, -2.9f}, {0, 3.2f, -0.8f}, 62);
    addCamera(scene, "court", {6.0f, 2.0f, -2.9f}, {-2.0f, 2.9f, 3.4f}, 65);
    addCamera(scene, "aisle", {-11.3f, 1.8f, 6.3f}, {2, 1.7f, 5.6f}, 65);
    scene.exposure = 1.0f;
    return scene;
}

}  // namespace probegi::builtin

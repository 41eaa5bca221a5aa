#include <algorithm>
#include <cmath>

#include "scene/builtin/box_solid.h"
#include "scene/builtin/builtin.h"
#include "scene/builtin/noise.h"
#include "scene/builtin/scene_parts.h"
#include "scene/builtin/textures.h"

namespace probegi::builtin {

namespace {

constexpr int kTiles = 4;       ///< a side of the world
constexpr int kQuads = 181;     ///< a side of a tile
constexpr float kTile = 64.0f;  ///< metres
constexpr float kDepth = 6.0f;  ///< of the ground's underside, metres
constexpr float kRise = 26.0f;  ///< between the deepest valley and the highest hill there could be, metres

/// Of the ground, with the period of a tile, metres.
float heightAt(float x, float z) {
    return kRise * fractalNoise(x / kTile, z / kTile, 3, 4, 11);
}

/// A vertex of the grid; the last column and row are exactly the first ones, so that tiles fit.
glm::vec3 vertexAt(int column, int row) {
    const float step = kTile / float(kQuads);
    return {float(column) * step, heightAt(float(column % kQuads) * step, float(row % kQuads) * step),
            float(row) * step};
}

glm::vec3 normalAt(int column, int row) {
    const float step = kTile / float(kQuads);
    const auto h = [&](int dx, int dz) {
        return vertexAt((column + dx + kQuads) % kQuads, (row + dz + kQuads) % kQuads).y;
    };
    return glm::normalize(glm::vec3(h(-1, 0) - h(1, 0), 2.0f * step, h(0, -1) - h(0, 1)));
}

/// The vertices around a tile, counter-clockwise seen from above (+Z is towards the viewer, +X to the right).
std::vector<glm::ivec2> rim() {
    std::vector<glm::ivec2> around;
    for (int i = 0; i < kQuads; ++i) around.emplace_back(i, kQuads);
    for (int i = kQuads; i > 0; --i) around.emplace_back(kQuads, i);
    for (int i = kQuads; i > 0; --i) around.emplace_back(i, 0);
    for (int i = 0; i < kQuads; ++i) around.emplace_back(0, i);
    return around;
}

void addHills(MeshBuilder& out) {
    for (int row = 0; row <= kQuads; ++row)
        for (int column = 0; column <= kQuads; ++column) {
            const glm::vec3 p = vertexAt(column, row);
            out.vertex(p, normalAt(column, row), {p.x, p.z});
        }
    const auto at = [](int column, int row) { return std::uint32_t(row * (kQuads + 1) + column); };
    for (int row = 0; row < kQuads; ++row)
        for (int column = 0; column < kQuads; ++column) {
            out.triangle(at(column, row), at(column, row + 1), at(column + 1, row + 1));
            out.triangle(at(column, row), at(column + 1, row + 1), at(column + 1, row));
        }
}

/// Sides and underside: ground is solid.
void addBase(MeshBuilder& out) {
    const std::vector<glm::ivec2> around = rim();
    const glm::vec3 centre(0.5f * kTile, -kDepth, 0.5f * kTile), down(0, -1, 0);
    const std::uint32_t middle = out.vertex(centre, down, {centre.x, centre.z});
    for (std::size_t i = 0; i < around.size(); ++i) {
        const glm::ivec2 from = around[i], to = around[(i + 1) % around.size()];
        const glm::vec3 a = vertexAt(from.x, from.y), b = vertexAt(to.x, to.y);
        const glm::vec3 c(b.x, -kDepth, b.z), d(a.x, -kDepth, a.z);
        out.quad(d, c, b, a);
        const std::uint32_t first = out.vertex(d, down, {d.x, d.z}), second = out.vertex(c, down, {c.x, c.z});
        out.triangle(middle, second, first);
    }
}

/// Where a building or a stone of that radius may stand: the highest ground below it.
float groundUnder(glm::vec2 at, float radius) {
    float highest = 0;
    for (int i = 0; i < 16; ++i) {
        const float angle = float(i) * 0.3927f;
        for (const float r : {0.0f, 0.5f * radius, radius})
            highest = std::max(highest, heightAt(at.x + r * std::cos(angle), at.y + r * std::sin(angle)));
    }
    return highest;
}

int addHut(Scene& scene) {
    const int wall =
        addTextured(scene, "hut walls", masonryTexture({0.45f, 0.38f, 0.3f}, {0.3f, 0.27f, 0.24f}, 5, 9, 7), 1.6f);
    const int plaster = addTextured(scene, "hut plaster", plasterTexture({0.72f, 0.66f, 0.55f}, 19), 2.0f);
    const int floor = addTextured(scene, "hut floor", plankTexture({0.5f, 0.33f, 0.2f}, 6, 5), 1.6f);
    BoxSolid solid;
    solid.fill({-2.5f, -4.0f, -2}, {2.5f, 2.7f, 2}, wall);
    solid.carve({-2.3f, 0, -1.8f}, {2.3f, 2.5f, 1.8f}, Paint::room(plaster, floor, plaster));
    solid.carve({0.6f, 0, 1.8f}, {1.6f, 2.1f, 2}, Paint::all(plaster));
    solid.carve({-1.6f, 0.9f, 1.8f}, {-0.4f, 1.9f, 2}, Paint::all(plaster));
    return addMesh(scene, solid.build("hut"));
}

int addStone(Scene& scene) {
    const int material = addTextured(scene, "stone", plasterTexture({0.36f, 0.35f, 0.33f}, 77), 1.2f);
    MeshBuilder out(material);
    addGeodesicSphere(out, 3, [](glm::vec3 d) {
        return 0.75f + 0.5f * fractalNoise(0.5f + 0.4f * d.x, 0.5f + 0.3f * d.y + 0.2f * d.z, 4, 3, 5);
    });
    return addMesh(scene, "stone", {std::move(out)});
}

}  // namespace

/// Hills under the open sky with a few huts and stones: a million triangles, of which most are instances, and much air.
Result<Scene> makeTerrain(const BuiltinParams&) {
    Scene scene;
    scene.name = "terrain";
    const int grass = addTextured(scene, "grass", grassTexture({0.16f, 0.24f, 0.07f}, 3), 3.0f);
    MeshBuilder ground(grass);
    addHills(ground);
    addBase(ground);
    const int tile = addMesh(scene, "hills", {std::move(ground)});
    const float half = 0.5f * kTiles * kTile;
    for (int z = 0; z < kTiles; ++z)
        for (int x = 0; x < kTiles; ++x) place(scene, tile, {float(x) * kTile - half, 0, float(z) * kTile - half});

    const int hut = addHut(scene), stone = addStone(scene);
    constexpr int kHuts = 10, kStones = 80;
    for (int i = 0; i < kHuts + kStones; ++i) {
        const bool house = i < kHuts;
        const float reach = house ? 40.0f : half - 4.0f, size = house ? 1.0f : 0.4f + 1.6f * hash01(i, 2, 9);
        const glm::vec2 at = reach * (2.0f * glm::vec2(hash01(i, 0, 9), hash01(i, 1, 9)) - 1.0f);
        const float y = house ? groundUnder(at, 3.2f) + 0.15f : heightAt(at.x, at.y) + 0.2f * size;
        place(scene, house ? hut : stone, {at.x, y, at.y}, 6.2832f * hash01(i, 3, 9), size);
    }
    addSun(scene, {0.55f, -0.65f, -0.5f}, glm::vec3(3.2f, 2.9f, 2.4f));
    scene.sky.radiance = {0.3f, 0.42f, 0.62f};
    const glm::vec2 eye(6, 38);
    addCamera(scene, "valley", {eye.x, groundUnder(eye, 2.0f) + 6.0f, eye.y}, {0, heightAt(0, 0) + 2.0f, -10}, 60);
    return scene;
}

}  // namespace probegi::builtin

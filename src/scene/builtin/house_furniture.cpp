#include "scene/builtin/house_furniture.h"

#include <array>
#include <glm/gtc/matrix_transform.hpp>

#include "scene/builtin/noise.h"
#include "scene/builtin/scene_parts.h"

namespace probegi::builtin {

namespace {

void addLegs(MeshBuilder& out, float x, float z, float height, float thick) {
    for (const float sx : {-x, x}) {
        for (const float sz : {-z, z}) out.box({sx - thick, 0, sz - thick}, {sx + thick, height, sz + thick});
    }
}

}  // namespace

int addTable(Scene& scene, int material, glm::vec3 size) {
    MeshBuilder out(material);
    const float x = 0.5f * size.x, z = 0.5f * size.z;
    out.bevelledBox({-x, size.y - 0.045f, -z}, {x, size.y, z}, 0.008f);
    addLegs(out, x - 0.08f, z - 0.08f, size.y - 0.04f, 0.035f);
    return addMesh(scene, "table", {std::move(out)});
}

int addChair(Scene& scene, int wood, int seat) {
    MeshBuilder frame(wood), cushion(seat);
    addLegs(frame, 0.18f, 0.18f, 0.44f, 0.02f);
    frame.bevelledBox({-0.22f, 0.42f, -0.22f}, {0.22f, 0.46f, 0.22f}, 0.006f);
    for (const float x : {-0.19f, 0.19f}) frame.box({x - 0.018f, 0.45f, -0.22f}, {x + 0.018f, 0.92f, -0.18f});
    for (const float y : {0.6f, 0.72f, 0.84f}) frame.box({-0.2f, y, -0.212f}, {0.2f, y + 0.06f, -0.19f});
    cushion.bevelledBox({-0.2f, 0.455f, -0.18f}, {0.2f, 0.5f, 0.2f}, 0.015f);
    return addMesh(scene, "chair", {std::move(frame), std::move(cushion)});
}

int addSofa(Scene& scene, int cloth, float width) {
    MeshBuilder out(cloth);
    const float x = 0.5f * width;
    out.bevelledBox({-x, 0.06f, -0.42f}, {x, 0.32f, 0.42f}, 0.03f);
    out.bevelledBox({-x, 0.3f, -0.44f}, {x, 0.82f, -0.2f}, 0.05f);
    for (const float side : {-1.0f, 1.0f}) {
        const float a = side * x, b = side * (x - 0.2f);
        out.bevelledBox({std::min(a, b), 0.05f, -0.43f}, {std::max(a, b), 0.6f, 0.43f}, 0.05f);
        out.bevelledBox({side > 0 ? 0.008f : -x + 0.21f, 0.31f, -0.19f}, {side > 0 ? x - 0.21f : -0.008f, 0.46f, 0.41f},
                        0.04f);
    }
    addLegs(out, x - 0.1f, 0.34f, 0.08f, 0.025f);
    return addMesh(scene, "sofa", {std::move(out)});
}

int addBed(Scene& scene, int wood, int sheet, int blanket) {
    MeshBuilder frame(wood), white(sheet), top(blanket);
    frame.bevelledBox({-0.85f, 0.05f, -1.05f}, {0.85f, 0.3f, 1.05f}, 0.015f);
    frame.bevelledBox({-0.87f, 0.04f, -1.1f}, {0.87f, 1.0f, -1.03f}, 0.015f);
    white.bevelledBox({-0.81f, 0.29f, -1.02f}, {0.81f, 0.52f, 1.02f}, 0.04f);
    for (const float x : {-0.4f, 0.4f}) white.bevelledBox({x - 0.33f, 0.5f, -0.98f}, {x + 0.33f, 0.64f, -0.55f}, 0.06f);
    top.bevelledBox({-0.86f, 0.31f, -0.4f}, {0.86f, 0.56f, 1.06f}, 0.04f);
    return addMesh(scene, "bed", {std::move(frame), std::move(white), std::move(top)});
}

int addBookcase(Scene& scene, int wood, const std::vector<int>& books) {
    constexpr float kHalf = 0.6f, kDepth = 0.15f, kHeight = 1.95f;
    MeshBuilder frame(wood);
    for (const float x : {-kHalf, kHalf}) frame.box({x - 0.02f, 0, -kDepth}, {x + 0.02f, kHeight, kDepth});
    frame.box({-kHalf, 0.001f, -kDepth + 0.001f}, {kHalf, kHeight - 0.001f, -kDepth + 0.02f});
    std::vector<MeshBuilder> parts;
    for (const int material : books) parts.emplace_back(material);
    for (int shelf = 0; shelf < 6; ++shelf) {
        const float y = 0.05f + 0.37f * float(shelf);
        frame.box({-kHalf, y - 0.012f, -kDepth + 0.002f}, {kHalf, y + 0.012f, kDepth - 0.002f});
        if (shelf == 5) break;
        float x = -kHalf + 0.03f;
        for (int i = 0; x < kHalf - 0.09f - 0.3f * hash01(shelf, 99, 3); ++i) {
            const float thick = 0.022f + 0.035f * hash01(i, shelf, 1), tall = 0.2f + 0.11f * hash01(i, shelf, 2);
            const float deep = 0.16f + 0.08f * hash01(i, shelf, 4);
            const auto colour = std::size_t(hash01(i, shelf, 5) * float(parts.size()));
            parts[colour].box({x, y + 0.0125f, -0.12f}, {x + thick, y + 0.0125f + tall, -0.12f + deep});
            x += thick + 0.002f;
        }
    }
    parts.push_back(std::move(frame));
    return addMesh(scene, "bookcase", std::move(parts));
}

int addKitchenBlock(Scene& scene, int body, int top, float width) {
    MeshBuilder cabinet(body), slab(top);
    const float x = 0.5f * width;
    const int doors = int(width / 0.5f);
    cabinet.box({-x, 0, -0.3f}, {x, 0.88f, 0.26f});
    for (int i = 0; i < doors; ++i) {
        const float x0 = -x + width * float(i) / float(doors), x1 = -x + width * float(i + 1) / float(doors);
        cabinet.bevelledBox({x0 + 0.01f, 0.1f, 0.25f}, {x1 - 0.01f, 0.84f, 0.285f}, 0.008f);
        slab.box({x1 - 0.07f, 0.7f, 0.28f}, {x1 - 0.05f, 0.8f, 0.305f});
    }
    slab.bevelledBox({-x - 0.02f, 0.87f, -0.3f}, {x + 0.02f, 0.92f, 0.32f}, 0.008f);
    return addMesh(scene, "kitchen block", {std::move(cabinet), std::move(slab)});
}

int addLamp(Scene& scene, int foot, int shade) {
    MeshBuilder stand(foot), glow(shade);
    constexpr std::array<glm::vec2, 10> kStand{{{0, 0},
                                                {0.16f, 0},
                                                {0.16f, 0},
                                                {0.15f, 0.03f},
                                                {0.15f, 0.03f},
                                                {0.02f, 0.06f},
                                                {0.015f, 0.1f},
                                                {0.015f, 1.45f},
                                                {0.015f, 1.45f},
                                                {0, 1.45f}}};
    addLathe(stand, kStand, 24);
    constexpr std::array<glm::vec2, 6> kShade{
        {{0, 1.3f}, {0.2f, 1.3f}, {0.2f, 1.3f}, {0.13f, 1.6f}, {0.13f, 1.6f}, {0, 1.6f}}};
    addLathe(glow, kShade, 32);
    return addMesh(scene, "lamp", {std::move(stand), std::move(glow)});
}

int addTree(Scene& scene, int bark, int foliage, int seed) {
    MeshBuilder trunk(bark), crown(foliage);
    constexpr std::array<glm::vec2, 6> kTrunk{
        {{0, -0.3f}, {0.26f, -0.3f}, {0.17f, 0.3f}, {0.13f, 1.5f}, {0.08f, 3.0f}, {0, 3.4f}}};
    addLathe(trunk, kTrunk, 16, [](float angle, float) { return 1 + 0.08f * std::sin(5 * angle); });
    for (int i = 0; i < 9; ++i) {
        const auto random = [&](int k) { return hash01(i, k, seed); };
        const float angle = 0.8f * float(i), spread = i == 0 ? 0.0f : 1.0f;
        const glm::vec3 centre(spread * std::sin(angle), 3.0f + 0.9f * random(0) + (i == 0 ? 0.9f : 0.0f),
                               spread * std::cos(angle));
        const float size = 0.85f + 0.4f * random(1);
        crown.setTransform(glm::translate(glm::mat4(1), centre));
        addGeodesicSphere(crown, 4, [&](glm::vec3 n) {
            // Clumps of leaves: noise in three projections.
            const float clump = fractalNoise(0.5f + 0.4f * n.x, 0.5f + 0.4f * n.y, 9, 3, seed + i) +
                                fractalNoise(0.5f + 0.4f * n.y, 0.5f + 0.4f * n.z, 9, 3, seed + i + 40) +
                                fractalNoise(0.5f + 0.4f * n.z, 0.5f + 0.4f * n.x, 9, 3, seed + i + 80);
            return size * (0.05f + 0.65f * clump);
        });
    }
    return addMesh(scene, "tree", {std::move(trunk), std::move(crown)});
}

int addRug(Scene& scene, int material, float width, float depth) {
    MeshBuilder out(material);
    out.bevelledBox({-0.5f * width, 0, -0.5f * depth}, {0.5f * width, 0.015f, 0.5f * depth}, 0.005f);
    return addMesh(scene, "rug", {std::move(out)});
}

}  // namespace probegi::builtin

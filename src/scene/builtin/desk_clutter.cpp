#include "scene/builtin/desk_clutter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "scene/builtin/noise.h"
#include "scene/builtin/scene_parts.h"

namespace probegi::builtin {

namespace {

constexpr float kGap = 0.0005f;  // see block() in cornell.cpp

glm::mat4 turnedAt(glm::vec3 position, float yaw) {
    return glm::rotate(glm::translate(glm::mat4(1), position), yaw, glm::vec3(0, 1, 0));
}

// A bar from one point to another, square, `thick` metres.
void addBar(MeshBuilder& out, glm::vec3 from, glm::vec3 to, float thick) {
    const glm::vec3 axis = to - from;
    const float length = glm::length(axis);
    const glm::vec3 y = axis / length, x = glm::normalize(glm::cross(y, glm::vec3(0.3f, 0.1f, 1.0f))),
                    z = glm::cross(x, y);
    out.setTransform(glm::mat4(glm::vec4(x, 0), glm::vec4(y, 0), glm::vec4(z, 0), glm::vec4(from, 1)));
    out.box({-0.5f * thick, 0, -0.5f * thick}, {0.5f * thick, length, 0.5f * thick});
    out.setTransform(glm::mat4(1));
}

// A vessel with a wall: its outside, its rim, its inside.
void addVessel(MeshBuilder& out, float foot, float rim, float height, float wall, int segments) {
    const std::array<glm::vec2, 10> profile{{{0, 0},
                                             {foot, 0},
                                             {foot, 0},
                                             {rim, height},
                                             {rim, height},
                                             {rim - wall, height},
                                             {rim - wall, height},
                                             {foot - wall, wall},
                                             {foot - wall, wall},
                                             {0, wall}}};
    addLathe(out, profile, segments);
}

}  // namespace

int addMug(Scene& scene, int glaze) {
    MeshBuilder out(glaze);
    addVessel(out, 0.038f, 0.042f, 0.1f, 0.004f, 28);
    constexpr int kParts = 7;
    const auto at = [](int i) {
        const float angle = glm::pi<float>() * (float(i) / kParts - 0.5f);
        return glm::vec3(0.037f + 0.03f * std::cos(angle), 0.05f + 0.032f * std::sin(angle), 0);
    };
    for (int i = 0; i < kParts; ++i) addBar(out, at(i), at(i + 1), 0.009f);
    return addMesh(scene, "mug", {std::move(out)});
}

int addDeskLamp(Scene& scene, int metal, int bulb) {
    MeshBuilder stand(metal), glow(bulb);
    constexpr std::array<glm::vec2, 7> kFoot{
        {{0, 0}, {0.085f, 0}, {0.085f, 0}, {0.08f, 0.018f}, {0.08f, 0.018f}, {0.012f, 0.03f}, {0, 0.032f}}};
    addLathe(stand, kFoot, 32);
    addBar(stand, {0, 0.02f, 0}, {0, 0.3f, -0.1f}, 0.014f);
    addBar(stand, {0, 0.295f, -0.1f}, {0, 0.43f, 0.17f}, 0.012f);
    // A bell around the bulb, open below.
    constexpr std::array<glm::vec2, 9> kShade{{{0, 0.45f},
                                               {0.028f, 0.44f},
                                               {0.09f, 0.36f},
                                               {0.09f, 0.36f},
                                               {0.086f, 0.36f},
                                               {0.086f, 0.36f},
                                               {0.024f, 0.434f},
                                               {0.01f, 0.44f},
                                               {0, 0.441f}}};
    std::array<glm::vec2, kShade.size()> upwards = kShade;
    std::reverse(upwards.begin(), upwards.end());
    stand.setTransform(glm::translate(glm::mat4(1), glm::vec3(0, 0, 0.22f)));
    addLathe(stand, upwards, 32);
    glow.setTransform(glm::translate(glm::mat4(1), glm::vec3(0, 0.395f, 0.22f)) *
                      glm::scale(glm::mat4(1), glm::vec3(0.022f)));
    addGeodesicSphere(glow, 2, [](glm::vec3) { return 1.0f; });
    return addMesh(scene, "desk lamp", {std::move(stand), std::move(glow)});
}

int addOpenBox(Scene& scene, int card, glm::vec3 size) {
    MeshBuilder out(card);
    const float x = 0.5f * size.x, z = 0.5f * size.z, wall = 0.006f;
    out.box({-x, 0, -z}, {x, wall, z});
    for (const float side : {-1.0f, 1.0f}) {
        const float a = side * x, b = side * (x - wall), c = side * z, d = side * (z - wall);
        out.box({std::min(a, b), wall + kGap, -z}, {std::max(a, b), size.y, z});
        out.box({-x + wall + kGap, wall + kGap, std::min(c, d)}, {x - wall - kGap, size.y, std::max(c, d)});
    }
    return addMesh(scene, "carton", {std::move(out)});
}

int addPaperStack(Scene& scene, int paper, float height, int seed) {
    MeshBuilder out(paper);
    constexpr float kBundle = 0.012f;
    float y = 0;
    for (int i = 0; y + kBundle <= height; ++i, y += kBundle + kGap) {
        out.setTransform(turnedAt({0.02f * (hash01(i, 1, seed) - 0.5f), y, 0.02f * (hash01(i, 2, seed) - 0.5f)},
                                  0.2f * (hash01(i, 3, seed) - 0.5f)));
        out.box({-0.105f, 0, -0.148f}, {0.105f, kBundle, 0.148f});
    }
    return addMesh(scene, "paper", {std::move(out)});
}

int addBookPile(Scene& scene, const std::vector<int>& covers, int count, int seed) {
    std::vector<MeshBuilder> parts;
    for (const int material : covers) parts.emplace_back(material);
    float y = 0;
    for (int i = 0; i < count; ++i) {
        MeshBuilder& out = parts[std::size_t(hash01(i, 1, seed) * float(parts.size()))];
        const float thick = 0.018f + 0.03f * hash01(i, 2, seed), wide = 0.075f + 0.03f * hash01(i, 3, seed);
        out.setTransform(turnedAt({0.03f * (hash01(i, 4, seed) - 0.5f), y, 0.03f * (hash01(i, 5, seed) - 0.5f)},
                                  0.9f * (hash01(i, 6, seed) - 0.5f)));
        out.bevelledBox({-wide, 0, -1.45f * wide}, {wide, thick, 1.45f * wide}, 0.003f);
        y += thick + kGap;
    }
    std::erase_if(parts, [](const MeshBuilder& part) { return part.empty(); });
    return addMesh(scene, "books", std::move(parts));
}

int addBookRow(Scene& scene, const std::vector<int>& covers, int count, int seed) {
    std::vector<MeshBuilder> parts;
    for (const int material : covers) parts.emplace_back(material);
    float x = 0;
    for (int i = 0; i < count; ++i) {
        MeshBuilder& out = parts[std::size_t(hash01(i, 1, seed) * float(parts.size()))];
        const float thick = 0.016f + 0.03f * hash01(i, 2, seed), tall = 0.17f + 0.1f * hash01(i, 3, seed);
        const float deep = 0.11f + 0.05f * hash01(i, 4, seed);
        out.bevelledBox({x, 0, -0.08f}, {x + thick, tall, -0.08f + deep}, 0.003f);
        x += thick + 0.001f + 0.004f * hash01(i, 5, seed);
    }
    std::erase_if(parts, [](const MeshBuilder& part) { return part.empty(); });
    return addMesh(scene, "book row", std::move(parts));
}

int addBasket(Scene& scene, int wire) {
    MeshBuilder out(wire);
    addVessel(out, 0.11f, 0.15f, 0.3f, 0.005f, 32);
    return addMesh(scene, "basket", {std::move(out)});
}

}  // namespace probegi::builtin

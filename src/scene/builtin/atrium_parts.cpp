#include "scene/builtin/atrium_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <vector>

#include "scene/builtin/noise.h"

namespace probegi::builtin {

namespace {

constexpr float kPi = glm::pi<float>();
constexpr float kTau = glm::two_pi<float>();

/// A half-round moulding that bulges outwards by `bulge` between two heights, with sharp edges at both.
void addTorus(std::vector<glm::vec2>& profile, float radius, float y0, float y1, float bulge, int steps) {
    for (int i = 0; i <= steps; ++i) {
        const float t = float(i) / float(steps);
        const float y = 0.5f * (y0 + y1) - 0.5f * (y1 - y0) * std::cos(kPi * t);
        profile.emplace_back(radius + bulge * std::sin(kPi * t), y);
        if (i == 0 || i == steps) profile.push_back(profile.back());
    }
}

/// At ends and sharp edges the point is given twice (see addLathe).
void addEdge(std::vector<glm::vec2>& profile, float radius, float y) {
    profile.insert(profile.end(), 2, glm::vec2(radius, y));
}

/// A fluted shaft that tapers by a sixth, with entasis.
std::vector<glm::vec2> shaftProfile(const Column& c, float bottom, float top) {
    constexpr int kRings = 12;
    std::vector<glm::vec2> profile{{0, bottom}};
    for (int i = 0; i <= kRings; ++i) {
        const float t = float(i) / kRings;
        const float radius = c.radius * (1 - 0.16f * t + 0.05f * std::sin(kPi * t));
        profile.emplace_back(radius, bottom + t * (top - bottom));
        if (i == 0 || i == kRings) profile.push_back(profile.back());
    }
    profile.emplace_back(0, top);
    return profile;
}

void addShaft(MeshBuilder& out, const Column& c, float bottom, float top) {
    // Grooves fade out at both ends of the shaft.
    const auto flute = [&](float angle, float y) {
        const float end = std::min(y - bottom, top - y) / (0.25f * c.radius);
        const float depth = 0.075f * std::sqrt(std::clamp(end, 0.0f, 1.0f));
        return 1 - depth * std::abs(std::sin(0.5f * float(c.flutes) * angle));
    };
    addLathe(out, shaftProfile(c, bottom, top), c.flutes * c.stepsPerFlute, flute);
}

void addBase(MeshBuilder& out, float r, float plinth, float top) {
    std::vector<glm::vec2> profile{{0, plinth - 0.01f}};
    addEdge(profile, 1.3f * r, plinth - 0.01f);
    const float h = top - plinth;
    addTorus(profile, 1.3f * r, plinth, plinth + 0.42f * h, 0.12f * r, 6);
    addTorus(profile, 1.22f * r, plinth + 0.45f * h, plinth + 0.62f * h, -0.07f * r, 4);
    addTorus(profile, 1.16f * r, plinth + 0.65f * h, top, 0.09f * r, 5);
    addEdge(profile, 1.08f * r, top + 0.01f);
    profile.emplace_back(0, top + 0.01f);
    addLathe(out, profile, 40);
}

/// A bell with two rows of stylised leaves: lobes whose tips curl outwards.
void addCapital(MeshBuilder& out, float r, float bottom, float top) {
    constexpr int kRings = 18;
    const float h = top - bottom;
    std::vector<glm::vec2> profile{{0, bottom - 0.01f}};
    addEdge(profile, 0.86f * r, bottom - 0.01f);
    addTorus(profile, 0.9f * r, bottom, bottom + 0.08f * h, 0.07f * r, 6);
    for (int i = 0; i <= kRings; ++i) {
        const float t = float(i) / kRings;
        profile.emplace_back(r * (0.9f + 0.42f * t * t * t), bottom + h * (0.1f + 0.9f * t));
    }
    addEdge(profile, 1.32f * r, top);
    profile.emplace_back(0, top);
    const auto leaves = [=](float angle, float y) {
        const float t = std::clamp((y - bottom) / h, 0.0f, 1.0f);
        const auto row = [&](float from, float to, float shift) {
            const float s = (t - from) / (to - from);
            if (s <= 0 || s >= 1) return 0.0f;
            const float lobe = std::max(0.0f, std::cos(8 * angle + shift) * 0.75f + 0.25f * (1 - s));
            return lobe * s * s * (1 - std::pow(s, 10.0f));
        };
        return 1 + 0.2f * row(0.1f, 0.58f, 0) + 0.24f * row(0.3f, 0.95f, kPi);
    };
    addLathe(out, profile, 64, leaves);
}

}  // namespace

void addColumn(MeshBuilder& out, const Column& c) {
    const float r = c.radius, plinth = 0.4f * r, base = 1.15f * r;
    const float abacus = c.height - 0.32f * r, bell = abacus - 1.7f * r;
    out.bevelledBox({-1.42f * r, 0, -1.42f * r}, {1.42f * r, plinth, 1.42f * r}, 0.01f);
    addBase(out, r, plinth, base);
    addShaft(out, c, base, bell);
    addCapital(out, r, bell, abacus);
    out.bevelledBox({-1.4f * r, abacus - 0.005f, -1.4f * r}, {1.4f * r, c.height, 1.4f * r}, 0.015f);
}

void addBalustrade(MeshBuilder& out, float length, float height, int balusters) {
    const float half = 0.5f * length, foot = 0.1f, rail = height - 0.12f;
    out.bevelledBox({-half, 0, -0.1f}, {half, foot, 0.1f}, 0.012f);
    out.bevelledBox({-half, rail, -0.11f}, {half, height, 0.11f}, 0.02f);
    const float h = rail - foot;
    // Square-ish foot, pear-shaped belly, thin neck, ring, and a cap under the rail.
    constexpr std::array<glm::vec2, 15> kShape{{{0, -0.01f},
                                                {0.06f, -0.01f},
                                                {0.06f, -0.01f},
                                                {0.06f, 0.08f},
                                                {0.045f, 0.1f},
                                                {0.05f, 0.16f},
                                                {0.072f, 0.26f},
                                                {0.074f, 0.34f},
                                                {0.055f, 0.48f},
                                                {0.034f, 0.64f},
                                                {0.03f, 0.78f},
                                                {0.044f, 0.82f},
                                                {0.034f, 0.86f},
                                                {0.06f, 0.93f},
                                                {0.06f, 1.0f}}};
    std::vector<glm::vec2> profile;
    for (const glm::vec2& p : kShape) profile.emplace_back(p.x, foot + p.y * h);
    addEdge(profile, 0.06f, rail + 0.01f);
    profile.emplace_back(0, rail + 0.01f);
    for (int i = 0; i < balusters; ++i) {
        const float x = -half + (float(i) + 0.5f) * length / float(balusters);
        out.setTransform(glm::translate(glm::mat4(1), {x, 0, 0}));
        addLathe(out, profile, 14);
    }
    out.setTransform(glm::mat4(1));
}

void addCurtain(MeshBuilder& out, float width, float drop, int folds, float gather) {
    addSheet(out, 9 * folds, 28, {1, drop / width}, [=](float u, float v) {
        // Folds vary slightly, deepen downwards, and flatten where a band gathers the cloth.
        const float waist = gather * std::exp(-40 * (v - 0.62f) * (v - 0.62f));
        const float x = (u - 0.5f) * width * (1 - waist) + 0.5f * width * waist * 0.4f;
        const float wander = 0.5f * std::sin(3.1f * u + 2.0f * v) + 0.25f * std::sin(7 * u - 3 * v);
        const float depth = 0.035f + 0.05f * v - 0.02f * waist;
        const float z = depth * std::sin(kTau * float(folds) * u + wander) + 0.02f * std::sin(4 * v + 9 * u);
        const float hem = 0.015f * std::sin(kTau * float(folds) * u + 0.8f) * v;
        return glm::vec3(x, -drop * v + hem, z);
    });
}

void addThrow(MeshBuilder& out, float width, float drop) {
    // Side view: up the back of the rail, over it, down to the ledge, across it and down again.
    const std::array<glm::vec2, 8> path{{{-0.15f, -0.5f},
                                         {-0.15f, -0.02f},
                                         {-0.11f, 0.01f},
                                         {0.12f, 0.01f},
                                         {0.16f, -0.03f},
                                         {0.2f, -0.93f},
                                         {0.49f, -0.95f},
                                         {0.52f, -0.95f - drop}}};
    std::array<float, 8> along{};
    for (std::size_t i = 1; i < path.size(); ++i) along[i] = along[i - 1] + glm::length(path[i] - path[i - 1]);
    const float length = along.back();
    const auto onPath = [=](float s) {
        std::size_t i = 1;
        while (i + 1 < path.size() && along[i] < s) ++i;
        return glm::mix(path[i - 1], path[i], (s - along[i - 1]) / (along[i] - along[i - 1]));
    };
    addSheet(out, 36, 56, {1, length / width}, [=](float u, float v) {
        const float s = v * length;
        // Averaging over a hand's breadth rounds the path's corners, since cloth does not crease.
        const glm::vec2 p = 0.25f * (onPath(s - 0.03f) + onPath(s - 0.01f) + onPath(s + 0.01f) + onPath(s + 0.03f));
        const float free = std::clamp((s - along[4]) / 0.5f, 0.0f, 1.0f) * (0.35f + 0.65f * v);
        const float fold = std::sin(11 * u + 0.7f * s) + 0.5f * std::sin(23 * u - 0.5f * s + 1) + 1.2f;
        return glm::vec3((u - 0.5f) * width * (1 - 0.05f * free * v), p.y, p.x + 0.03f * free * fold);
    });
}

void addPot(MeshBuilder& out, float radius, float height) {
    const float r = radius, h = height, earth = 0.9f * h;
    std::vector<glm::vec2> profile{{0, 0}};
    addEdge(profile, 0.62f * r, 0);
    for (int i = 1; i <= 8; ++i) {
        const float t = float(i) / 8;
        profile.emplace_back(r * (0.62f + 0.33f * std::sin(0.5f * kPi * t) + 0.05f * t), 0.82f * h * t);
    }
    addEdge(profile, r, 0.82f * h);
    addEdge(profile, 1.1f * r, 0.84f * h);
    addEdge(profile, 1.1f * r, h);
    addEdge(profile, 0.94f * r, h);
    addEdge(profile, 0.9f * r, earth);
    profile.emplace_back(0, earth);
    addLathe(out, profile, 32);
}

void addFronds(MeshBuilder& out, int count, float length, int seed) {
    for (int i = 0; i < count; ++i) {
        const auto random = [&](int k) { return hash01(i, k, seed); };
        // The golden angle spreads the leaves evenly; the outer ones are older, longer and bend further.
        const float age = (float(i) + 0.5f) / float(count);
        const float angle = 2.39996f * float(i) + 0.4f * random(0);
        const float reach = length * (0.55f + 0.45f * age) * (0.85f + 0.3f * random(1));
        const float rise = 1.35f - 0.65f * age, sag = 0.45f + 0.45f * age;
        const float width = 0.16f * length * (0.8f + 0.4f * random(2));
        const glm::vec3 along(std::sin(angle), 0, std::cos(angle)), side(along.z, 0, -along.x);
        const float tilt = 0.5f * (random(3) - 0.5f);
        addSheet(out, 2, 8, {1, 1}, [=](float u, float v) {
            const float t = 1 - v;  // the image's leaf grows from v = 1
            const float across = (u - 0.5f) * width;
            const glm::vec3 spine =
                along * (reach * (0.1f + 0.9f * t) * 0.72f) + glm::vec3(0, reach * (rise * t - sag * t * t), 0);
            return spine + side * across + glm::vec3(0, std::abs(across) * 0.35f + across * tilt, 0);
        });
    }
}

void addFountain(MeshBuilder& out) {
    std::vector<glm::vec2> basin{{0, 0}};
    addEdge(basin, 1.5f, 0);
    addEdge(basin, 1.5f, 0.12f);
    addEdge(basin, 1.36f, 0.14f);
    addTorus(basin, 1.36f, 0.16f, 0.42f, -0.05f, 8);
    addTorus(basin, 1.4f, 0.43f, 0.55f, 0.06f, 8);
    addEdge(basin, 1.22f, 0.55f);
    addEdge(basin, 1.2f, 0.15f);
    basin.emplace_back(0, 0.15f);
    addLathe(out, basin, 64);

    std::vector<glm::vec2> bowl{{0, 0.14f}};
    addEdge(bowl, 0.34f, 0.14f);
    addTorus(bowl, 0.26f, 0.3f, 0.42f, 0.05f, 6);
    for (int i = 0; i <= 8; ++i)
        bowl.emplace_back(0.14f + 0.05f * std::sin(kPi * float(i) / 8), 0.45f + 0.07f * float(i));
    for (int i = 1; i <= 12; ++i) {
        const float t = float(i) / 12;
        bowl.emplace_back(0.14f + 0.66f * std::sin(0.5f * kPi * t), 1.01f + 0.26f * (1 - std::cos(0.5f * kPi * t)));
    }
    addTorus(bowl, 0.8f, 1.28f, 1.34f, 0.03f, 6);
    addEdge(bowl, 0.74f, 1.34f);
    for (int i = 8; i >= 1; --i) {
        const float t = float(i) / 8;
        bowl.emplace_back(0.74f * std::sin(0.5f * kPi * t), 1.14f + 0.16f * (1 - std::cos(0.5f * kPi * t)));
    }
    bowl.emplace_back(0, 1.14f);
    const auto gadroons = [](float angle, float y) {
        const float amount = std::clamp((y - 1.03f) / 0.1f, 0.0f, 1.0f) * std::clamp((1.27f - y) / 0.06f, 0.0f, 1.0f);
        return 1 + 0.03f * amount * std::cos(20 * angle);
    };
    addLathe(out, bowl, 80, gadroons);
}

void addWater(MeshBuilder& out) {
    constexpr std::array<glm::vec2, 6> kBasin{
        {{0, 0.151f}, {1.15f, 0.151f}, {1.195f, 0.44f}, {1.195f, 0.44f}, {1.19f, 0.445f}, {0, 0.445f}}};
    addLathe(out, kBasin, 64);
    constexpr std::array<glm::vec2, 5> kBowl{{{0, 1.2f}, {0.6f, 1.24f}, {0.71f, 1.29f}, {0.71f, 1.29f}, {0, 1.292f}}};
    addLathe(out, kBowl, 64);
}

void addUrn(MeshBuilder& out) {
    out.bevelledBox({-0.36f, 0, -0.36f}, {0.36f, 0.16f, 0.36f}, 0.015f);
    out.bevelledBox({-0.29f, 0.15f, -0.29f}, {0.29f, 0.85f, 0.29f}, 0.01f);
    out.bevelledBox({-0.36f, 0.84f, -0.36f}, {0.36f, 0.95f, 0.36f}, 0.015f);
    std::vector<glm::vec2> profile{{0, 0.94f}};
    addEdge(profile, 0.2f, 0.94f);
    addTorus(profile, 0.19f, 0.96f, 1.02f, 0.02f, 6);
    profile.emplace_back(0.09f, 1.1f);
    for (int i = 0; i <= 14; ++i) {
        const float t = float(i) / 14;
        profile.emplace_back(0.09f + 0.24f * std::pow(std::sin(kPi * std::pow(t, 0.75f) * 0.86f), 0.8f) + 0.09f * t,
                             1.14f + 0.56f * t);
    }
    addTorus(profile, 0.24f, 1.72f, 1.78f, 0.05f, 6);
    addEdge(profile, 0.2f, 1.78f);
    profile.emplace_back(0.16f, 1.6f);
    profile.emplace_back(0, 1.55f);
    addLathe(out, profile, 40);
}

}  // namespace probegi::builtin

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <map>
#include <vector>

#include "scene/builtin/mesh_builder.h"

namespace probegi::builtin {

namespace {

constexpr float kTau = glm::two_pi<float>();

/// Tangent at a profile point, from its neighbours; a point given twice has none on that side.
glm::vec2 profileTangent(std::span<const glm::vec2> profile, std::size_t i) {
    const bool before = i > 0 && profile[i - 1] != profile[i];
    const bool after = i + 1 < profile.size() && profile[i + 1] != profile[i];
    const glm::vec2 a = before ? profile[i - 1] : profile[i];
    const glm::vec2 b = after ? profile[i + 1] : profile[i];
    // The middle of three equal points; no triangle uses it.
    return a == b ? glm::vec2(0, 1) : b - a;
}

}  // namespace

void addLathe(MeshBuilder& out, std::span<const glm::vec2> profile, int segments, const RadiusFactor& factor) {
    const auto point = [&](int segment, glm::vec2 rh) {
        // The last column repeats the first one exactly, so that the seam is closed.
        const float angle = kTau * float(segment % segments) / float(segments);
        const float r = factor ? rh.x * factor(angle, rh.y) : rh.x;
        return glm::vec3(r * std::sin(angle), rh.y, r * std::cos(angle));
    };
    float maxRadius = 0;
    for (const glm::vec2& rh : profile) maxRadius = std::max(maxRadius, rh.x);

    const auto stride = std::uint32_t(segments + 1);
    std::uint32_t first = 0;
    float along = 0;
    for (std::size_t i = 0; i < profile.size(); ++i) {
        if (i > 0) along += glm::length(profile[i] - profile[i - 1]);
        const glm::vec2 tangent = profileTangent(profile, i);
        for (int s = 0; s <= segments; ++s) {
            // On the axis, the tangential direction is that of a small circle.
            const glm::vec2 rh(std::max(profile[i].x, 1e-3f * maxRadius), profile[i].y);
            const glm::vec3 around = point(s + 1, rh) - point(s + segments - 1, rh);
            const float radial = rh.x > 0 ? glm::length(glm::vec2(point(s, rh).x, point(s, rh).z)) / rh.x : 1.0f;
            const float angle = kTau * float(s) / float(segments);
            const glm::vec3 up(radial * tangent.x * std::sin(angle), tangent.y, radial * tangent.x * std::cos(angle));
            const glm::vec2 uv(maxRadius * angle, -along);
            const std::uint32_t index = out.vertex(point(s, profile[i]), glm::cross(around, up), uv);
            if (i == 0 && s == 0) first = index;
        }
    }
    for (std::uint32_t i = 0; i + 1 < profile.size(); ++i) {
        for (std::uint32_t s = 0; s < std::uint32_t(segments); ++s) {
            const std::uint32_t a = first + i * stride + s, b = a + 1, c = a + stride, d = c + 1;
            out.triangle(a, b, d);
            out.triangle(a, d, c);
        }
    }
}

void addArcade(MeshBuilder& out, const Arcade& arcade) {
    const float z = 0.5f * arcade.depth;
    const float length = float(arcade.bays) * arcade.bayWidth;
    // Lower outline from left to right: flat over the piers, round over the openings.
    std::vector<glm::vec2> edge{{0, arcade.springing}};
    std::vector<bool> curved;  // per step of the outline
    for (int bay = 0; bay < arcade.bays; ++bay) {
        const float centre = (float(bay) + 0.5f) * arcade.bayWidth;
        for (int s = 0; s <= arcade.segments; ++s) {
            const float angle = glm::pi<float>() * (1.0f - float(s) / float(arcade.segments));
            const bool end = s == 0 || s == arcade.segments;
            edge.emplace_back(centre + arcade.radius * (end ? (s == 0 ? -1.0f : 1.0f) : std::cos(angle)),
                              arcade.springing + (end ? 0.0f : arcade.radius * std::sin(angle)));
            curved.push_back(s > 0);
        }
    }
    edge.emplace_back(length, arcade.springing);
    curved.push_back(false);

    const auto centreOf = [&](float x) { return (std::floor(x / arcade.bayWidth) + 0.5f) * arcade.bayWidth; };
    float along = 0;
    for (std::size_t i = 0; i + 1 < edge.size(); ++i) {
        const glm::vec2 a = edge[i], b = edge[i + 1];
        const glm::vec2 ta(a.x, arcade.top), tb(b.x, arcade.top);
        out.quad({a, z}, {b, z}, {tb, z}, {ta, z});
        out.quad({b, -z}, {a, -z}, {ta, -z}, {tb, -z});
        out.quad({ta, z}, {tb, z}, {tb, -z}, {ta, -z});
        const float step = glm::length(b - a);
        const float centre = centreOf(0.5f * (a.x + b.x));
        const auto normal = [&](glm::vec2 p) {
            return curved[i] ? glm::vec3(centre - p.x, arcade.springing - p.y, 0) : glm::vec3(0, -1, 0);
        };
        const std::uint32_t v0 = out.vertex({a, -z}, normal(a), {along, -z});
        const std::uint32_t v1 = out.vertex({b, -z}, normal(b), {along + step, -z});
        const std::uint32_t v2 = out.vertex({b, z}, normal(b), {along + step, z});
        const std::uint32_t v3 = out.vertex({a, z}, normal(a), {along, z});
        out.triangle(v0, v1, v2);
        out.triangle(v0, v2, v3);
        along += step;
    }
    const float y0 = arcade.springing, y1 = arcade.top;
    out.quad({0, y0, -z}, {0, y0, z}, {0, y1, z}, {0, y1, -z});
    out.quad({length, y0, z}, {length, y0, -z}, {length, y1, -z}, {length, y1, z});
}

void addGeodesicSphere(MeshBuilder& out, int levels, const std::function<float(glm::vec3)>& radius) {
    const float g = glm::golden_ratio<float>();
    std::vector<glm::vec3> points{{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                                  {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    for (glm::vec3& p : points) p = glm::normalize(p);
    using Triangle = std::array<std::uint32_t, 3>;
    std::vector<Triangle> triangles{{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                                    {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                                    {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
    for (int level = 0; level < levels; ++level) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
        const auto middle = [&](std::uint32_t a, std::uint32_t b) {
            const auto [it, isNew] = middles.try_emplace(std::minmax(a, b), std::uint32_t(points.size()));
            if (isNew) points.push_back(glm::normalize(points[a] + points[b]));
            return it->second;
        };
        std::vector<Triangle> finer;
        finer.reserve(4 * triangles.size());
        for (const auto& [a, b, c] : triangles) {
            const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            finer.insert(finer.end(),
                         {Triangle{a, ab, ca}, Triangle{ab, b, bc}, Triangle{ca, bc, c}, Triangle{ab, bc, ca}});
        }
        triangles = std::move(finer);
    }
    std::uint32_t first = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const glm::vec3 p = points[i];
        const glm::vec2 uv(std::atan2(p.x, p.z), std::acos(std::clamp(p.y, -1.0f, 1.0f)));
        const std::uint32_t index = out.vertex(radius(p) * p, p, uv);
        if (i == 0) first = index;
    }
    for (const auto& [a, b, c] : triangles) out.triangle(first + a, first + b, first + c);
}

}  // namespace probegi::builtin

#include "scene/builtin/mesh_builder.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace probegi::builtin {

namespace {

glm::vec2 projectedUv(glm::vec3 p, glm::vec3 normal) {
    const glm::vec3 n = glm::abs(normal);
    if (n.y >= n.x && n.y >= n.z) return {p.x, p.z};
    return n.x > n.z ? glm::vec2(p.z, -p.y) : glm::vec2(p.x, -p.y);
}

}  // namespace

std::uint32_t MeshBuilder::vertex(glm::vec3 position, glm::vec3 normal, glm::vec2 uv) {
    m_primitive.positions.push_back(glm::vec3(m_transform * glm::vec4(position, 1)));
    m_primitive.normals.push_back(glm::normalize(glm::vec3(m_transform * glm::vec4(normal, 0))));
    m_primitive.uv0.push_back(uv);
    return std::uint32_t(m_primitive.positions.size() - 1);
}

void MeshBuilder::triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const auto& p = m_primitive.positions;
    if (p[a] == p[b] || p[b] == p[c] || p[c] == p[a]) return;
    m_primitive.indices.insert(m_primitive.indices.end(), {a, b, c});
}

void MeshBuilder::face(std::span<const glm::vec3> corners) {
    // Newell's sum gives the normal even if the first corners are collinear.
    glm::vec3 normal(0);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        normal += glm::cross(corners[i] - corners[0], corners[(i + 1) % corners.size()] - corners[0]);
    }
    normal = glm::normalize(normal);
    const auto first = std::uint32_t(m_primitive.positions.size());
    for (const glm::vec3& p : corners) vertex(p, normal, projectedUv(p, normal));
    for (std::uint32_t i = 2; i < corners.size(); ++i) triangle(first, first + i - 1, first + i);
}

void MeshBuilder::quad(glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d) {
    const std::array corners{a, b, c, d};
    face(corners);
}

void MeshBuilder::box(glm::vec3 lo, glm::vec3 hi) {
    quad({hi.x, lo.y, hi.z}, {hi.x, lo.y, lo.z}, {hi.x, hi.y, lo.z}, {hi.x, hi.y, hi.z});
    quad({lo.x, lo.y, lo.z}, {lo.x, lo.y, hi.z}, {lo.x, hi.y, hi.z}, {lo.x, hi.y, lo.z});
    quad({lo.x, hi.y, hi.z}, {hi.x, hi.y, hi.z}, {hi.x, hi.y, lo.z}, {lo.x, hi.y, lo.z});
    quad({lo.x, lo.y, lo.z}, {hi.x, lo.y, lo.z}, {hi.x, lo.y, hi.z}, {lo.x, lo.y, hi.z});
    quad({lo.x, lo.y, hi.z}, {hi.x, lo.y, hi.z}, {hi.x, hi.y, hi.z}, {lo.x, hi.y, hi.z});
    quad({hi.x, lo.y, lo.z}, {lo.x, lo.y, lo.z}, {lo.x, hi.y, lo.z}, {hi.x, hi.y, lo.z});
}

void MeshBuilder::bevelledBox(glm::vec3 lo, glm::vec3 hi, float bevel) {
    const glm::vec3 centre = 0.5f * (lo + hi);
    // Corner with sign s, cut along every axis but `axis`.
    const auto corner = [&](int axis, glm::vec3 s) {
        glm::vec3 p;
        for (int k = 0; k < 3; ++k) {
            const float inset = k == axis ? 0.0f : bevel;
            p[k] = s[k] > 0 ? hi[k] - inset : lo[k] + inset;
        }
        return p;
    };
    const auto outward = [&](std::array<glm::vec3, 4> c, int count) {
        const glm::vec3 n = glm::cross(c[1] - c[0], c[2] - c[0]);
        if (glm::dot(n, c[0] - centre) < 0) count == 4 ? std::swap(c[1], c[3]) : std::swap(c[1], c[2]);
        face(std::span(c.data(), std::size_t(count)));
    };
    for (int axis = 0; axis < 3; ++axis) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        for (const float sign : {-1.0f, 1.0f}) {
            glm::vec3 s(0);
            s[axis] = sign;
            std::array<glm::vec3, 4> c;
            constexpr float kU[] = {-1, 1, 1, -1}, kV[] = {-1, -1, 1, 1};
            for (std::size_t k = 0; k < 4; ++k) {
                s[u] = kU[k], s[v] = kV[k];
                c[k] = corner(axis, s);
            }
            outward(c, 4);
            // The strip along the edge between the faces of `axis` and `u`, on both sides of u.
            for (const float other : {-1.0f, 1.0f}) {
                glm::vec3 a = s, b = s;
                a[u] = b[u] = other;
                a[v] = -1, b[v] = 1;
                outward({corner(axis, a), corner(axis, b), corner(u, b), corner(u, a)}, 4);
            }
        }
    }
    for (int k = 0; k < 8; ++k) {
        const glm::vec3 s(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1);
        outward({corner(0, s), corner(1, s), corner(2, s), corner(2, s)}, 3);
    }
}

void addPrism(MeshBuilder& out, std::span<const glm::vec2> outline, float x0, float x1) {
    std::vector<glm::vec3> front, back;
    for (const glm::vec2& p : outline) front.emplace_back(x1, p.y, p.x);
    for (std::size_t i = outline.size(); i-- > 0;) back.emplace_back(x0, outline[i].y, outline[i].x);
    // (z, y) counter-clockwise seen from +X, where z runs to the left.
    out.face(front);
    out.face(back);
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const glm::vec2 a = outline[i], b = outline[(i + 1) % outline.size()];
        out.quad({x1, a.y, a.x}, {x0, a.y, a.x}, {x0, b.y, b.x}, {x1, b.y, b.x});
    }
}

void addSheet(MeshBuilder& out, int columns, int rows, glm::vec2 uvSize,
              const std::function<glm::vec3(float, float)>& at) {
    constexpr float kStep = 1e-3f;
    std::uint32_t first = 0;
    for (int row = 0; row <= rows; ++row) {
        for (int column = 0; column <= columns; ++column) {
            const float u = float(column) / float(columns), v = float(row) / float(rows);
            const glm::vec3 du = at(u + kStep, v) - at(u - kStep, v);
            const glm::vec3 dv = at(u, v + kStep) - at(u, v - kStep);
            const std::uint32_t index = out.vertex(at(u, v), glm::cross(dv, du), glm::vec2(u, v) * uvSize);
            if (row == 0 && column == 0) first = index;
        }
    }
    const auto stride = std::uint32_t(columns + 1);
    for (std::uint32_t row = 0; row < std::uint32_t(rows); ++row) {
        for (std::uint32_t column = 0; column < std::uint32_t(columns); ++column) {
            const std::uint32_t a = first + row * stride + column, b = a + 1, c = a + stride, d = c + 1;
            out.triangle(a, c, d);
            out.triangle(a, d, b);
        }
    }
}

}  // namespace probegi::builtin

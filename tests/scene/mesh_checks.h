#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/geometric.hpp>
#include <tuple>
#include <vector>

#include "probegi/scene.h"

namespace probegi::test {

/// The triangles of a mesh's single-sided primitives, with equal positions merged into one vertex.
struct WeldedMesh {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;
};

inline WeldedMesh weld(const Scene& scene, const Mesh& mesh) {
    WeldedMesh out;
    for (const Primitive& p : mesh.primitives) {
        if (scene.materials[std::size_t(p.material)].doubleSided) continue;
        // Adding zero turns -0 into 0.
        for (const std::uint32_t i : p.indices) out.positions.push_back(p.positions[i] + glm::vec3(0));
    }
    const auto less = [](glm::vec3 a, glm::vec3 b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); };
    std::vector<glm::vec3> unique = out.positions;
    std::sort(unique.begin(), unique.end(), less);
    unique.erase(std::unique(unique.begin(), unique.end()), unique.end());
    for (const glm::vec3& p : out.positions) {
        out.indices.push_back(std::uint32_t(std::lower_bound(unique.begin(), unique.end(), p, less) - unique.begin()));
    }
    out.positions = std::move(unique);
    return out;
}

/// Edges not matched by edges of opposite direction: none in a closed, consistently oriented surface.
inline std::size_t openEdges(const WeldedMesh& mesh) {
    struct Edge {
        std::uint32_t low, high;
        int direction;
    };
    std::vector<Edge> edges;
    for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
        const std::uint32_t a = mesh.indices[i], b = mesh.indices[i % 3 == 2 ? i - 2 : i + 1];
        edges.push_back(a < b ? Edge{a, b, 1} : Edge{b, a, -1});
    }
    std::sort(edges.begin(), edges.end(),
              [](const Edge& a, const Edge& b) { return std::tie(a.low, a.high) < std::tie(b.low, b.high); });
    std::size_t open = 0;
    for (std::size_t i = 0; i < edges.size();) {
        int sum = 0;
        const Edge first = edges[i];
        for (; i < edges.size() && edges[i].low == first.low && edges[i].high == first.high; ++i) {
            sum += edges[i].direction;
        }
        if (sum != 0) ++open;
    }
    return open;
}

/// Enclosed volume, positive if the fronts face outwards.
inline double signedVolume(const WeldedMesh& mesh) {
    double volume = 0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const glm::dvec3 a(mesh.positions[mesh.indices[i]]), b(mesh.positions[mesh.indices[i + 1]]),
            c(mesh.positions[mesh.indices[i + 2]]);
        volume += glm::dot(a, glm::cross(b, c)) / 6;
    }
    return volume;
}

/// A scene of one white material and one mesh, placed at the origin.
inline Scene sceneOf(Primitive primitive) {
    Scene scene;
    scene.materials.emplace_back();
    Mesh mesh;
    mesh.primitives.push_back(std::move(primitive));
    scene.meshes.push_back(std::move(mesh));
    Node node;
    node.mesh = 0;
    scene.addNode(std::move(node));
    return scene;
}

/// One triangle in the plane z = 0.
inline Primitive triangle() {
    Primitive p;
    p.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    p.indices = {0, 1, 2};
    return p;
}

}  // namespace probegi::test

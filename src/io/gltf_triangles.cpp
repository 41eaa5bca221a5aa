#include "io/gltf_triangles.h"

#include <algorithm>

namespace probegi::io {

std::vector<std::uint32_t> toTriangles(std::vector<std::uint32_t> vertices, Topology topology) {
    if (topology == Topology::triangles) {
        vertices.resize(vertices.size() / 3 * 3);
        return vertices;
    }
    std::vector<std::uint32_t> corners;
    if (vertices.size() < 3) return corners;
    corners.reserve(3 * (vertices.size() - 2));
    for (std::size_t i = 0; i + 2 < vertices.size(); ++i) {
        // Every second triangle of a strip has the opposite winding.
        const bool flip = topology == Topology::strip && i % 2 == 1;
        corners.push_back(topology == Topology::fan ? vertices[0] : vertices[i]);
        corners.push_back(vertices[flip ? i + 2 : i + 1]);
        corners.push_back(vertices[flip ? i + 1 : i + 2]);
    }
    return corners;
}

std::vector<std::uint32_t> compactVertices(std::vector<std::uint32_t>& corners, std::size_t vertices) {
    std::vector<std::uint32_t> used;
    if (vertices <= 8 * corners.size()) {
        std::vector<bool> marked(vertices, false);
        for (const std::uint32_t c : corners) marked[c] = true;
        for (std::size_t v = 0; v < vertices; ++v) {
            if (marked[v]) used.push_back(std::uint32_t(v));
        }
    } else {  // a few of a huge list: the work must not grow with the list
        used = corners;
        std::sort(used.begin(), used.end());
        used.erase(std::unique(used.begin(), used.end()), used.end());
    }
    if (used.size() == vertices) return used;
    for (std::uint32_t& c : corners) {
        c = std::uint32_t(std::lower_bound(used.begin(), used.end(), c) - used.begin());
    }
    return used;
}

}  // namespace probegi::io

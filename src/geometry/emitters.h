#pragma once

#include <glm/mat4x4.hpp>
#include <vector>

#include "probegi/tracer.h"

namespace probegi {

/// The emissive triangles of a scene in mesh space, from which placed() makes an EmitterSet.
class EmitterGeometry {
public:
    EmitterGeometry() = default;
    /// The scene must be valid; it is read during the call only.
    EmitterGeometry(const Scene& scene, const ScenePose& pose);

    bool empty() const noexcept { return m_triangles.empty(); }
    /// Moves a node's instance. Returns whether it emits light.
    bool place(int node, const glm::mat4& toWorld);
    /// The set for the current placement. Always the same triangles in the same order, unless nothing emits.
    EmitterSet placed() const;

private:
    struct Triangle {
        glm::vec3 corner[3];
        std::int32_t material;
    };
    struct Group {
        int node;
        glm::mat4 toWorld;
        std::size_t first, count;  // triangles
    };

    void append(const Primitive& primitive);

    std::vector<float> m_luminance;  // by material
    std::vector<Triangle> m_triangles;
    std::vector<Group> m_groups;
};

}  // namespace probegi

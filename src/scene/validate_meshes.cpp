#include <glm/common.hpp>

#include "scene/checks.h"

namespace probegi {

using namespace checks;

namespace {

/// Normals and tangents must only be finite: files contain ones not quite of unit length, or zero, and interpolation
/// must normalise anyway.
template <class T>
Result<void> validateAttribute(const std::string& what, const char* name, const std::vector<T>& values,
                               std::size_t vertices) {
    if (!values.empty() && values.size() != vertices) {
        return malformed(what, ": ", values.size(), " ", name, " for ", vertices,
                         " positions; there must be as many, or none");
    }
    for (std::size_t v = 0; v < values.size(); ++v) {
        if (!finite(values[v])) return malformed(what, ": vertex ", v, " has ", name, " that are not finite");
    }
    return {};
}

Result<void> validateIndices(const std::string& what, const Primitive& p) {
    if (p.indices.size() % 3 != 0) {
        return malformed(what, ": ", p.indices.size(), " indices are not a whole number of triangles");
    }
    for (std::size_t i = 0; i < p.indices.size(); ++i) {
        if (p.indices[i] >= p.positions.size()) {
            return malformed(what, ": index ", i, " is vertex ", p.indices[i], ", but there are ", p.positions.size());
        }
    }
    return {};
}

Result<void> validatePrimitive(const Scene& scene, const std::string& what, const Primitive& p) {
    if (p.material < 0 || std::size_t(p.material) >= scene.materials.size()) {
        return malformed(what, ": uses material ", p.material, ", but the scene has ", scene.materials.size());
    }
    const std::size_t vertices = p.positions.size();
    if (auto r = validateAttribute(what, "positions", p.positions, vertices); !r) return r;
    for (std::size_t v = 0; v < vertices; ++v) {
        const glm::vec3 a = glm::abs(p.positions[v]);
        if (a.x > 1e18f || a.y > 1e18f || a.z > 1e18f) {
            return malformed(what, ": vertex ", v, " at ", text(p.positions[v]), " is too far away");
        }
    }
    if (auto r = validateAttribute(what, "normals", p.normals, vertices); !r) return r;
    if (auto r = validateAttribute(what, "tangents", p.tangents, vertices); !r) return r;
    if (auto r = validateAttribute(what, "uv0 coordinates", p.uv0, vertices); !r) return r;
    if (auto r = validateAttribute(what, "uv1 coordinates", p.uv1, vertices); !r) return r;
    return validateIndices(what, p);
}

}  // namespace

Result<void> validateMeshes(const Scene& scene) {
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        const Mesh& mesh = scene.meshes[m];
        for (std::size_t p = 0; p < mesh.primitives.size(); ++p) {
            const std::string what = sentence(title("mesh", m, mesh.name), ", primitive ", p);
            if (auto r = validatePrimitive(scene, what, mesh.primitives[p]); !r) return r;
        }
    }
    return {};
}

}  // namespace probegi

#include <glm/common.hpp>

#include "scene/checks.h"

namespace probegi {

using namespace checks;

namespace {

/// Normals and tangents are checked for being finite only: files bring ones that are a little off unit length, or zero,
/// and whoever interpolates them has to normalise anyway.
template <class T>
Result<void> validateAttribute(const std::string& what, const char* name, const std::vector<T>& values,
                               std::size_t vertices) {
    if (!values.empty() && values.size() != vertices) {
        return malformed("{}: {} {} for {} positions; there must be as many, or none", what, values.size(), name,
                         vertices);
    }
    for (std::size_t v = 0; v < values.size(); ++v) {
        if (!finite(values[v])) return malformed("{}: vertex {} has {} that are not finite", what, v, name);
    }
    return {};
}

Result<void> validateIndices(const std::string& what, const Primitive& p) {
    if (p.indices.size() % 3 != 0) {
        return malformed("{}: {} indices are not a whole number of triangles", what, p.indices.size());
    }
    for (std::size_t i = 0; i < p.indices.size(); ++i) {
        if (p.indices[i] >= p.positions.size()) {
            return malformed("{}: index {} is vertex {}, but there are {}", what, i, p.indices[i], p.positions.size());
        }
    }
    return {};
}

Result<void> validatePrimitive(const Scene& scene, const std::string& what, const Primitive& p) {
    if (p.material < 0 || std::size_t(p.material) >= scene.materials.size()) {
        return malformed("{}: uses material {}, but the scene has {}", what, p.material, scene.materials.size());
    }
    const std::size_t vertices = p.positions.size();
    if (auto r = validateAttribute(what, "positions", p.positions, vertices); !r) return r;
    for (std::size_t v = 0; v < vertices; ++v) {
        const glm::vec3 a = glm::abs(p.positions[v]);
        if (a.x > 1e18f || a.y > 1e18f || a.z > 1e18f) {
            return malformed("{}: vertex {} at {} is too far away", what, v, text(p.positions[v]));
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
            const std::string what = fmt::format("{}, primitive {}", title("mesh", m, mesh.name), p);
            if (auto r = validatePrimitive(scene, what, mesh.primitives[p]); !r) return r;
        }
    }
    return {};
}

}  // namespace probegi

#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <optional>

#include "io/gltf_accessor.h"
#include "io/gltf_draco.h"
#include "io/gltf_import.h"
#include "io/gltf_triangles.h"

namespace probegi::io {

namespace {

/// The attributes of one primitive, wherever they are stored.
class VertexSource {
public:
    VertexSource(Import& import, const tinygltf::Primitive& primitive) : m_model(import.model), m_primitive(primitive) {
        const auto* extension = findExtension(primitive.extensions, "KHR_draco_mesh_compression");
        if (!extension) return;
        m_draco = decodeDraco(m_model, primitive, *extension);
        import.geometry.charge(m_draco->indices.size() * sizeof(std::uint32_t));
        for (const auto& [name, attribute] : m_draco->attributes) {
            import.geometry.charge(attribute.values.size() * sizeof(float));
        }
    }

    const std::optional<DracoPrimitive>& draco() const { return m_draco; }

    std::optional<AccessorView> find(const std::string& name) const {
        if (m_draco) {
            const auto found = m_draco->attributes.find(name);
            if (found != m_draco->attributes.end()) return AccessorView(found->second.values, found->second.components);
        }
        const auto found = m_primitive.attributes.find(name);
        if (found == m_primitive.attributes.end()) return {};
        return AccessorView(m_model, found->second);
    }

private:
    const tinygltf::Model& m_model;
    const tinygltf::Primitive& m_primitive;
    std::optional<DracoPrimitive> m_draco;
};

std::optional<Topology> topologyOf(int mode) {
    switch (mode) {
        case TINYGLTF_MODE_TRIANGLES:
            return Topology::triangles;
        case TINYGLTF_MODE_TRIANGLE_STRIP:
            return Topology::strip;
        case TINYGLTF_MODE_TRIANGLE_FAN:
            return Topology::fan;
        default:
            return {};
    }
}

/// The vertices in drawing order, each below `vertices`.
std::vector<std::uint32_t> readIndices(Import& import, const VertexSource& source, int indices, std::size_t vertices) {
    std::vector<std::uint32_t> out;
    if (source.draco()) {
        out = source.draco()->indices;
    } else if (indices < 0) {
        import.geometry.charge(vertices * sizeof(std::uint32_t));
        out.resize(vertices);
        std::iota(out.begin(), out.end(), 0u);
    } else {
        const AccessorView view(import.model, indices);
        const int type = view.componentType();
        if (view.components() != 1 ||
            (type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE && type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
             type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)) {
            refuseMalformed("indices are not unsigned integers (accessor {})", indices);
        }
        import.geometry.charge(view.count() * sizeof(std::uint32_t));
        out.resize(view.count());
        for (std::size_t i = 0; i < out.size(); ++i) out[i] = view.integer(i);
    }
    for (const std::uint32_t v : out) {
        if (v >= vertices) refuseMalformed("index {} is beyond its {} vertices", v, vertices);
    }
    return out;
}

/// An optional attribute of the vertices in use; empty if the file has none.
template <class Vector>
std::vector<Vector> readAttribute(Import& import, const VertexSource& source, const char* name, std::size_t vertices,
                                  std::span<const std::uint32_t> used) {
    const std::optional<AccessorView> view = source.find(name);
    if (!view) return {};
    if (view->count() != vertices) refuseMalformed("{} {} for {} positions", view->count(), name, vertices);
    if (view->components() != Vector::length()) {
        refuseMalformed("{} has {} components, not {}", name, view->components(), Vector::length());
    }
    import.geometry.charge(used.size() * sizeof(Vector));
    std::vector<Vector> out;
    out.reserve(used.size());
    for (const std::uint32_t v : used) out.push_back(Vector(view->vector(v)));
    return out;
}

template <class Vector>
bool allFinite(const std::vector<Vector>& values) {
    return std::all_of(values.begin(), values.end(), [](const Vector& v) {
        for (int c = 0; c < Vector::length(); ++c) {
            if (!std::isfinite(v[c])) return false;
        }
        return true;
    });
}

/// Normalises normals. Zero-length ones are replaced by that of a triangle at the vertex.
void repairNormals(Import& import, const std::string& user, Primitive& p) {
    const auto unit = [](glm::vec3 v) {
        const float length = glm::length(v);
        return length > 1e-20f && std::isfinite(length) ? v / length : glm::vec3(0.0f);
    };
    bool repaired = false;
    for (glm::vec3& normal : p.normals) {
        normal = unit(normal);
        repaired |= normal == glm::vec3(0.0f);
    }
    if (!repaired) return;
    import.warn(fmt::format("{}: normals without a direction were replaced by the triangles'", user));
    for (std::size_t i = 0; i + 2 < p.indices.size(); i += 3) {
        const glm::vec3 a = p.positions[p.indices[i]];
        const glm::vec3 facing = unit(glm::cross(p.positions[p.indices[i + 1]] - a, p.positions[p.indices[i + 2]] - a));
        for (std::size_t corner = i; corner < i + 3; ++corner) {
            glm::vec3& normal = p.normals[p.indices[corner]];
            if (normal == glm::vec3(0.0f)) normal = facing;
        }
    }
    for (glm::vec3& normal : p.normals) {
        if (normal == glm::vec3(0.0f)) normal = glm::vec3(0, 1, 0);
    }
}

/// Normalises tangents, with handedness +-1; drops all if one is unusable, so that they are derived from the uvs.
void repairTangents(Primitive& p) {
    for (glm::vec4& tangent : p.tangents) {
        const float length = glm::length(glm::vec3(tangent));
        if (!(length > 1e-20f) || !std::isfinite(length) || std::isnan(tangent.w)) {
            p.tangents.clear();
            return;
        }
        tangent = glm::vec4(glm::vec3(tangent) / length, tangent.w < 0 ? -1.0f : 1.0f);
    }
}

/// glTF 2.0's default material for primitives without one (section 3.7.2.1), made on first use.
int defaultMaterial(Import& import) {
    auto& materials = import.scene().materials;
    if (materials.size() == import.model.materials.size()) {
        Material material;
        material.name = "default";
        material.metallic = 1.0f;
        materials.push_back(material);
    }
    return int(materials.size()) - 1;
}

void importAttributes(Import& import, const std::string& user, const VertexSource& source, std::size_t vertices,
                      std::span<const std::uint32_t> used, Primitive& out) {
    out.positions = readAttribute<glm::vec3>(import, source, "POSITION", vertices, used);
    if (!allFinite(out.positions)) refuseMalformed("a position is not a finite number");
    out.normals = readAttribute<glm::vec3>(import, source, "NORMAL", vertices, used);
    repairNormals(import, user, out);
    out.tangents = readAttribute<glm::vec4>(import, source, "TANGENT", vertices, used);
    repairTangents(out);
    out.uv0 = readAttribute<glm::vec2>(import, source, "TEXCOORD_0", vertices, used);
    out.uv1 = readAttribute<glm::vec2>(import, source, "TEXCOORD_1", vertices, used);
    if (!allFinite(out.uv0) || !allFinite(out.uv1)) refuseMalformed("a texture coordinate is not a finite number");
}

/// Empty if there is nothing to draw.
std::optional<Primitive> importPrimitive(Import& import, const std::string& user, const tinygltf::Primitive& p) {
    const std::optional<Topology> topology = topologyOf(p.mode);
    if (!topology) {
        import.warn("points and lines are not supported and are left out");
        return {};
    }
    if (!p.targets.empty()) import.warn("morph targets are not supported; meshes keep their base shape");
    if (p.attributes.contains("COLOR_0")) import.warn("vertex colours are not supported and are ignored");
    const VertexSource source(import, p);
    const std::optional<AccessorView> positions = source.find("POSITION");
    if (!positions) {
        import.warn(fmt::format("{} has no positions and is left out", user));
        return {};
    }
    Primitive out;
    // Draco always stores a triangle list, whatever the mode of the uncompressed form.
    const Topology stored = source.draco() ? Topology::triangles : *topology;
    out.indices = toTriangles(readIndices(import, source, p.indices, positions->count()), stored);
    if (out.indices.empty()) return {};
    const std::vector<std::uint32_t> used = compactVertices(out.indices, positions->count());
    importAttributes(import, user, source, positions->count(), used, out);
    const auto& materials = import.model.materials;
    out.material =
        p.material < 0 ? defaultMaterial(import) : int(checkedIndex("it", "material", p.material, materials.size()));
    return out;
}

}  // namespace

void importMeshes(Import& import) {
    for (std::size_t m = 0; m < import.meshes.size(); ++m) {
        if (import.meshes[m] < 0) continue;
        const tinygltf::Mesh& mesh = import.model.meshes[m];
        Mesh& out = import.scene().meshes[std::size_t(import.meshes[m])];
        out.name = mesh.name;
        for (std::size_t p = 0; p < mesh.primitives.size(); ++p) {
            const std::string user = fmt::format("{}, primitive {}", title("mesh", m, mesh.name), p);
            try {
                auto primitive = importPrimitive(import, user, mesh.primitives[p]);
                if (primitive) out.primitives.push_back(std::move(*primitive));
            } catch (const Refused& refused) {
                refuse(refused.error.code, "{}: {}", user, refused.error.message);
            }
        }
    }
}

}  // namespace probegi::io

#include "geometry/emitters.h"

#include <glm/matrix.hpp>
#include <map>
#include <utility>

#include "geometry/texture_sampler.h"
#include "kernels/screen/colour.h"

namespace probegi {

namespace {

/// Mean luminance of an sRGB image, 0..1.
float meanLuminance(const TextureImage& image) {
    double sum = 0;
    const std::size_t texels = image.rgba.size() / 4;
    for (std::size_t i = 0; i < texels; ++i)
        sum += kernels::luminance({srgbToLinear(image.rgba[4 * i]), srgbToLinear(image.rgba[4 * i + 1]),
                                   srgbToLinear(image.rgba[4 * i + 2])});
    return texels > 0 ? float(sum / double(texels)) : 0.0f;
}

/// Mean luminance of each material's emission, texture included.
std::vector<float> meanLuminances(const Scene& scene) {
    std::map<int, float> images;
    std::vector<float> luminances;
    for (const Material& material : scene.materials) {
        float& luminance = luminances.emplace_back(kernels::luminance(material.emission));
        const int image = material.emissiveTexture.image;
        if (image < 0 || luminance <= 0) continue;
        const auto [found, isNew] = images.try_emplace(image, 0.0f);
        if (isNew) found->second = meanLuminance(scene.images[std::size_t(image)]);
        luminance *= found->second;
    }
    return luminances;
}

}  // namespace

EmitterGeometry::EmitterGeometry(const Scene& scene, const ScenePose& pose) : m_luminance(meanLuminances(scene)) {
    for (const Instance& instance : pose.instances) {
        const std::size_t first = m_triangles.size();
        for (const Primitive& primitive : scene.meshes[std::size_t(instance.mesh)].primitives) append(primitive);
        if (m_triangles.size() > first)
            m_groups.push_back({instance.node, instance.toWorld, first, m_triangles.size() - first});
    }
}

void EmitterGeometry::append(const Primitive& primitive) {
    if (m_luminance[std::size_t(primitive.material)] <= 0) return;
    const auto corner = [&](std::size_t i) { return primitive.positions[primitive.indices[i]]; };
    for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3)
        m_triangles.push_back({{corner(i), corner(i + 1), corner(i + 2)}, std::int32_t(primitive.material)});
}

bool EmitterGeometry::place(int node, const glm::mat4& toWorld) {
    bool found = false;
    for (Group& group : m_groups) {
        if (group.node != node) continue;
        group.toWorld = toWorld;
        found = true;
    }
    return found;
}

EmitterSet EmitterGeometry::placed() const {
    std::vector<EmissiveTriangle> placed;
    placed.reserve(m_triangles.size());
    for (const Group& group : m_groups) {
        // glTF 2.0, section 3.7.4: a mirroring transform reverses the winding of the front.
        const bool mirrored = glm::determinant(glm::mat3(group.toWorld)) < 0;
        const auto place = [&](glm::vec3 p) { return glm::vec3(group.toWorld * glm::vec4(p, 1.0f)); };
        for (std::size_t i = group.first; i < group.first + group.count; ++i) {
            const Triangle& t = m_triangles[i];
            EmissiveTriangle& out = placed.emplace_back();
            out.corner = place(t.corner[0]);
            out.edge1 = place(t.corner[1]) - out.corner;
            out.edge2 = place(t.corner[2]) - out.corner;
            if (mirrored) std::swap(out.edge1, out.edge2);
            out.material = t.material;
        }
    }
    return makeEmitterSet(std::move(placed), m_luminance);
}

}  // namespace probegi

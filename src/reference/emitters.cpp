#include "reference/emitters.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "kernels/colour.h"
#include "kernels/sampling.h"

namespace probegi {

namespace {

/// Mean luminance of an sRGB image. Only the quality of sampling depends on it, not the result.
float meanLuminance(const TextureImage& image) {
    float linear[256];
    for (int i = 0; i < 256; ++i) linear[i] = std::pow(float(i) / 255.0f, 2.2f);
    double sum = 0;
    const std::size_t texels = image.rgba.size() / 4;
    for (std::size_t i = 0; i < texels; ++i)
        sum += kernels::luminance(
            {linear[image.rgba[4 * i]], linear[image.rgba[4 * i + 1]], linear[image.rgba[4 * i + 2]]});
    return texels > 0 ? float(sum / double(texels)) : 0.0f;
}

}  // namespace

Emitters::Emitters(const Scene& scene, const ScenePose& pose) {
    collectMaterials(scene);
    for (const Instance& instance : pose.instances)
        for (const Primitive& primitive : scene.meshes[std::size_t(instance.mesh)].primitives)
            collectTriangles(primitive, instance.toWorld);

    std::vector<double> power;
    power.reserve(m_triangles.size());
    for (const Triangle& t : m_triangles)
        power.push_back(0.5 * double(glm::length(glm::cross(t.edge1, t.edge2))) *
                        double(m_materials[std::size_t(t.material)].luminance));
    m_table = AliasTable(power);
    if (m_table.empty()) return;
    for (EmissiveMaterial& material : m_materials)
        material.pdfArea = float(double(material.luminance) / m_table.totalWeight());
}

void Emitters::collectMaterials(const Scene& scene) {
    for (const Material& material : scene.materials) {
        const int image = material.emissiveTexture.image;
        EmissiveMaterial& m = m_materials.emplace_back();
        m.emission = material.emission;
        m.luminance = kernels::luminance(material.emission);
        m.uniform = image < 0 && material.alphaMode == AlphaMode::opaque;
        m.doubleSided = material.doubleSided;
        if (image >= 0 && m.luminance > 0) m.luminance *= meanLuminance(scene.images[std::size_t(image)]);
    }
}

void Emitters::collectTriangles(const Primitive& primitive, const glm::mat4& toWorld) {
    if (m_materials[std::size_t(primitive.material)].luminance <= 0) return;
    // glTF 2.0, section 3.7.4: a transform that mirrors turns the winding of the front around.
    const bool mirrored = glm::determinant(glm::mat3(toWorld)) < 0;
    const auto place = [&](std::uint32_t index) {
        return glm::vec3(toWorld * glm::vec4(primitive.positions[index], 1.0f));
    };
    for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
        const glm::vec3 a = place(primitive.indices[i]);
        Triangle t{a, place(primitive.indices[i + 1]) - a, place(primitive.indices[i + 2]) - a, primitive.material};
        if (mirrored) std::swap(t.edge1, t.edge2);
        const float area = glm::length(glm::cross(t.edge1, t.edge2));
        if (area > 0 && std::isfinite(area)) m_triangles.push_back(t);
    }
}

EmitterSample Emitters::sample(Random& random) const noexcept {
    const Triangle& t = m_triangles[m_table.sample(random.nextDouble())];
    const glm::vec2 b = kernels::sampleTriangle(random.nextPair());
    return {t.corner + t.edge1 * b.x + t.edge2 * b.y, glm::normalize(glm::cross(t.edge1, t.edge2)), t.material};
}

}  // namespace probegi

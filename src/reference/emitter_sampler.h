#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "probegi/tracer.h"
#include "reference/alias_table.h"
#include "reference/random_stream.h"

namespace probegi {

/// A point on an emissive triangle.
struct EmitterSample {
    glm::vec3 position{0.0f};
    glm::vec3 normal{0, 1, 0};  ///< unit, of the front
    int material = -1;
};

/// The emissive triangles of a pose in world space, sampled by power. A triangle's power is taken as its area times the
/// mean luminance of its *material*, so that the density of a point, per area, is a property of the material alone:
/// whoever hits an emissive surface by chance can tell how likely sampling was to choose that point without knowing
/// which triangle it was.
class EmitterSampler {
public:
    EmitterSampler() = default;
    EmitterSampler(const Scene& scene, const ScenePose& pose);

    bool empty() const noexcept { return m_table.empty(); }
    EmitterSample sample(Random& random) const noexcept;
    /// Sampling density per square metre on this material; 0 if it is never sampled.
    float pdfArea(int material) const noexcept {
        return material < 0 || std::size_t(material) >= m_materials.size() ? 0.0f
                                                                           : m_materials[std::size_t(material)].pdfArea;
    }
    /// Whether the material emits the same radiance everywhere; otherwise (textures, alpha) a ray must look up the
    /// sampled point.
    bool uniform(int material) const noexcept { return m_materials[std::size_t(material)].uniform; }
    bool doubleSided(int material) const noexcept { return m_materials[std::size_t(material)].doubleSided; }
    glm::vec3 emission(int material) const noexcept { return m_materials[std::size_t(material)].emission; }

private:
    struct EmissiveMaterial {
        glm::vec3 emission{0.0f};
        float pdfArea = 0.0f;
        bool uniform = true;
        bool doubleSided = false;
    };

    std::vector<EmissiveMaterial> m_materials;
    std::vector<EmissiveTriangle> m_triangles;
    AliasTable m_table;
};

}  // namespace probegi

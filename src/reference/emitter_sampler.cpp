#include "reference/emitter_sampler.h"

#include <glm/geometric.hpp>
#include <utility>

#include "geometry/emitters.h"
#include "kernels/sampling.h"
#include "scene/emitter_set.h"

namespace probegi {

EmitterSampler::EmitterSampler(const Scene& scene, const ScenePose& pose) {
    EmitterSet set = EmitterGeometry(scene, pose).placed();
    m_triangles = std::move(set.triangles);
    std::vector<double> power;
    power.reserve(m_triangles.size());
    for (const EmissiveTriangle& t : m_triangles)
        power.push_back(emitterPower(t, set.luminance[std::size_t(t.material)]));
    m_table = AliasTable(power);
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        const Material& material = scene.materials[i];
        m_materials.push_back({.emission = material.emission,
                               .pdfArea = set.density(std::int32_t(i)),
                               .uniform = material.emissiveTexture.image < 0 && material.alphaMode == AlphaMode::opaque,
                               .doubleSided = material.doubleSided});
    }
}

EmitterSample EmitterSampler::sample(Random& random) const noexcept {
    const EmissiveTriangle& t = m_triangles[m_table.sample(random.nextDouble())];
    const glm::vec2 b = kernels::sampleTriangle(random.nextPair());
    return {t.corner + t.edge1 * b.x + t.edge2 * b.y, glm::normalize(glm::cross(t.edge1, t.edge2)), t.material};
}

}  // namespace probegi

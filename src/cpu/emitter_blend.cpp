#include "cpu/emitter_blend.h"

#include <algorithm>

#include "kernels/probe/octahedral_texel.h"

namespace probegi {

EmitterBlend::EmitterBlend(int size, std::span<const kernels::EmitterLight> lights, std::size_t tasks)
    : m_lights(lights), m_looks(tasks > 0 ? lights.size() / tasks : 0) {
    if (m_looks == 0) return;
    for (int texel = 0; texel < size * size; ++texel) {
        const glm::vec3 n = kernels::octTexelDirection(texel % size, texel / size, size);
        m_x.push_back(n.x);
        m_y.push_back(n.y);
        m_z.push_back(n.z);
    }
}

void EmitterBlend::addTo(Matrix& means, std::size_t begin, std::size_t end) const {
    if (m_looks == 0) return;
    for (std::size_t task = begin; task < end; ++task) {
        float* r = &means(3 * (task - begin), 0);
        float* g = &means(3 * (task - begin) + 1, 0);
        float* b = &means(3 * (task - begin) + 2, 0);
        for (const kernels::EmitterLight& l : m_lights.subspan(task * m_looks, m_looks)) {
            if (l.light == glm::vec3(0.0f)) continue;
            for (std::size_t t = 0; t < m_x.size(); ++t) {
                const float cosine =
                    std::max(0.0f, m_x[t] * l.direction.x + m_y[t] * l.direction.y + m_z[t] * l.direction.z);
                r[t] += cosine * l.light.x;
                g[t] += cosine * l.light.y;
                b[t] += cosine * l.light.z;
            }
        }
    }
}

}  // namespace probegi

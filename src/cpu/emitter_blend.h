#pragma once

#include <span>
#include <vector>

#include "cpu/matrix_product.h"
#include "kernels/light/emitter_sampling.h"

namespace probegi {

/// Adds the probes' emitter samples to the means of their rays.
class EmitterBlend {
public:
    /// `size`: side of the irradiance map; `lights`: [task][look], or empty. They must outlive this.
    EmitterBlend(int size, std::span<const kernels::EmitterLight> lights, std::size_t tasks);

    /// `means`: rows r, g, b over the texels for each of the tasks `begin` to `end`.
    void addTo(Matrix& means, std::size_t begin, std::size_t end) const;

private:
    std::span<const kernels::EmitterLight> m_lights;
    std::size_t m_looks;               // a task
    std::vector<float> m_x, m_y, m_z;  // directions of the texels
};

}  // namespace probegi

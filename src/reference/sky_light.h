#pragma once

#include <glm/vec3.hpp>

#include "probegi/scene.h"
#include "reference/alias_table.h"
#include "reference/random_stream.h"

namespace probegi {

/// The sky as a sampled light: a constant sky by the cosine around the receiver's normal, an image by the mean
/// luminance of its texels times their solid angle.
class SkyLight {
public:
    SkyLight() = default;
    explicit SkyLight(const Sky& sky);

    bool black() const noexcept { return m_black; }
    /// The same radiance in all directions.
    bool constant() const noexcept { return m_table.empty(); }
    glm::vec3 radiance(glm::vec3 direction) const noexcept;
    /// A unit direction towards the sky for a receiver with this shading normal. The sky must not be black.
    glm::vec3 sample(glm::vec3 normal, Random& random) const noexcept;
    /// Density of sample() per steradian.
    float pdf(glm::vec3 normal, glm::vec3 direction) const noexcept;

private:
    void makeTable();

    Sky m_sky;
    bool m_black = true;
    AliasTable m_table;        ///< over texels, row-major; empty for a constant sky
    std::vector<float> m_pdf;  ///< per texel, per steradian
};

}  // namespace probegi

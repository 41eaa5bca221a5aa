#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <vector>

#include "kernels/sdf/face_texels.h"

namespace probegi {

/// Colours that rays saw on a box's faces, texel by texel.
class FaceSums {
public:
    /// Adds what a ray saw at a point of the box's surface, in the world.
    void add(const kernels::SdfSolid& box, glm::vec3 point, glm::vec3 albedo);
    /// The means, as SdfPrimitive::faces. Texels that no ray met take after those beside them, and faces that none met
    /// have `otherwise`. Empty where the faces do not differ from that by more than a hundredth.
    std::vector<glm::vec3> means(glm::vec3 otherwise) const;

private:
    std::array<glm::vec3, kernels::kSdfFaceTexels> m_sums{};
    std::array<int, kernels::kSdfFaceTexels> m_counts{};
};

}  // namespace probegi

#pragma once

#include <glm/vec3.hpp>
#include <span>

#include "cpu/field_view.h"

namespace probegi {

/// What the eight probes around a point answer.
struct CageAnswer {
    glm::vec3 irradiance;  ///< E in W m^-2 at the surface; means nothing where weightSum is 0
    glm::vec3 root;        ///< weighted sum of the probes' square roots of light, for kernels::completedByNeighbours
    float weightSum;       ///< of the probes; below kernels::kDoubtful too little for an answer
};

/// Steps 1 to 3 of section 2.2 for each query in one volume of the field, with the fastest instructions that the
/// processor has. `out` has room for as many answers as there are queries.
void answerFromCages(const FieldView& view, const kernels::Volume& volume, std::span<const FieldQuery> queries,
                     CageAnswer* out);

}  // namespace probegi

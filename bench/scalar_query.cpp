#include "scalar_query.h"

#include "cpu/field_access.h"
#include "kernels/lookup/irradiance.h"

namespace probegi::bench {

void queryScalar(const FieldView& view, std::span<const FieldQuery> queries, std::span<glm::vec3> out) {
    const FieldAccess access(view);
    for (std::size_t i = 0; i < queries.size(); ++i)
        out[i] =
            kernels::irradianceIn(access, view.volumes[0], queries[i].position, queries[i].normal, queries[i].toViewer);
}

}  // namespace probegi::bench

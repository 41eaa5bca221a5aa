// Groups of solids, which a search for the nearest rejects whole (SDFDDGI, sections 3.1 and 3.3).
#ifndef PROBEGI_KERNELS_SDF_CLUSTER_H
#define PROBEGI_KERNELS_SDF_CLUSTER_H

#include "kernels/sdf/primitive.h"

KERNELS_BEGIN

// Solids that are near each other (section 3.1), numbered one after the other, and a ball around them.
struct SdfCluster {
    vec3 centre;   // metres
    float radius;  // metres; of what has no bounds kSdfFar
    int first;     // solid
    int count;     // solids
};

// Whether a cluster may hold a solid nearer than `bound`. The ball's distance never exceeds its solids'.
KERNEL_FN bool sdfMayBeNearer(IN(SdfCluster) cluster, vec3 point, float bound) {
    return length(point - cluster.centre) - cluster.radius < bound;
}

KERNELS_END

#ifdef __cplusplus
namespace probegi::kernels {
static_assert(offsetof(SdfCluster, radius) == 12 && offsetof(SdfCluster, first) == 16 && sizeof(SdfCluster) == 24);
}  // namespace probegi::kernels
#endif

#endif

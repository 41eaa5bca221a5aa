#include "lane.h"

#include "kernels/sdf/cluster.h"

void evaluate(INOUT(Lane) lane) {
    SdfCluster cluster;
    cluster.centre = takeVector(lane, -4.0f, 4.0f);
    cluster.radius = takeIndex(lane, 5) == 0 ? kSdfFar : takeBetween(lane, 0.0f, 3.0f);
    cluster.first = 0;
    cluster.count = 1;
    const vec3 point = takeVector(lane, -4.0f, 4.0f) + vec3(0.013f, 0.0f, 0.017f);
    giveBits(lane, sdfMayBeNearer(cluster, point, takeBetween(lane, 0.01f, 4.0f)) ? 1u : 0u);
}

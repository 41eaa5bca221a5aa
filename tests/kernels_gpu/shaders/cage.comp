#include "lane.h"

#include "some_volume.h"

#include "kernels/lookup/cage.h"

// Rounding may put the biased point on either side of a layer of probes, so base and alpha are compared by their sum.
void evaluate(INOUT(Lane) lane) {
    const Volume v = takeVolume(lane);
    const vec3 point = takeVector(lane, -8.0f, 8.0f);
    const vec3 normal = takeDirection(lane);
    const vec3 toViewer = takeDirection(lane);
    for (int rules = 0; rules < 2; ++rules) {
        const Cage cage = cageAround(v, point, normal, toViewer, 0.3f, rules);
        giveVec3(lane, cage.position, 2e-5f);
        giveVec3(lane, cage.normal, 1e-5f);
        giveVec3(lane, cage.bias, 1e-5f);
        giveVec3(lane, cage.base + cage.alpha, 1e-4f);
    }
}

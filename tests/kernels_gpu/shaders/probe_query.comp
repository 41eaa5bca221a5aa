#include "lane.h"

#include "kernels/lookup/probe_query.h"

void evaluate(INOUT(Lane) lane) {
    const vec3 normal = takeDirection(lane);
    const vec3 toViewer = takeDirection(lane);
    const float unit = takeUnit(lane);
    const float mean = takeBetween(lane, 0.0f, 2.0f);
    const float distance = takeBetween(lane, 0.0f, 4.0f);
    const float variance = takeUnit(lane);

    giveVec3(lane, viewerOf(toViewer, normal), 1e-6f);
    giveVec3(lane, viewerOf(vec3(0.0f), normal), 1e-6f);
    giveVec3(lane, selfShadowBias(normal, toViewer, 1.5f, 0.3f), 1e-6f);
    for (int rules = 0; rules < 2; ++rules) {
        give(lane, backfaceFloor(rules), 0.0f);
        give(lane, chebyshevFloor(rules), 0.0f);
        giveVec3(lane, visibilityBias(normal, toViewer, 1.5f, 0.3f, rules), 1e-6f);
        giveVec3(lane, cageBias(normal, toViewer, 1.5f, 0.3f, rules), 1e-6f);
        give(lane, backfaceWeight(dot(normal, toViewer), rules), 1e-6f);
        give(lane, chebyshevWeight(mean, mean * mean + 0.01f + variance, distance, rules), 2e-4f);
        give(lane, chebyshevWeight(0.0f, 0.0f, unit + 0.01f, rules), 1e-6f);
        give(lane, chebyshevWeight(0.0f, 0.0f, 0.0f, rules), 1e-6f);
        // The soft edge is steep and amplifies the rounding of the share.
        give(lane, outsideWeight(unit, rules), 1e-5f);
    }
    give(lane, trilinearFactor(0.0f, unit), 1e-6f);
    give(lane, trilinearFactor(1.0f, unit), 1e-6f);
    give(lane, cosineToProbe(distance - 2.0f, distance, 0.7f), 1e-5f);
    give(lane, crushWeight(unit), 1e-6f);
}

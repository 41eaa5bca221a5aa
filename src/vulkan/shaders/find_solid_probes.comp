// After a blend: from which probes a free line leads into the open, so that the coming update knows which of those that
// see backs stand in solid matter (kernels/probe/solid_probe.h). One step from probe to probe an update.
#include "sides.glsl"
#include "volume.glsl"

#include "kernels/abi/gpu_passes.h"

layout(push_constant, scalar) uniform Push {
    SolidPush push;
};

// Steps into the open by way of the 26 neighbours.
uint stepsByNeighbours(int probe) {
    const ivec3 counts = probegiVolume.counts;
    const ivec3 cell = gpuProbeCell(probe, counts);
    const ivec3 lowest = max(cell - 1, ivec3(0));
    const ivec3 highest = min(cell + 1, counts - 1);
    uint steps = kNoWayOut;
    for (int z = lowest.z; z <= highest.z; ++z) {
        for (int y = lowest.y; y <= highest.y; ++y) {
            for (int x = lowest.x; x <= highest.x; ++x) {
                const ivec3 at = ivec3(x, y, z);
                const int neighbour = probeNumber(at, counts);
                const uint by = stepsBy(Sides(push.sides).at[neighbour].steps);
                if (by >= steps || neighbour == probe) continue;
                const vec3 way = vec3(at - cell) * probegiVolume.spacing;
                const float distance = length(way);
                const vec3 direction = way / distance;
                if (freeWay(probegiMoments(probe, direction).x, probegiMoments(neighbour, -direction).x,
                            distance * probegiVolume.inverseMaxDistance))
                    steps = by;
            }
        }
    }
    return steps;
}

void main() {
    const uint index = globalIndex();
    if (index >= uint(push.probes)) return;
    const int probe = int(index);
    const ProbeSides own = Sides(push.sides).at[probe];
    const ProbeSides found = foundWay(own, looksForWay(own) ? stepsByNeighbours(probe) : kNoWayOut);
    Sides(push.sides).at[probe].nextSteps = found.nextSteps;
    Sides(push.sides).at[probe].trust = found.trust;
}

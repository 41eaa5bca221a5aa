// After a blend: finds the probes that have a path of clear lines into the open. The next update takes those that have
// none, and see backs, for solid (kernels/probe/solid_probe.h). Paths grow by one line per update.
#include "sides.glsl"
#include "tasks.glsl"
#include "volume.glsl"

#include "kernels/abi/gpu_passes.h"

layout(push_constant, scalar) uniform Push {
    SolidPush push;
};

vec3 offsetOf(Volume volume, int slot) {
    return probeOffset(volume, int(probegiStates.at[slot].placement));
}

// Length of the shortest path into the open through one of the 26 neighbours.
uint stepsByNeighbours(ProbeTask task) {
    const Volume volume = probegiField.volumes[task.volume];
    const int probe = int(task.slot);
    const ivec3 cell = probeCell(volume, probe);
    const ivec3 lowest = max(cell - 1, ivec3(0));
    const ivec3 highest = min(cell + 1, volume.counts - 1);
    uint steps = kNoWayOut;
    for (int z = lowest.z; z <= highest.z; ++z) {
        for (int y = lowest.y; y <= highest.y; ++y) {
            for (int x = lowest.x; x <= highest.x; ++x) {
                const ivec3 at = ivec3(x, y, z);
                const int neighbour = probeSlot(volume, at);
                const uint by = stepsBy(Sides(push.sides).at[neighbour].steps);
                if (by >= steps || neighbour == probe) continue;
                vec3 way = vec3(at - cell) * volume.spacing;
                if (volume.relocated != 0) way += offsetOf(volume, neighbour) - offsetOf(volume, probe);
                const float distance = length(way);
                const vec3 direction = toWorldDirection(volume, way / distance);
                if (freeWay(probegiMoments(probe, direction).x, probegiMoments(neighbour, -direction).x,
                            distance * volume.inverseMaxDistance))
                    steps = by;
            }
        }
    }
    return steps;
}

void main() {
    const uint index = globalIndex();
    if (index >= Tasks(push.tasks).counts.tasks) return;
    const ProbeTask task = Tasks(push.tasks).at[index];
    const uint probe = task.slot;
    const ProbeSides own = Sides(push.sides).at[probe];
    const ProbeSides found = foundWay(own, looksForWay(own) ? stepsByNeighbours(task) : kNoWayOut);
    Sides(push.sides).at[probe].nextSteps = found.nextSteps;
    Sides(push.sides).at[probe].trust = found.trust;
}

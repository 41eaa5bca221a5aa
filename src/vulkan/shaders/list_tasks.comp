// The task list: the active ones among all probes, or among those that were chosen; without those that look-ups pass
// over. Compacted group by group: tasks of neighbouring probes stay together, and which group comes first does not
// matter, for a task's results depend on no other's.
#include "filter.glsl"
#include "tasks.glsl"

#include "places.glsl"

shared uint marked[2];  // a bit a thread
shared uint first;

void main() {
    const uint index = globalIndex();
    const uint thread = gl_LocalInvocationID.x;
    if (thread < 2u) marked[thread] = 0u;
    barrier();
    int slot = 0;
    bool isTask = false;
    if (index < push.listed) {
        slot = push.chosen == uvec2(0u) ? int(index) : int(Uints(push.chosen).at[index]);
        const uint state = stateOf(probegiStates.at[slot].placement);
        isTask = isActive(state) || state == kUninitialized;
        // Nothing to do there: as if it had converged.
        if (!isTask && push.progress != uvec2(0u)) ProbeProgresses(push.progress).at[slot] = noProgress();
    }
    if (isTask) atomicOr(marked[thread >> 5u], 1u << (thread & 31u));
    barrier();
    if (thread == 0u)
        first = atomicAdd(Tasks(push.tasks).counts.tasks, uint(bitCount(marked[0]) + bitCount(marked[1])));
    barrier();
    if (!isTask) return;
    const uint below = marked[thread >> 5u] & ((1u << (thread & 31u)) - 1u);
    const uint rank = uint(bitCount(below)) + (thread >= 32u ? uint(bitCount(marked[0])) : 0u);
    Tasks(push.tasks).at[first + rank] = ProbeTask(probegiProbePosition(slot), uint(slot), uint(probegiVolumeOf(slot)));
}

// Writes a task list of all probes, in slot order.
#include "tasks.glsl"
#include "volume.glsl"

layout(push_constant, scalar) uniform Push {
    TasksPush push;
};

void main() {
    const uint slot = globalIndex();
    if (slot >= push.count) return;
    const int number = probegiVolumeOf(int(slot));
    Tasks(push.tasks).at[slot] = ProbeTask(probegiProbePosition(int(slot)), slot, uint(number));
    if (slot == 0u) Tasks(push.tasks).counts.tasks = push.count;
}

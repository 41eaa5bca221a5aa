// Work group counts of an update's indirect dispatches, from the number of its tasks.
#include "tasks.glsl"

layout(push_constant, scalar) uniform Push {
    TasksPush push;
};

void main() {
    if (globalIndex() > 0u) return;
    Tasks tasks = Tasks(push.tasks);
    tasks.counts = countedTasks(tasks.counts.tasks, push.rays, push.looks, push.irradianceTexels);
}

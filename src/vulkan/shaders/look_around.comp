// One look of the tasks that are not placed yet, by rays that the caller traced. One thread per task.
#include "ray_data.glsl"
#include "tasks.glsl"

#include "places.glsl"

#include "kernels/blend/probe_blend.h"

void main() {
    const uint index = globalIndex();
    if (index >= Tasks(push.tasks).counts.tasks) return;
    const ProbeTask task = Tasks(push.tasks).at[index];
    const int slot = int(task.slot);
    if (!isNewProbe(slot)) return;
    const Volume v = probegiField.volumes[task.volume];
    PlaceSight sight = nothingSeen();
    int counted = 0;
    for (int ray = 0; ray < push.rays; ++ray) {
        const RayDatum d =
            rayDatumAt(push.rayData, (push.flags & kPlacesPackedRays) != 0, index * uint(push.rays) + uint(ray));
        const vec3 direction = Vec3s(push.directions).at[ray];
        const float distance = safeDistance(d.distance);
        const bool hit = distance < kMissDistance;
        const vec3 position = task.origin + abs(distance) * direction;
        // Of its surface no more is known than that it faces the ray. Within the bounds of what moves may be static
        // ones too, which stay when it goes.
        if (hit && !hitBack(distance)) markUsed(position, -direction);
        if (hit && moves(position)) continue;
        ++counted;
        addToPlaceSight(sight, toVolumeDirection(v, direction), distance, hitBackface(distance, d.radiance.x));
    }
    probegiStates.at[slot].placement =
        lookedAround(v, probegiStates.at[slot].placement, sight, counted, relocates(), probegiField.rules);
}

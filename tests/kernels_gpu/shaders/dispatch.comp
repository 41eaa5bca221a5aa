#include "lane.h"

#include "kernels/abi/dispatch.h"

void evaluate(INOUT(Lane) lane) {
    const uint tasks = uint(takeIndex(lane, 1 << 20));
    const uint rays = uint(takeIndex(lane, 1024));
    const uint looks = uint(takeIndex(lane, 16));
    const uint texels = uint(takeIndex(lane, 1024));
    const GpuTaskCounts counts = countedTasks(tasks, rays, looks, texels);
    giveBits(lane, groupsOf(tasks, kGroupSize));
    giveBits(lane, threadGroups(tasks * rays).x);
    giveBits(lane, blockGroups(tasks, looks).z);
    giveBits(lane, counts.tasks + counts.perTask.x + counts.perTask.y);
    giveBits(lane, counts.perRay.x + counts.perRay.y);
    giveBits(lane, counts.perLook.x + counts.perLook.y);
    giveBits(lane, counts.irradiance.x + counts.irradiance.y + counts.irradiance.z);
    giveBits(lane, counts.visibility.x + counts.visibility.y + counts.visibility.z);
}

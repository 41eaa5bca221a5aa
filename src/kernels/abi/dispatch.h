// How a pass's groups are spread over the axes of a dispatch, and the groups that the passes of an update have: from
// the number of tasks in the GPU's memory, without the CPU (count_tasks.comp).
#ifndef PROBEGI_KERNELS_DISPATCH_H
#define PROBEGI_KERNELS_DISPATCH_H

#include "kernels/language.h"

KERNELS_BEGIN

// Threads of a group (shaders/common.glsl), and groups along x at most: devices need not take more than 65,535.
KERNEL_CONST uint kGroupSize = 64u;
KERNEL_CONST uint kGroupsPerRow = 32768u;

// Probes of a work group of the blends, and the first one's texels.
KERNEL_CONST int kIrradianceGroupProbes = 16;
KERNEL_CONST int kIrradianceGroupTexels = 64;
KERNEL_CONST int kVisibilityGroupProbes = 4;  // and all their texels

KERNEL_FN uint groupsOf(uint count, uint size) {
    return (count + size - 1u) / size;
}

// Groups of a thread for each of `count`, over x and y: shaders find their number with globalIndex(). At most 2^31.
KERNEL_FN uvec3 threadGroups(uint count) {
    const uint groups = groupsOf(count, kGroupSize);
    const uint rows = groupsOf(groups, kGroupsPerRow);
    return uvec3(rows > 1u ? kGroupsPerRow : groups, rows, 1u);
}

// `blocks` times `columns` groups: x and z hold a group's block (blockIndex()), y its column.
KERNEL_FN uvec3 blockGroups(uint blocks, uint columns) {
    const uint rows = groupsOf(blocks, kGroupsPerRow);
    return uvec3(rows > 1u ? kGroupsPerRow : blocks, columns, rows);
}

// An update's list of tasks in GPU memory: how many there are, then the arguments of its passes' indirect dispatches.
struct GpuTaskCounts {
    uint tasks;
    uvec3 perTask;  // a thread a task
    uvec3 perRay;
    uvec3 perLook;     // at emitters
    uvec3 irradiance;  // groups of the blends
    uvec3 visibility;
};

KERNEL_FN GpuTaskCounts countedTasks(uint tasks, uint rays, uint looks, uint irradianceTexels) {
    GpuTaskCounts counts;
    counts.tasks = tasks;
    counts.perTask = threadGroups(tasks);
    counts.perRay = threadGroups(tasks * rays);
    counts.perLook = threadGroups(tasks * looks);
    counts.irradiance = blockGroups(groupsOf(tasks, uint(kIrradianceGroupProbes)),
                                    groupsOf(irradianceTexels, uint(kIrradianceGroupTexels)));
    counts.visibility = blockGroups(groupsOf(tasks, uint(kVisibilityGroupProbes)), 1u);
    return counts;
}

KERNELS_END

#ifdef __cplusplus
namespace probegi::kernels {
static_assert(offsetof(GpuTaskCounts, perTask) == 4 && sizeof(GpuTaskCounts) == 64);
}  // namespace probegi::kernels
#endif

#endif

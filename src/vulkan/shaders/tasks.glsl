// The task list of an update, in a buffer.
#ifndef PROBEGI_TASKS_GLSL
#define PROBEGI_TASKS_GLSL

#include "common.glsl"

#include "kernels/abi/gpu_passes.h"
#include "probegi/shared/field_data.h"

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Tasks {
    GpuTaskCounts counts;
    ProbeTask at[];
};

#endif

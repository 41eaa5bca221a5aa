// The temporal filter's buffers (kernels/blend/temporal_filter.h), for the blends and the passes before and after them.
#ifndef PROBEGI_FILTER_GLSL
#define PROBEGI_FILTER_GLSL

#include "common.glsl"

#include "kernels/abi/gpu_passes.h"

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer ProbeSteps {
    GpuProbeStep at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer ProbeFilters {
    PackedProbeFilter at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer TexelChanges {
    TexelChange at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer ProbeProgresses {
    ProbeProgress at[];
};

#endif

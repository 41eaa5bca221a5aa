// One random case of a kernel test, in GLSL and C++ at once: a shader takes random inputs and gives results, and the
// same text compiled as C++ gives the expected ones. `tolerance` is absolute for values up to 1 and relative above; NaN
// agrees only with NaN. Take one input per statement, since C++ does not order operands.
#ifndef PROBEGI_TESTS_KERNELS_GPU_SHADERS_LANE_H
#define PROBEGI_TESTS_KERNELS_GPU_SHADERS_LANE_H

#ifdef __cplusplus

#include "kernels_gpu/lane.h"

#else

#extension GL_EXT_scalar_block_layout : require
#include "kernels/language.h"

layout(local_size_x = 64) in;
layout(scalar, set = 0, binding = 0) readonly buffer Inputs {
    uint b_inputs[];
};
layout(scalar, set = 0, binding = 1) writeonly buffer Outputs {
    uint b_outputs[];
};
layout(push_constant) uniform Sizes {
    uint inputsPerLane;
    uint outputsPerLane;
    uint lanes;
}
u_sizes;

struct Lane {
    uint nextInput;
    uint nextOutput;
};

uint takeBits(INOUT(Lane) lane) {
    return b_inputs[lane.nextInput++];
}

void giveBits(INOUT(Lane) lane, uint value) {
    b_outputs[lane.nextOutput++] = value;
}

void give(INOUT(Lane) lane, float value, float tolerance) {
    giveBits(lane, floatBitsToUint(value));
}

void evaluate(INOUT(Lane) lane);

void main() {
    const uint index = gl_GlobalInvocationID.x;
    if (index >= u_sizes.lanes) return;
    Lane lane;
    lane.nextInput = index * u_sizes.inputsPerLane;
    lane.nextOutput = index * u_sizes.outputsPerLane;
    evaluate(lane);
}

#endif

KERNELS_BEGIN

// Uniform in lower..upper; the lower end and the middle are frequent.
KERNEL_FN float takeBetween(INOUT(Lane) lane, float lower, float upper) {
    return lower + (upper - lower) * (float(takeBits(lane) >> 8u) * (1.0f / 16777216.0f));
}

KERNEL_FN float takeUnit(INOUT(Lane) lane) {
    return takeBetween(lane, 0.0f, 1.0f);
}

KERNEL_FN vec2 takeUnit2(INOUT(Lane) lane) {
    const float x = takeUnit(lane);
    const float y = takeUnit(lane);
    return vec2(x, y);
}

// Each component in lower..upper.
KERNEL_FN vec3 takeVector(INOUT(Lane) lane, float lower, float upper) {
    const float x = takeBetween(lane, lower, upper);
    const float y = takeBetween(lane, lower, upper);
    const float z = takeBetween(lane, lower, upper);
    return vec3(x, y, z);
}

// A unit vector; directions along the axes are frequent.
KERNEL_FN vec3 takeDirection(INOUT(Lane) lane) {
    const vec3 v = takeVector(lane, -1.0f, 1.0f);
    return dot(v, v) > 1e-6f ? normalize(v) : vec3(0.0f, 0.0f, 1.0f);
}

// 0 <= result < count.
KERNEL_FN int takeIndex(INOUT(Lane) lane, int count) {
    return int(takeBits(lane) % uint(count));
}

KERNEL_FN void giveVec2(INOUT(Lane) lane, vec2 value, float tolerance) {
    give(lane, value.x, tolerance);
    give(lane, value.y, tolerance);
}

KERNEL_FN void giveVec3(INOUT(Lane) lane, vec3 value, float tolerance) {
    give(lane, value.x, tolerance);
    give(lane, value.y, tolerance);
    give(lane, value.z, tolerance);
}

KERNELS_END

#endif

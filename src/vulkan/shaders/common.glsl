// Included first by every pass: extensions, typed views of buffer addresses, indices of threads.
#ifndef PROBEGI_COMMON_GLSL
#define PROBEGI_COMMON_GLSL

#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Floats {
    float at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Uints {
    uint at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Vec3s {
    vec3 at[];
};

// Size of the groups of all passes (Recorder::dispatchOver).
layout(local_size_x = 64) in;

// Index of this thread if Recorder::dispatchOver() has spread the groups over two axes.
uint globalIndex() {
    return (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
}

// Index of this group's block if Recorder::dispatchOver() has spread the blocks over x and z.
uint blockIndex() {
    return gl_WorkGroupID.z * gl_NumWorkGroups.x + gl_WorkGroupID.x;
}

#endif

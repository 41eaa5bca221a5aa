// What every pass includes first: extensions, typed views of buffer addresses, the number of a thread.
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

// All passes have groups of this size (Recorder::dispatchOver).
layout(local_size_x = 64) in;

// Number of this thread where Recorder::dispatchOver() spread the groups over two axes.
uint globalIndex() {
    return (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
}

// Number of this group's block where Recorder::dispatchOver() spread blocks over x and z.
uint blockIndex() {
    return gl_WorkGroupID.z * gl_NumWorkGroups.x + gl_WorkGroupID.x;
}

#endif

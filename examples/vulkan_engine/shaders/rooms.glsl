// The engine's scene in shaders: FrameData of rooms.h, and ray tracing of its boxes.
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require

struct Box {
    vec3 lower;
    vec3 upper;
    vec3 albedo;
};

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Frame {
    mat4 worldToClip;
    vec3 toSun;
    vec3 sunIrradiance;
    vec3 skyRadiance;
    int boxCount;
    Box boxes[];
};

const float kMiss = 1e30;
const float kRayStart = 1e-3;  // metres off a surface

struct BoxHit {
    float distance;  // kMiss: the sky
    int box;
    vec3 normal;  // towards the ray's origin
    bool inside;  // the ray started inside the box: it hit the back of a face
};

// The closest face of all boxes along a ray.
BoxHit traceBoxes(Frame frame, vec3 origin, vec3 direction) {
    BoxHit hit = BoxHit(kMiss, -1, vec3(0.0), false);
    const vec3 inverse = 1.0 / direction;
    for (int i = 0; i < frame.boxCount; ++i) {
        const vec3 a = (frame.boxes[i].lower - origin) * inverse;
        const vec3 b = (frame.boxes[i].upper - origin) * inverse;
        const vec3 near = min(a, b), far = max(a, b);
        const float enter = max(near.x, max(near.y, near.z));
        const float leave = min(far.x, min(far.y, far.z));
        if (enter > leave || leave <= 0.0) continue;
        const bool inside = enter <= 0.0;
        const float distance = inside ? leave : enter;
        if (distance >= hit.distance) continue;
        const bvec3 axis = inside ? equal(far, vec3(leave)) : equal(near, vec3(enter));
        hit = BoxHit(distance, i, -sign(direction) * vec3(axis), inside);
    }
    return hit;
}

// Irradiance from the sun, shadowed.
vec3 sunlight(Frame frame, vec3 position, vec3 normal) {
    const float cosine = dot(normal, frame.toSun);
    if (cosine <= 0.0 || traceBoxes(frame, position + kRayStart * normal, frame.toSun).box >= 0) return vec3(0.0);
    return frame.sunIrradiance * cosine;
}

// Watertight ray/triangle intersection (Woop, Benthin, Wald 2013, "Watertight Ray/Triangle Intersection").
#ifndef PROBEGI_KERNELS_TRIANGLE_HIT_H
#define PROBEGI_KERNELS_TRIANGLE_HIT_H

#include "kernels/bvh_node.h"

KERNELS_BEGIN

struct TriangleHit {
    float distance;    // in lengths of the ray's direction
    vec2 barycentric;  // weights of the second and third corner
};

// A corner relative to the ray, in the space in which the ray runs along +z (the paper's section 3.1).
KERNEL_FN vec3 shearedCorner(vec3 corner, BvhRay ray) {
    const vec3 relative = bvhRotate(corner - ray.origin, ray.axis);
    PRECISE const float x = relative.x - ray.shear.x * relative.z;
    PRECISE const float y = relative.y - ray.shear.y * relative.z;
    PRECISE const float z = ray.shear.z * relative.z;
    return vec3(x, y, z);
}

// Twice the signed area of (origin, p, q) in the plane. Products are rounded alike, so swapping p and q flips the sign
// exactly: of two triangles that share an edge, one at least has the ray on its side. Rounding is monotonic: the sign
// is right or the result is 0, and 0 counts as inside, so that no ray is lost. (The paper then decides by double
// precision which one of the triangles it is; either answer is as good here, and many GPUs have no doubles.)
KERNEL_FN float edgeFunction(vec3 p, vec3 q) {
    PRECISE const float left = p.x * q.y;
    PRECISE const float right = p.y * q.x;
    PRECISE const float difference = left - right;
    return difference;
}

// Whether the ray meets the triangle between near and far, both included, from either side; `hit` is set only then.
KERNEL_FN bool intersectTriangle(BvhRay ray, vec3 corner0, vec3 corner1, vec3 corner2, float near, float far,
                                 INOUT(TriangleHit) hit) {
    const vec3 a = shearedCorner(corner0, ray);
    const vec3 b = shearedCorner(corner1, ray);
    const vec3 c = shearedCorner(corner2, ray);
    const float u = edgeFunction(c, b);
    const float v = edgeFunction(a, c);
    const float w = edgeFunction(b, a);
    if (min(u, min(v, w)) < 0.0f && max(u, max(v, w)) > 0.0f) return false;
    const float determinant = u + v + w;
    if (determinant == 0.0f) return false;
    const float inverse = 1.0f / determinant;
    const float distance = (u * a.z + v * b.z + w * c.z) * inverse;
    // Written so that not-a-number is no hit.
    if (!(distance >= near && distance <= far)) return false;
    hit.distance = distance;
    hit.barycentric = vec2(v, w) * inverse;
    return true;
}

KERNELS_END

#endif

// Watertight ray/triangle intersection (Woop, Benthin, Wald 2013, "Watertight Ray/Triangle Intersection").
#ifndef PROBEGI_KERNELS_TRIANGLE_HIT_H
#define PROBEGI_KERNELS_TRIANGLE_HIT_H

#include "kernels/trace/bvh_node.h"

KERNELS_BEGIN

struct TriangleHit {
    float distance;    // in lengths of the ray's direction
    vec2 barycentric;  // weights of the second and third corner
};

// A corner relative to the ray's origin (the direction's largest component last), projected to the plane z = 0 of the
// space in which the ray runs along +z (the paper's section 3.1).
KERNEL_FN vec2 shearedCorner(vec3 relative, BvhRay ray) {
    PRECISE const float x = relative.x - ray.shear.x * relative.z;
    PRECISE const float y = relative.y - ray.shear.y * relative.z;
    return vec2(x, y);
}

// Twice the signed area of (origin, p, q) in the plane. Products are rounded alike, so swapping p and q flips the sign
// exactly: of two triangles that share an edge, at least one has the ray on its side. Rounding is monotonic: the sign
// is correct or the result is 0, and 0 counts as inside, so no ray is lost. (The paper then uses double precision to
// decide between the triangles; here either is fine, and many GPUs lack doubles.)
KERNEL_FN float edgeFunction(vec2 p, vec2 q) {
    PRECISE const float left = p.x * q.y;
    PRECISE const float right = p.y * q.x;
    PRECISE const float difference = left - right;
    return difference;
}

// Whether the ray hits the triangle between near and far, both included, from either side; `hit` is set only then.
// Corners up to 1e12 keep all products finite; beyond that, nothing is hit.
KERNEL_FN bool intersectTriangle(BvhRay ray, vec3 corner0, vec3 corner1, vec3 corner2, float near, float far,
                                 INOUT(TriangleHit) hit) {
    const vec3 relative = bvhRotate(corner0 - ray.origin, ray.axis);
    const vec2 a = shearedCorner(relative, ray);
    const vec2 b = shearedCorner(bvhRotate(corner1 - ray.origin, ray.axis), ray);
    const vec2 c = shearedCorner(bvhRotate(corner2 - ray.origin, ray.axis), ray);
    const float u = edgeFunction(c, b);
    const float v = edgeFunction(a, c);
    const float w = edgeFunction(b, a);
    if (min(u, min(v, w)) < 0.0f && max(u, max(v, w)) > 0.0f) return false;
    // Intersection with the plane. The paper's interpolated distance (section 3.3) is six times less accurate: it adds
    // up the three corners' distances, each far larger than that of a point close to the ray's origin.
    const vec3 normal = bvhRotate(cross(corner1 - corner0, corner2 - corner0), ray.axis);
    const float slope = dot(normal, vec3(ray.shear.x, ray.shear.y, 1.0f));
    const float area = u + v + w;
    if (area == 0.0f || slope == 0.0f) return false;
    const float distance = ray.shear.z * dot(normal, relative) / slope;
    // Written so that NaN is no hit.
    if (!(distance >= near && distance <= far)) return false;
    hit.distance = distance;
    hit.barycentric = vec2(v / area, w / area);
    return true;
}

KERNELS_END

#endif

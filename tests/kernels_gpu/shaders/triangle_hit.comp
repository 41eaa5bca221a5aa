#include "lane.h"

#include "kernels/trace/triangle_hit.h"

// Rays through a known point of a triangle that is neither degenerate nor seen edge-on, for which both sides must find
// the same; and arbitrary rays, for which there must be no invalid hit.
void evaluate(INOUT(Lane) lane) {
    const vec3 corner0 = takeVector(lane, -0.3f, 0.3f);
    const vec3 corner1 = takeVector(lane, -0.3f, 0.3f) + vec3(2.0f, 0.0f, 0.0f);
    const vec3 corner2 = takeVector(lane, -0.3f, 0.3f) + vec3(0.0f, 2.0f, 0.0f);
    const float second = takeBetween(lane, 0.05f, 0.45f);
    const float third = takeBetween(lane, 0.05f, 0.45f);
    const vec3 target = corner0 * (1.0f - second - third) + corner1 * second + corner2 * third;
    const vec3 origin = takeVector(lane, -0.4f, 0.4f) + vec3(0.5f, 0.5f, 3.0f);
    const BvhRay ray = makeBvhRay(origin, target - origin);
    TriangleHit hit;
    hit.distance = -1.0f;
    hit.barycentric = vec2(-1.0f, -1.0f);
    giveBits(lane, intersectTriangle(ray, corner0, corner1, corner2, 0.0f, 10.0f, hit) ? 1u : 0u);
    give(lane, hit.distance, 1e-5f);
    giveVec2(lane, hit.barycentric, 1e-5f);
    giveBits(lane, intersectTriangle(ray, corner0, corner1, corner2, 1.1f, 10.0f, hit) ? 1u : 0u);
    giveBits(lane, intersectTriangle(ray, corner0, corner1, corner2, 0.0f, 0.9f, hit) ? 1u : 0u);
    giveBits(lane, intersectTriangle(ray, corner0, corner1, corner1, 0.0f, 10.0f, hit) ? 1u : 0u);

    const vec2 a = shearedCorner(bvhRotate(corner0 - origin, ray.axis), ray);
    const vec2 b = shearedCorner(bvhRotate(corner1 - origin, ray.axis), ray);
    giveVec2(lane, a, 1e-5f);
    give(lane, edgeFunction(a, b), 1e-4f);
    // Exactly opposite, even if the compiler fuses operations.
    giveBits(lane, edgeFunction(a, b) == -edgeFunction(b, a) ? 1u : 0u);
}

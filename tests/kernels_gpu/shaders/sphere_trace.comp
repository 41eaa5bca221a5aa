#include "lane.h"

#include "sphere_trace_access.h"

#include "kernels/sdf/sphere_trace.h"

// Rays that meet a ball well: towards its middle, from outside.
void evaluate(INOUT(Lane) lane) {
    const SdfSolid ball = sdfSolid(kCubes + takeIndex(lane, 4));
    const vec3 target = ball.centre + takeVector(lane, -0.3f, 0.3f);
    const vec3 side = takeDirection(lane);
    const float away = takeBetween(lane, 1.2f, 6.0f);
    const vec3 origin = ball.centre + side * away + vec3(0.01f, 0.2f, 0.03f);
    const vec3 direction = unitOr(target - origin, vec3(0.0f, 1.0f, 0.0f));
    const SdfFound nearest = sdfNearest(origin, kSdfFar, 2);
    give(lane, nearest.distance, 1e-5f);
    const SdfFound found = sdfSphereTraced(origin, 0.0f, direction, 100.0f, 2);
    // From inside the ball at once.
    const bool outside = nearest.distance > 0.01f;
    // A grazed ball on the way may be met or not.
    const bool steep = outside && found.solid >= 0 &&
                       dot(direction, sdfGradient(sdfSolid(found.solid), origin + direction * found.distance)) < -0.5f;
    give(lane, steep ? found.distance : 0.0f, 1e-4f);
    give(lane, sdfBoundAfter(nearest.distance, 1.0f), 1e-5f);
    give(lane, sdfMeetsAt(origin, 3.0f), 1e-6f);
    give(lane, sdfPredictedStep(away, 1.0f, takeBetween(lane, -0.9f, 1.2f)), 1e-4f);
}

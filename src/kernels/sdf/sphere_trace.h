// The paper's own way (SDFDDGI, section 3.3): sphere tracing of the union, whose distance is searched cluster by
// cluster. Whoever includes this defines before:
//     SdfSolid sdfSolid(int number);
//     SdfCluster sdfCluster(int number);    together they have all solids
#ifndef PROBEGI_KERNELS_SDF_SPHERE_TRACE_H
#define PROBEGI_KERNELS_SDF_SPHERE_TRACE_H

#include "kernels/sdf/cluster.h"
#include "kernels/sdf/union_hit.h"

KERNELS_BEGIN

// Share of the predicted way beyond the distance that a step takes; 0 is plain sphere tracing.
KERNEL_CONST float kSdfRelaxation = 0.9f;
// A surface is met at this distance, as a share of the way and of the coordinates, and at least in metres: what floats
// can tell.
KERNEL_CONST float kSdfMeets = 1e-6f;
KERNEL_CONST float kSdfMeetsAtLeast = 2e-6f;
KERNEL_CONST int kSdfMostSteps = 1024;

// Signed distance to the union, and its solid; -1 where none is nearer than `bound`, a distance known to be enough.
KERNEL_FN SdfFound sdfNearest(vec3 point, float bound, int clusters) {
    SdfFound nearest = sdfFoundNone(bound);
    for (int c = 0; c < clusters; ++c) {
        const SdfCluster cluster = sdfCluster(c);
        if (!sdfMayBeNearer(cluster, point, nearest.distance)) continue;
        for (int i = 0; i < cluster.count; ++i) {
            const float distance = sdfDistance(sdfSolid(cluster.first + i), point);
            if (distance < nearest.distance) {
                nearest.distance = distance;
                nearest.solid = cluster.first + i;
            }
        }
    }
    return nearest;
}

// Eq. 4, for any step: after `step` metres from a point at `distance` the distance is at most their sum. A little more,
// since it must be found, not only bounded.
KERNEL_FN float sdfBoundAfter(float distance, float step) {
    return (distance + step) * 1.0001f + kSdfMeetsAtLeast;
}

// How far to go on from a point at `distance`, in metres, after a step of `last` metres on which the distance fell by
// `fall`: if it falls on like that, as before a plane, the next point's sphere touches this one's (Balint and Valasek
// 2018, "Accelerating Sphere Tracing"). `last` = 0: the first step. Away from surfaces it is at most 19 times the
// distance, since floats tell less and less whether spheres touch.
KERNEL_FN float sdfPredictedStep(float distance, float last, float fall) {
    if (last <= 0.0f) return distance;
    const float farther = max(last - fall, 0.0f) / max(last + fall, 0.1f * last);
    return distance * (1.0f + kSdfRelaxation * farther);
}

KERNEL_FN float sdfMeetsAt(vec3 origin, float t) {
    const float largest = max(abs(origin.x), max(abs(origin.y), abs(origin.z)));
    return max(kSdfMeets * (largest + t), kSdfMeetsAtLeast);
}

// The first solid that a ray from outside meets; -1: none up to `far`. A step beyond the distance is taken back where
// the spheres at its ends do not touch, since something may lie between them (Keinert et al. 2014, "Enhanced Sphere
// Tracing").
KERNEL_FN SdfFound sdfSphereTraced(vec3 origin, float near, vec3 direction, float far, int clusters) {
    float t = near;
    float step = 0.0f;
    float fall = 0.0f;
    SdfFound at = sdfNearest(origin + direction * t, kSdfFar, clusters);
    for (int i = 0; i < kSdfMostSteps && t <= far && at.solid >= 0; ++i) {
        if (at.distance <= sdfMeetsAt(origin, t)) {
            at.distance = t;
            return at;
        }
        step = sdfPredictedStep(at.distance, step, fall);
        SdfFound next = sdfNearest(origin + direction * (t + step), sdfBoundAfter(at.distance, step), clusters);
        if (at.distance + next.distance < step) {
            step = at.distance;
            next = sdfNearest(origin + direction * (t + step), sdfBoundAfter(at.distance, step), clusters);
        }
        t += step;
        fall = at.distance - next.distance;
        at = next;
    }
    return sdfFoundNone(far);
}

KERNELS_END

#endif

#include "lane.h"

#include "some_solid.h"

#include "kernels/sdf/ray_span.h"

void giveSpan(INOUT(Lane) lane, SdfSpan span) {
    give(lane, span.entry, 5e-5f);
    give(lane, span.exit, 5e-5f);
}

// Rays through a point well inside the solid; barely touching ones are for rounding to decide.
void evaluate(INOUT(Lane) lane) {
    const SdfSolid solid = takeSolid(lane);
    const vec3 within = takeVector(lane, -0.12f, 0.12f) - vec3(0.0f, 0.13f, 0.0f);
    const vec3 origin = takeVector(lane, -4.0f, 4.0f) + vec3(0.01f, 0.02f, 0.03f);
    const vec3 target = solid.centre + sdfToWorld(solid, within);
    const vec3 direction = unitOr(target - origin, vec3(0.0f, 0.0f, 1.0f));
    const SdfSpan span = sdfRaySpan(solid, origin, direction);
    // Only where the solid is bounded: a plane's span may end anywhere for a ray along it.
    const bool plane = solid.shape == kSdfPlane;
    give(lane, plane ? 0.0f : span.entry, 5e-5f);
    give(lane, plane ? 0.0f : span.exit, 5e-5f);
    const vec3 local = sdfToLocal(solid, origin - solid.centre);
    const vec3 along = sdfToLocal(solid, direction);
    const bool steep = abs(along.y) > 0.2f;
    const SdfSpan ground = sdfPlaneSpan(local, along);
    give(lane, steep ? max(ground.entry, -1000.0f) : 0.0f, 1e-4f);
    give(lane, steep ? min(ground.exit, 1000.0f) : 0.0f, 1e-4f);
    const SdfSpan both = sdfBothSpans(sdfSpan(1.0f, 3.0f), sdfEitherSpan(sdfNoSpan(), sdfSpan(2.0f, 5.0f)));
    give(lane, both.entry + both.exit, 0.0f);

    // From outside towards the middle, so that all shapes are met and none barely.
    const vec3 from = takeDirection(lane) * 3.0f;
    const vec3 to = unitOr(takeVector(lane, -0.1f, 0.1f) - from, vec3(0.0f, 1.0f, 0.0f));
    const vec3 inverse = sdfInverse(to);
    giveSpan(lane, sdfBoxSpan(solid.halfSize, from, inverse));
    giveSpan(lane, sdfSphereSpan(solid.halfSize.x, from, to));
    giveSpan(lane, sdfCapsuleSpan(solid.halfSize, from, to));
    giveSpan(lane, sdfCylinderSpan(solid.halfSize, from, to));
    giveSpan(lane, sdfRoundedSpan(solid.halfSize, solid.rounding, from, to));
    give(lane, sdfRoundedEntry(solid.halfSize, solid.rounding, from, to), 5e-5f);
    // Where the ray is not nearly along the Y axis, or across it.
    const bool oblique = abs(to.y) > 0.2f && abs(to.y) < 0.95f;
    const SdfSpan slab = sdfSlabSpan(solid.halfSize.y, from, inverse);
    const SdfSpan tube = sdfTubeSpan(solid.halfSize.x, from, to);
    give(lane, oblique ? slab.entry : 0.0f, 5e-5f);
    give(lane, oblique ? slab.exit : 0.0f, 5e-5f);
    give(lane, oblique ? tube.entry : 0.0f, 5e-5f);
    give(lane, oblique ? tube.exit : 0.0f, 5e-5f);
    const SdfSpan roots = sdfRoots(2.0f, -3.0f, takeIndex(lane, 2) == 0 ? -1.0f : 4.0f);
    give(lane, roots.entry, 1e-6f);
    give(lane, roots.exit, 1e-6f);
}

#include "lane.h"

#include "kernels/screen/contact_slice.h"

void evaluate(INOUT(Lane) lane) {
    const vec3 normal = takeDirection(lane);
    const vec3 any = takeDirection(lane);
    // A viewer in front, not at grazing angles, where a rounding decides what is above the ground.
    const vec3 view = normalize(any + normal * (0.3f + 2.0f * max(0.0f, -dot(any, normal))));
    const vec3 shading = normalize(normal + takeVector(lane, -0.2f, 0.2f));
    vec3 along = takeDirection(lane);
    const float across = 1.0f - abs(dot(along, view));
    if (across < 0.1f) along = cross(view, normalize(vec3(1.3f, 0.7f, 2.1f) - view));
    const ContactSlice slice = contactSlice(view, along, shading, normal);
    giveVec3(lane, slice.tangent, 1e-4f);
    give(lane, slice.tilt, 1e-3f);
    give(lane, slice.ground, 1e-3f);
    give(lane, slice.weight, 1e-4f);
    give(lane, contactWhole(slice), 1e-3f);
    const float angle = takeBetween(lane, 0.0f, 3.0f);
    give(lane, contactArc(angle, slice.tilt), 1e-3f);
    ContactSide side = contactSide(slice, takeUnit(lane) < 0.5f ? 1.0f : -1.0f);
    give(lane, side.edge, 1e-3f);
    give(lane, side.below, 1e-3f);
    const float distance = takeBetween(lane, 0.1f, 3.0f);
    give(lane, contactNearness(distance, 2.0f), 1e-4f);
    // Well above the ground and well on the side.
    const vec3 towards = normalize(slice.tangent * side.sign + normal * (1.0f + abs(side.ground)));
    const float arc = raiseHorizon(side, slice, normal, towards * distance, 2.0f, takeUnit(lane));
    const bool clear = dot(towards, normal) > 0.1f && dot(towards, slice.tangent) * side.sign > 0.05f;
    give(lane, clear ? arc : 0.0f, 1e-3f);
    give(lane, clear ? side.horizon : 0.0f, 2e-3f);
}

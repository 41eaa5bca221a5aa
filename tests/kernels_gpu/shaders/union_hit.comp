#include "lane.h"

#include "kernels/sdf/union_hit.h"

void giveFound(INOUT(Lane) lane, SdfFound found) {
    give(lane, found.distance, 0.0f);
    giveBits(lane, uint(found.solid));
}

void evaluate(INOUT(Lane) lane) {
    const float near = float(takeIndex(lane, 4));
    SdfFound entered = sdfFoundNone(float(takeIndex(lane, 8)));
    SdfFound left = sdfFoundNone(near);
    for (int solid = 0; solid < 4; ++solid) {
        const float entry = float(takeIndex(lane, 8)) - 2.0f;
        const SdfSpan span = sdfSpan(entry, entry + float(takeIndex(lane, 4)) - 1.0f);
        giveBits(lane, sdfStartsInside(span, near) ? 1u : 0u);
        sdfEnter(entered, span, near, solid);
        giveFound(lane, entered);
        giveBits(lane, sdfLeave(left, span, kSdfSeam, solid) ? 1u : 0u);
        giveFound(lane, left);
    }
}

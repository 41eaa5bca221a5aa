#include "lane.h"

#include "kernels/trace/ray_set.h"

void giveRotation(INOUT(Lane) lane, mat3 r) {
    for (int column = 0; column < 3; ++column) giveVec3(lane, r[column], 5e-6f);
}

// Only sin and cos of up to 2 pi differ.
void evaluate(INOUT(Lane) lane) {
    const uint count = 8u + takeBits(lane) % 4089u;
    const uint index = takeBits(lane) % count;
    giveVec3(lane, sphericalFibonacci(index, count), 5e-6f);
    give(lane, fibonacciTurn(index), 0.0f);
    give(lane, signedTurn(index), 0.0f);
    // The second component of the shift may differ by a whole turn, which does not change the directions.
    const uint volume = takeBits(lane);
    const vec2 shift = frameShift(volume, takeBits(lane) % 100000u, count);
    give(lane, shift.x, 0.0f);
    giveVec3(lane, shiftedFibonacci(index, count, shift), 1e-5f);
    const float u1 = takeUnit(lane);
    const vec2 u = takeUnit2(lane);
    giveRotation(lane, randomRotation(u1, u.x, u.y));
    const uint seed = takeBits(lane);
    const mat3 turned = frameRotation(seed, takeBits(lane));
    giveRotation(lane, turned);
    RaySet set;
    for (int axis = 0; axis < 3; ++axis) set.turned[axis] = turned[axis];
    set.shift = shift;
    set.count = set.fixedCount = int(count);
    giveVec3(lane, rayOfSet(set, int(index)), 1.5e-5f);
    giveVec3(lane, fixedRayOfSet(set, int(index)), 5e-6f);
}

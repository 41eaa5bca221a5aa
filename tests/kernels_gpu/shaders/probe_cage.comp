#include "lane.h"

#include "kernels/volume/probe_cage.h"

// Grid positions are multiples of a quarter: exactly on a probe or far from it, where rounding cannot change the cell.
void evaluate(INOUT(Lane) lane) {
    const vec3 position = takeVector(lane, -20.0f, 20.0f);
    const vec3 origin = takeVector(lane, -5.0f, 5.0f);
    const vec3 spacing = takeVector(lane, 0.25f, 3.0f);
    const int countX = 2 + takeIndex(lane, 6);
    const int countY = 2 + takeIndex(lane, 6);
    const int countZ = 2 + takeIndex(lane, 6);
    const int quarterX = takeIndex(lane, 64) - 24;
    const int quarterY = takeIndex(lane, 64) - 24;
    const int quarterZ = takeIndex(lane, 64) - 24;
    const ivec3 counts = ivec3(countX, countY, countZ);
    const int phaseX = takeIndex(lane, countX);
    const int phaseY = takeIndex(lane, countY);
    const int phaseZ = takeIndex(lane, countZ);
    Volume v;
    v.origin = origin;
    v.spacing = spacing;
    v.inverseSpacing = vec3(1.0f) / spacing;
    v.counts = counts;
    v.phase = ivec3(phaseX, phaseY, phaseZ);
    v.firstSlot = 100;
    const vec3 inGrid = vec3(float(quarterX), float(quarterY), float(quarterZ)) * 0.25f;

    giveVec3(lane, clampToVolume(v, position), 2e-6f);
    giveVec3(lane, gridCoordinates(v, position), 2e-5f);
    const vec3 base = cageBase(v, inGrid);
    giveVec3(lane, base, 0.0f);
    giveVec3(lane, cageAlpha(inGrid, base), 0.0f);
    const CageSlots slots = cageSlots(v, base);
    giveBits(lane, uint(ringOffset(int(base.y), phaseY, countY, countX)));
    giveBits(lane, uint(nextInRing(slots.x[0], 1, countX)));
    for (int corner = 0; corner < 8; ++corner) giveBits(lane, uint(cornerSlot(v, slots, corner)));
    const ivec3 neighbour = neighbourCell(ivec3(base), takeIndex(lane, kNeighbours));
    giveBits(lane, uint(neighbour.x + 64));
    giveBits(lane, uint(neighbour.y + 64));
    giveBits(lane, uint(neighbour.z + 64));
}

#include "lane.h"

#include "volume_blend_access.h"

#include "kernels/lookup/volume_blend.h"

void evaluate(INOUT(Lane) lane) {
    const int guard = takeIndex(lane, 2);
    const float walls = takeIndex(lane, 2) == 0 ? 0.27f : 1.0f;
    const Access access = accessTo(takeIndex(lane, 2), guard, walls);
    const vec3 point = takeVector(lane, -4.5f, 4.5f);
    const vec3 normal = takeDirection(lane);
    giveVec3(lane, blendedIrradiance(access, point, normal, vec3(0.0f)), 5e-3f);
    give(lane, coverageAt(access, point), 1e-4f);
    give(lane, cellsInRank(access, 0, volumeOfRank(access, 0), point), 1e-4f);

    VolumeAnswer answer;
    answer.irradiance = vec3(1.0f, takeBetween(lane, 0.0f, 2.0f), 3.0f);
    answer.weight = 0.5f;
    VolumeBlend blend = withVolume(emptyBlend(), answer, takeBetween(lane, 0.1f, 1.0f));
    answer.irradiance.x = 2.0f;
    const float weight = nextWeight(blend, takeBetween(lane, -1.0f, 2.0f));
    give(lane, weight, 1e-6f);
    blend = withVolume(blend, answer, weight);
    giveVec3(lane, blend.irradiance, 1e-5f);
    blend = withNearest(blend, answer, takeBetween(lane, 0.0f, 1.0f));
    giveBits(lane, isNearer(blend, 2.0f) ? 1u : 0u);
    give(lane, blend.distance, 1e-6f);
}

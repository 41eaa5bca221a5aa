// The whole look-up in one volume: cage, weights, gather, and the neighbours where the cage has too little weight.
// A guard that brings a storage and a gather of its own takes the place of irradianceIn().
#ifndef PROBEGI_KERNELS_IRRADIANCE_H
#define PROBEGI_KERNELS_IRRADIANCE_H

#include "kernels/lookup/gather.h"
#include "kernels/lookup/probe_neighbours.h"

KERNELS_BEGIN

// What probes say of a point.
struct VolumeAnswer {
    vec3 irradiance;  // E, W m^-2
    float weight;     // of the probes behind it; 0: none of them may be used, and the answer is black
};

// The answer of the cage's neighbours; black only where all of them stand in walls or are new. `at`: irradiancePoint().
LOOKUP_FN VolumeAnswer neighboursAnswer(IN(Access) access, IN(Volume) v, IN(Cage) cage, OF_ACCESS(MapPoint) at) {
    const vec3 begin = guardBegin(access, v, cage);
    vec3 sum = vec3(0.0f);
    float weightSum = 0.0f;
    for (int i = 0; i < kNeighbours; ++i) {
        const ivec3 cell = neighbourCell(ivec3(cage.base), i);
        if (!isInVolume(v, cell)) continue;
        const int slot = probeSlot(v, cell);
        const float outside = outsideWeight(storedBackfaceShare(access, slot), access.rules);
        if (outside <= 0.0f) continue;
        vec3 toProbe = probePlace(v, cell) - cage.position;
        if (v.relocated != 0) toProbe += probeOffset(v, storedPlacement(access, slot));
        const float visible = guardFar(access, v, slot, cage.bias - toProbe, begin);
        const float weight = neighbourWeight(outside, toProbe, cage.normal, visible, v.minSpacing);
        const vec3 stored = storedIrradiance(access, slot, at);
        sum +=
            weight * (vec3(decodeIrradiance(stored.x), decodeIrradiance(stored.y), decodeIrradiance(stored.z)) * kPi);
        weightSum += weight;
    }
    VolumeAnswer answer;
    answer.irradiance = weightSum > 0.0f ? sum / weightSum : vec3(0.0f);
    answer.weight = weightSum;
    return answer;
}

// Whether the cage's weights are enough for an answer. The paper asks no one else, unless all of the cage is new.
KERNEL_FN bool enoughWeight(float weightSum, int rules) {
    return rules == kRulesPaper ? weightSum > 0.0f : weightSum >= kDoubtful;
}

// The answer at a point of a surface that faces `normal`, seen from `toViewer` (both unit; zero stands for the normal,
// where nobody looks), all in the world. Outside the volume its nearest point answers.
LOOKUP_FN VolumeAnswer answerIn(IN(Access) access, IN(Volume) v, vec3 point, vec3 normal, vec3 toViewer) {
    const Cage cage = cageAround(v, point, normal, toViewer, access.selfShadowBias, access.rules);
    const CageWeights w = weighCage(access, v, cage);
    const OF_ACCESS(MapPoint) at = irradiancePoint(access, normal);
    const CageLight light = gatherLight(access, w, at);
    VolumeAnswer answer;
    answer.weight = w.weightSum;
    if (enoughWeight(w.weightSum, access.rules)) {
        const float inverse = 1.0f / w.weightSum;
        answer.irradiance = vec3(irradianceAtSurface(w, light.root.x, light.rise.x, inverse, access.rules),
                                 irradianceAtSurface(w, light.root.y, light.rise.y, inverse, access.rules),
                                 irradianceAtSurface(w, light.root.z, light.rise.z, inverse, access.rules));
        return answer;
    }
    countFallback(access);
    const VolumeAnswer neighbours = neighboursAnswer(access, v, cage, at);
    answer.irradiance = completedByNeighbours(light.root, w.weightSum, neighbours.irradiance);
    answer.weight += neighbours.weight;
    return answer;
}

// E of one volume, W m^-2.
LOOKUP_FN vec3 irradianceIn(IN(Access) access, IN(Volume) v, vec3 point, vec3 normal, vec3 toViewer) {
    return answerIn(access, v, point, normal, toViewer).irradiance;
}

KERNELS_END

#endif

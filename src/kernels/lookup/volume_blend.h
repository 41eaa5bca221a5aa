// The whole look-up in a field of several volumes (section 7.4): densest first, each with its weight, until the weights
// sum to 1; what lacks is made up by those that answered. Where none that holds the point knows its light, the nearest
// that does answers. Besides the functions of access.h it needs
//
//     int volumeCount(Access access)
//     Volume volumeOfRank(Access access, int rank)     // densest first
//     bool rankTracksCamera(Access access, int rank)   // whether it answers around the camera
//     vec3 cameraPosition(Access access)
//     bool outsideFades(Access access)                 // whether light fades where no volume is
//     vec3 outsideRadiance(Access access)
#ifndef PROBEGI_KERNELS_VOLUME_BLEND_H
#define PROBEGI_KERNELS_VOLUME_BLEND_H

#include "kernels/lookup/irradiance.h"
#include "kernels/volume/volume_choice.h"
#include "kernels/volume/volume_weight.h"

KERNELS_BEGIN

// Sum of weights that is as good as 1: rounding alone must not ask one more volume.
KERNEL_CONST float kWholeBlend = 0.9999f;

struct VolumeBlend {
    vec3 irradiance;  // mean of the answers by their weights, W m^-2
    float total;      // of the weights
    float distance;   // square metres, of the nearest volume that knows the light, where total is 0; negative: none yet
};

KERNEL_FN VolumeBlend emptyBlend() {
    VolumeBlend blend;
    blend.irradiance = vec3(0.0f);
    blend.total = 0.0f;
    blend.distance = -1.0f;
    return blend;
}

// Weight of the next volume, from its cells (volume_weight.h).
KERNEL_FN float nextWeight(IN(VolumeBlend) blend, float cells) {
    return blend.total >= kWholeBlend ? 0.0f : min(volumeWeight(cells), 1.0f - blend.total);
}

// A mean in steps: equal answers stay what they are to the bit, and so does a single one. Who knows nothing has no
// weight.
KERNEL_FN VolumeBlend withVolume(VolumeBlend blend, IN(VolumeAnswer) answer, float weight) {
    if (!(answer.weight > 0.0f)) return blend;
    blend.total += weight;
    blend.irradiance += (answer.irradiance - blend.irradiance) * (weight / blend.total);
    return blend;
}

// Whether a volume may answer for want of a better one.
KERNEL_FN bool isNearer(IN(VolumeBlend) blend, float distance) {
    return blend.distance < 0.0f || distance < blend.distance;
}
KERNEL_FN VolumeBlend withNearest(VolumeBlend blend, IN(VolumeAnswer) answer, float distance) {
    if (!(answer.weight > 0.0f)) return blend;
    blend.irradiance = answer.irradiance;
    blend.distance = distance;
    return blend;
}

LOOKUP_FN float cellsInRank(IN(Access) access, int rank, IN(Volume) v, vec3 point) {
    if (rankTracksCamera(access, rank)) return cellsInTrackingVolume(v, point, cameraPosition(access));
    return cellsInVolume(v, point);
}

// How far any volume knows the light at a point of the world, 0..1.
LOOKUP_FN float coverageAt(IN(Access) access, vec3 point) {
    float coverage = 0.0f;
    for (int rank = 0; rank < volumeCount(access) && coverage < 1.0f; ++rank)
        coverage = max(coverage, volumeCoverage(cellsInRank(access, rank, volumeOfRank(access, rank), point)));
    return coverage;
}

// irradianceIn() in all volumes. One loop in two rounds, so that a shader holds the look-up once: those that hold the
// point, then the nearest. A field of one volume has one round, and asks nothing.
LOOKUP_FN vec3 blendedIrradiance(IN(Access) access, vec3 point, vec3 normal, vec3 toViewer) {
    const int count = volumeCount(access);
    const int rounds = count == 1 ? 1 : 2 * count;
    VolumeBlend blend = emptyBlend();
    for (int i = 0; i < rounds; ++i) {
        const bool around = i < count;
        if (!around && blend.total > 0.0f) break;
        const Volume v = volumeOfRank(access, around ? i : i - count);
        const float weight = count == 1 ? 1.0f : around ? nextWeight(blend, cellsInRank(access, i, v, point)) : 0.0f;
        const float distance = around ? 0.0f : squareDistanceToVolume(v, point);
        if (around ? !(weight > 0.0f) : !isNearer(blend, distance)) continue;
        const VolumeAnswer answer = answerIn(access, v, point, normal, toViewer);
        if (around)
            blend = withVolume(blend, answer, weight);
        else
            blend = withNearest(blend, answer, distance);
    }
    if (!outsideFades(access)) return blend.irradiance;
    return withOutside(blend.irradiance, coverageAt(access, point), outsideRadiance(access));
}

KERNELS_END

#endif

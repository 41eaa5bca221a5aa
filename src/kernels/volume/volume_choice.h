// Which of a field's volumes answers at a point: the first of the list that holds it, else the nearest one.
#ifndef PROBEGI_KERNELS_VOLUME_CHOICE_H
#define PROBEGI_KERNELS_VOLUME_CHOICE_H

#include "kernels/volume/probe_cage.h"
#include "kernels/volume/volume_frame.h"

KERNELS_BEGIN

struct VolumeChoice {
    int volume;      // -1: none yet
    float distance;  // from the point to the volume, square metres
};

KERNEL_FN VolumeChoice noVolume() {
    VolumeChoice choice;
    choice.volume = -1;
    choice.distance = 0.0f;
    return choice;
}

// Square of the distance from a point of the world to a volume; 0 inside.
KERNEL_FN float squareDistanceToVolume(IN(Volume) v, vec3 point) {
    const vec3 inVolume = toVolumePoint(v, point);
    const vec3 apart = inVolume - clampToVolume(v, inVolume);
    return dot(apart, apart);
}

// The choice when the list's next volume is looked at: of two that hold the point, or are as near, the first stays.
KERNEL_FN VolumeChoice chooseVolume(VolumeChoice choice, IN(Volume) v, int volume, vec3 point) {
    if (choice.volume >= 0 && choice.distance <= 0.0f) return choice;
    const float distance = squareDistanceToVolume(v, point);
    if (choice.volume >= 0 && choice.distance <= distance) return choice;
    choice.volume = volume;
    choice.distance = distance;
    return choice;
}

KERNELS_END

#endif

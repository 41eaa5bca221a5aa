#include "lane.h"

#include "some_volume.h"

#include "kernels/volume/volume_choice.h"

void evaluate(INOUT(Lane) lane) {
    const Volume v = takeVolume(lane);
    const vec3 point = takeVector(lane, -20.0f, 20.0f);
    give(lane, squareDistanceToVolume(v, point), 2e-4f);
    VolumeChoice choice = chooseVolume(noVolume(), v, 3, point);
    giveBits(lane, uint(choice.volume));
    give(lane, choice.distance, 2e-4f);
    // The same volume again is not nearer; a volume whose first probe is at the point contains it.
    choice = chooseVolume(choice, v, 4, point);
    giveBits(lane, uint(choice.volume));
    Volume here = v;
    here.origin = point;
    choice = chooseVolume(choice, here, 5, point);
    give(lane, choice.distance, 2e-4f);
}

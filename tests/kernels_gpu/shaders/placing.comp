#include "lane.h"

#include "some_volume.h"

#include "kernels/probe/placing.h"

void evaluate(INOUT(Lane) lane) {
    const Volume v = takeVolume(lane);
    const uint word = takeBits(lane);
    const int rules = takeIndex(lane, 2);
    const bool relocates = takeIndex(lane, 2) == 1;
    PlaceSight sight = nothingSeen();
    for (int i = 0; i < 4; ++i) {
        const vec3 direction = takeDirection(lane);
        addToPlaceSight(sight, direction, takeBetween(lane, -1.0f, 2.0f), i == 1);
    }
    const uint begun = beginPlacing(word);
    giveBits(lane, begun);
    const uint looked = lookedAround(v, begun, sight, 4, relocates, rules);
    giveBits(lane, looked & 0xffu);
    // Bytes of the offset may round apart.
    giveVec3(lane, probeOffset(v, int(looked)), 0.05f);
    giveBits(lane, isPlaced(word, relocates) ? 1u : 0u);
    giveBits(lane, placedEvent(word, rules == 1, relocates));
}

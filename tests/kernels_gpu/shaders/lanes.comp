#include "lane.h"

#include "kernels/lanes.h"

void evaluate(INOUT(Lane) lane) {
    const float x = takeBetween(lane, -1.0f, 1.0f);
    give(lane, signNotZero(x), 0.0f);
    give(lane, signNotZero(0.0f), 0.0f);
    give(lane, select(x < 0.25f, x, 2.0f), 1e-6f);
    giveBits(lane, anyOf(x < 0.25f) ? 1u : 0u);
    const int word = int(takeBits(lane));
    for (int byte = 0; byte < 4; ++byte) {
        giveBits(lane, uint(signedByte(word, byte)));
        give(lane, toReal(signedByte(word, byte)), 0.0f);
    }
    giveBits(lane, uint(shiftedRight(word, 5)));
    giveBits(lane, uint(toInt(floor(x * 8.0f)) + 8));
}

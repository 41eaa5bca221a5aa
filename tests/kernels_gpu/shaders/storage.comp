#include "lane.h"

#include "kernels/storage.h"

// Bits in, bits out: exact.
void evaluate(INOUT(Lane) lane) {
    const uint bits = takeBits(lane);
    const uint anyFinite = bits % 0x7f800000u;
    const uint half_ = packHalfDithered(uintBitsToFloat(anyFinite), takeBits(lane) & 8191u);
    giveBits(lane, half_);
    give(lane, unpackHalf(half_), 0.0f);
    const uint u = packUnorm16Dithered(float(bits >> 16u) * (1.0f / 65536.0f), takeUnit(lane));
    giveBits(lane, u);
    give(lane, unpackUnorm16(u), 1e-7f);
    giveBits(lane, storageDither(bits, takeBits(lane)));
}

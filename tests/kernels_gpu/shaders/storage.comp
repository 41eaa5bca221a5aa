#include "lane.h"

#include "kernels/probe/storage.h"

// Conversions between bits: all exact but the 16-bit integers.
void evaluate(INOUT(Lane) lane) {
    const uint bits = takeBits(lane);
    const uint anyFinite = bits % 0x7f800000u;
    const uint half_ = packHalfDithered(uintBitsToFloat(anyFinite), takeBits(lane) & 8191u);
    giveBits(lane, half_);
    give(lane, unpackHalf(half_), 0.0f);
    const uint u = packUnorm16Dithered(float(bits >> 16u) * (1.0f / 65536.0f), takeUnit(lane));
    // One step of the format: a fused multiply-add may round the other way where the dither decides.
    give(lane, unpackUnorm16(u), 1.1f / 65535.0f);
    giveBits(lane, storageDither(bits, takeBits(lane)));
}

// Relocation (section 5): a probe may stand off its place in the lattice. Offsets are in the volume's frame, in shares
// of its spacing, one signed byte an axis in the three upper bytes of the probe's placement word; the lowest byte is
// its state (kernels/probe/probe_state.h). Indexing knows nothing of them: a cage is still made of eight cells.
#ifndef PROBEGI_KERNELS_PROBE_OFFSET_H
#define PROBEGI_KERNELS_PROBE_OFFSET_H

#include "kernels/volume/volume_frame.h"

KERNELS_BEGIN

// Share of the spacing that the largest byte, 127, stands for.
KERNEL_CONST float kLargestOffset = 0.5f;

// Offset of a probe from its place in the lattice, metres, in the volume's frame.
KERNEL_FN Real3 probeOffset(Volume v, Int placement) {
    const vec3 step = v.spacing * (kLargestOffset / 127.0f);
    return Real3(toReal(signedByte(placement, 1)) * step.x, toReal(signedByte(placement, 2)) * step.y,
                 toReal(signedByte(placement, 3)) * step.z);
}

KERNELS_END

#endif

// The octahedral map between unit vectors and the square (Cigolle et al. 2014, section 3.2; used by the DDGI paper's
// probes, section 3 "Probe Representation"). A map of `size` x `size` texels has its texel (x, y) centred at
// ((x, y) + 0.5) / size of the square [-1, 1]^2.
#ifndef PROBEGI_KERNELS_OCTAHEDRAL_H
#define PROBEGI_KERNELS_OCTAHEDRAL_H

#include "kernels/lanes.h"

KERNELS_BEGIN

// Vector of any non-zero length -> [-1, 1]^2.
KERNEL_FN Real2 octEncode(Real3 d) {
    const Real inv = 1.0f / (abs(d.x) + abs(d.y) + abs(d.z));
    const Real px = d.x * inv;
    const Real py = d.y * inv;
    const Real foldX = (1.0f - abs(py)) * signNotZero(px);
    const Real foldY = (1.0f - abs(px)) * signNotZero(py);
    return Real2(select(d.z < 0.0f, foldX, px), select(d.z < 0.0f, foldY, py));
}

// [-1, 1]^2 -> unit vector.
KERNEL_FN Real3 octDecode(Real2 p) {
    const Real z = 1.0f - abs(p.x) - abs(p.y);
    const Real x = select(z < 0.0f, (1.0f - abs(p.y)) * signNotZero(p.x), p.x);
    const Real y = select(z < 0.0f, (1.0f - abs(p.x)) * signNotZero(p.y), p.y);
    const Real inv = 1.0f / sqrt(x * x + y * y + z * z);
    return Real3(x * inv, y * inv, z * inv);
}

// Point of the square -> texel units: texel (x, y) is centred at (x, y), the border is at -1 and size.
KERNEL_FN Real2 octTexelPosition(Real2 p, int size) {
    const float half_ = 0.5f * float(size);
    return Real2(p.x * half_ + (half_ - 0.5f), p.y * half_ + (half_ - 0.5f));
}

KERNELS_END

#endif

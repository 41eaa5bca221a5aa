// From the light that a cage's probes see to the light at the surface. Probes behind a surface do not count, so its
// light is read up to a cell in front of it, nearer to whatever lights it: 3 to 5 % too bright on average, far more
// under a lamp. How light changes along the normal is known from the layer of probes beyond the cage's front, and what
// that predicts for the way back to the surface is taken away. Nothing is ever added: where light seems to rise towards
// a surface, the probe beyond is mostly in the shade of something else (measured: docs/accuracy.md).
#ifndef PROBEGI_KERNELS_SURFACE_GRADIENT_H
#define PROBEGI_KERNELS_SURFACE_GRADIENT_H

#include "kernels/lookup/probe_query.h"

KERNELS_BEGIN

// The largest share of the (square root of the) light that is taken away.
KERNEL_CONST float kMaxTaken = 0.5f;
// Weight of the pairs of probes at which their gradient is trusted in full.
KERNEL_CONST float kTrustedWeight = 0.1f;
// Rise from cell to cell, as a share of the (square root of the) light, that is not believed; twice as much is in full.
// Small rises are mostly noise of the probes, and to take what noise adds but never give back what it takes would
// darken everything, closed rooms of many bounces most.
KERNEL_CONST float kDoubtfulRise = 0.01f;
// Lead of the normal's largest component over the next at which its axis counts in full.
KERNEL_CONST float kAxisLead = 0.15f;

// The axis of the grid along which a normal points most.
KERNEL_FN Int dominantAxis(Real3 normal) {
    const Real x = abs(normal.x);
    const Real y = abs(normal.y);
    const Real z = abs(normal.z);
    return select(x >= y && x >= z, Int(0), select(y >= z, Int(1), Int(2)));
}

// How far that axis stands for the normal, 0..1: 0 where another takes over, so that round surfaces have no seams.
KERNEL_FN Real axisTrust(Real3 normal) {
    const Real x = abs(normal.x);
    const Real y = abs(normal.y);
    const Real z = abs(normal.z);
    const Real largest = max(x, max(y, z));
    const Real middle = x + y + z - largest - min(x, min(y, z));
    return min(max((largest - middle) * (1.0f / kAxisLead), Real(0.0f)), Real(1.0f));
}

// Cells along the axis by which the light was read in front of the surface; `ahead`: the weighted mean of the probes'
// distance to the surface's plane, metres.
KERNEL_FN Real cellsAhead(Real ahead, Real axisSpacing, Real normalOnAxis) {
    return max(ahead, Real(0.0f)) / (axisSpacing * abs(normalOnAxis));
}

// One channel at the surface. `root`: what the cage answers; `rise`: sum over the pairs of weight times what the probe
// beyond has more than the one in front, both in the space of decodeToBlendSpace(); `pairWeight`: sum of the weights.
// A steep rise is damped: light that falls by its own size within a cell is not linear.
KERNEL_FN Real rootAtSurface(Real root, Real rise, Real pairWeight, Real cells, Real trust) {
    const Real known = cells * trust * min(Real(1.0f), pairWeight * (1.0f / kTrustedWeight));
    // The tiny addends decide 0 / 0: no pairs, or no light.
    const Real slope = max(rise, Real(0.0f)) * (1.0f / (pairWeight + 1e-20f));
    const Real doubt = kDoubtfulRise * root + 1e-20f;
    const Real believed = slope * min(max(slope / doubt - 1.0f, Real(0.0f)), Real(1.0f));
    const Real damped = believed * root / (believed + root + 1e-20f);
    return root - min(damped * known, root * kMaxTaken);
}

KERNELS_END

#endif

// Weights of the eight probes around a point (DDGI paper, sections 2.2 and 4.1).
#ifndef PROBEGI_KERNELS_PROBE_QUERY_H
#define PROBEGI_KERNELS_PROBE_QUERY_H

#include "kernels/lanes.h"

KERNELS_BEGIN

// Which rules a query follows, in the order of probegi::FieldRules: those that measurements led to (docs/accuracy.md),
// or the paper's to the letter.
KERNEL_CONST int kRulesMeasured = 0;
KERNEL_CONST int kRulesPaper = 1;

// Weight of a probe straight behind the surface. Majercik et al. 2019 add 0.2; against a sealed room 0.05 halves the
// leak (docs/accuracy.md), and points that no probe faces have the wider search to fall back on.
KERNEL_FN float backfaceFloor(int rules) {
    return rules == kRulesPaper ? 0.2f : 0.05f;
}

// Chebyshev weights never fall below this: where all eight probes are shadowed, ratios still decide. Small, since it is
// what eight shadowed probes leak together; the paper's rules keep the usual 0.05.
KERNEL_FN float chebyshevFloor(int rules) {
    return rules == kRulesPaper ? 0.05f : 0.003f;
}

// Smallest trilinear factor per axis, so that a point on a cell's face still has a fallback on the far side.
KERNEL_CONST float kMinTrilinear = 0.001f;
// Weights below this are crushed.
KERNEL_CONST float kCrushBelow = 0.2f;

// Share of backface hits at which a probe begins to count as inside geometry, and over which it ceases to be used.
KERNEL_CONST float kInsideShare = 0.25f;
KERNEL_CONST float kInsideShareEdge = 0.05f;

// omega_o of a query: a `toViewer` of zero stands for the normal, where nobody looks.
KERNEL_FN Real3 viewerOf(Real3 toViewer, Real3 normal) {
    const Real square = toViewer.x * toViewer.x + toViewer.y * toViewer.y + toViewer.z * toViewer.z;
    return Real3(select(square > 0.0f, toViewer.x, normal.x), select(square > 0.0f, toViewer.y, normal.y),
                 select(square > 0.0f, toViewer.z, normal.z));
}

// Eq. 2: the offset from a surface point to where visibility is tested. `toViewer` is omega_o.
KERNEL_FN Real3 selfShadowBias(Real3 normal, Real3 toViewer, float minSpacing, float tunableBias) {
    return (normal * 0.2f + toViewer * 0.8f) * (0.75f * minSpacing * tunableBias);
}

// Where visibility is tested, from the point. Eq. 2 by the paper's rules. Measured: longer along the normal, so that
// behind a thin wall a point lies well behind the mean distance of what is on the wall's other side; and less towards
// the viewer, who may look along a wall. Leak through 2 cm at 1 m: a third of eq. 2's (docs/accuracy.md).
KERNEL_FN Real3 visibilityBias(Real3 normal, Real3 toViewer, float minSpacing, float tunableBias, int rules) {
    if (rules == kRulesPaper) return selfShadowBias(normal, toViewer, minSpacing, tunableBias);
    return (normal * 1.3f + toViewer * 0.67f) * (0.75f * minSpacing * tunableBias);
}

// By how much a point is moved before its cage is chosen: not at all by the paper's rules. Measured: with all of eq. 2,
// surfaces take the light of the room's middle (Cornell box 10 % too bright on average); with none, a wall that
// coincides with a layer of probes leaks three times as much. A quarter has nearly the best of both.
KERNEL_FN Real3 cageBias(Real3 normal, Real3 toViewer, float minSpacing, float tunableBias, int rules) {
    return selfShadowBias(normal, toViewer, minSpacing, tunableBias) * (rules == kRulesPaper ? 0.0f : 0.25f);
}

// Trilinear factor of one axis: `corner` is 0 or 1, `alpha` the position in the cell, 0..1.
KERNEL_FN Real trilinearFactor(float corner, Real alpha) {
    return max(Real(kMinTrilinear), corner * alpha + (1.0f - corner) * (1.0f - alpha));
}

// Share of the smallest spacing within which a probe has no side. A point on a probe itself (those beyond the grid are
// moved to its faces, and may land there) sees it in no direction, and the rounding of its place must not choose one.
KERNEL_CONST float kProbeRadius = 1e-3f;

// Cosine between the normal and the direction to the probe, from their product and the probe's distance.
KERNEL_FN Real cosineToProbe(Real product, Real distance, float minSpacing) {
    return product / (distance + kProbeRadius * minSpacing);
}

// Smooth backface weight: ((cos + 1) / 2)^2 and a floor, with the cosine between the normal and the direction to the
// probe.
KERNEL_FN Real backfaceWeight(Real cosToProbe, int rules) {
    const Real wrap = cosToProbe * 0.5f + 0.5f;
    return wrap * wrap + backfaceFloor(rules);
}

// One-sided Chebyshev bound on the share of light that passes `distance`, from the mean and mean square of the distance
// to the nearest surface; cubed to darken what is uncertain. 1 in front of the mean.
KERNEL_FN Real chebyshevWeight(Real mean, Real meanSquare, Real distance, int rules) {
    const Real variance = abs(meanSquare - mean * mean);
    const Real behind = max(distance - mean, Real(0.0f));
    // The tiny addend decides 0 / 0: a surface without variance blocks nothing in front of it and everything behind.
    const Real bound = (variance + 1e-12f) / (variance + behind * behind + 1e-12f);
    return max(bound * bound * bound, Real(chebyshevFloor(rules)));
}

// Small weights shrink with their cube, so that eight leaking probes do not add up to a leak.
KERNEL_FN Real crushWeight(Real w) {
    return select(w < kCrushBelow, w * w * w * (1.0f / (kCrushBelow * kCrushBelow)), w);
}

// Share of backfaces of a probe that has had no update since it entered its volume: look-ups pass it over, whatever the
// rules.
KERNEL_CONST float kNeverUpdated = 2.0f;

// How far a probe may be used at all: not when more than a quarter of what it hits are backfaces, since then it stands
// in a wall or outside the modelled world. Listing 4 draws the line at a quarter of all rays; a share of the hits also
// finds probes that look at a closed shell from the void around it. A soft edge keeps the answer continuous in time.
// The paper moves such probes or switches them off; in a query it has no such rule.
KERNEL_FN Real outsideWeight(Real backfaceShare, int rules) {
    if (rules == kRulesPaper) return select(backfaceShare > 1.0f, Real(0.0f), Real(1.0f));
    return max(Real(0.0f), 1.0f - max(Real(0.0f), backfaceShare - kInsideShare) * (1.0f / kInsideShareEdge));
}

KERNELS_END

#endif

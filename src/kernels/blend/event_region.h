// A box in which an announced change lowers what probes keep of their old light (DDGI paper, section 4.3, which lowers
// it for all probes and says "it would probably be more effective to reduce hysteresis only for probes affected").
#ifndef PROBEGI_KERNELS_EVENT_REGION_H
#define PROBEGI_KERNELS_EVENT_REGION_H

#include "kernels/blend/temporal_filter.h"

KERNELS_BEGIN

// Most boxes of one update.
KERNEL_CONST int kMostEventRegions = 8;

struct EventRegion {
    vec3 lower;            // metres, of the world's axes
    vec3 upper;            // included
    float irradianceKept;  // largest share of the old irradiance that a probe inside keeps; 1: no limit
    float visibilityKept;  // the same for distances
};

// What the boxes leave a probe: the smallest shares of those it is in. Nothing says 1.
struct EventLimit {
    float irradianceKept;
    float visibilityKept;
};

KERNEL_FN EventLimit noEventLimit() {
    EventLimit limit;
    limit.irradianceKept = 1.0f;
    limit.visibilityKept = 1.0f;
    return limit;
}

KERNEL_FN bool isInRegion(EventRegion region, vec3 position) {
    return position.x >= region.lower.x && position.y >= region.lower.y && position.z >= region.lower.z &&
           position.x <= region.upper.x && position.y <= region.upper.y && position.z <= region.upper.z;
}

KERNEL_FN void addEventRegion(INOUT(EventLimit) limit, EventRegion region, vec3 position) {
    if (!isInRegion(region, position)) return;
    limit.irradianceKept = min(limit.irradianceKept, region.irradianceKept);
    limit.visibilityKept = min(limit.visibilityKept, region.visibilityKept);
}

// The window whose rate is what a hysteresis lets in, in updates.
KERNEL_FN float windowOfHysteresis(float hysteresis) {
    return 1.0f / (1.0f - hysteresis);
}

// A window, in updates, that keeps no more than this; 1: any.
KERNEL_FN float limitedWindow(float window, float kept) {
    return kept < 1.0f ? min(window, max(windowOfHysteresis(kept), 1.0f)) : window;
}

// The same for the share that a window keeps.
KERNEL_FN float limitedKept(float share, float kept) {
    return kept < 1.0f ? min(share, keptBy(windowOfHysteresis(kept))) : share;
}

KERNELS_END

#endif

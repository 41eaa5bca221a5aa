// What the passes of relocation and states share (kernels/probe/placing.h).
#ifndef PROBEGI_PLACES_GLSL
#define PROBEGI_PLACES_GLSL

#include "volume.glsl"

#include "kernels/abi/gpu_passes.h"
#include "kernels/lookup/used_probes.h"
#include "kernels/probe/placing.h"

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer BoundsList {
    GpuBounds at[];
};

layout(push_constant, scalar) uniform Push {
    PlacesPush push;
};

bool relocates() {
    return (push.flags & kPlacesRelocate) != 0;
}
bool sleeps() {
    return (push.flags & kPlacesSleep) != 0;
}

bool isNewProbe(int slot) {
    return stateOf(probegiStates.at[slot].placement) == kUninitialized;
}

// Whether a point is in something that moves.
bool moves(vec3 point) {
    for (uint i = 0u; i < push.moving; ++i) {
        const GpuBounds b = BoundsList(push.boxes).at[i];
        if (holdsPoint(Box(b.lower, b.upper), point)) return true;
    }
    return false;
}

// The probes, of all volumes, that a surface uses.
void markUsed(vec3 position, vec3 normal) {
    if (!sleeps()) return;
    for (int i = 0; i < probegiField.volumeCount; ++i) {
        const Volume v = probegiField.volumes[i];
        const UsedProbes used = usedProbes(v, position, normal, probegiField.selfShadowBias, probegiField.rules);
        for (int z = used.lowest.z; z <= used.highest.z; ++z)
            for (int y = used.lowest.y; y <= used.highest.y; ++y)
                for (int x = used.lowest.x; x <= used.highest.x; ++x)
                    Uints(push.surfaces).at[probeSlot(v, ivec3(x, y, z))] = 1u;
    }
}

#endif

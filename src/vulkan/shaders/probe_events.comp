// Announced changes make probes near them keep less of their old values. One thread per probe; run only in updates
// that have such boxes.
#include "filter.glsl"
#include "tasks.glsl"

layout(push_constant, scalar) uniform Push {
    EventPush push;
};
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer EventRegions {
    EventRegion at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer EventLimits {
    EventLimit at[];
};

EventLimit limitOf(uint probe, vec3 position) {
    EventLimit limit = noEventLimit();
    if (push.limits != uvec2(0u)) limit = EventLimits(push.limits).at[probe];
    for (int i = 0; i < push.count; ++i) addEventRegion(limit, EventRegions(push.regions).at[i], position);
    return limit;
}

void limitWindows(uint probe, EventLimit limit) {
    ProbeFilter probeFilter = unpackFilter(ProbeFilters(push.filters).at[probe]);
    ProbeFilters(push.filters).at[probe].words[5] =
        packWindows(limitedWindow(probeFilter.window, limit.irradianceKept),
                    limitedWindow(probeFilter.visibilityWindow, limit.visibilityKept));
    ProbeSteps(push.steps).at[probe].irradianceKept =
        limitedKept(ProbeSteps(push.steps).at[probe].irradianceKept, limit.irradianceKept);
    ProbeSteps(push.steps).at[probe].visibilityKept =
        limitedKept(ProbeSteps(push.steps).at[probe].visibilityKept, limit.visibilityKept);
}

void main() {
    const uint index = globalIndex();
    if (index >= Tasks(push.tasks).counts.tasks) return;
    const ProbeTask task = Tasks(push.tasks).at[index];
    const EventLimit limit = limitOf(task.slot, task.origin);
    if (push.windows != 0) {
        limitWindows(task.slot, limit);
        return;
    }
    const bool keeps = !isNew(ProbeFilters(push.filters).at[task.slot]);
    ProbeSteps(push.steps).at[task.slot].irradianceKept =
        keeps ? min(push.irradianceHysteresis, limit.irradianceKept) : 0.0;
    ProbeSteps(push.steps).at[task.slot].visibilityKept =
        keeps ? min(push.visibilityHysteresis, limit.visibilityKept) : 0.0;
}

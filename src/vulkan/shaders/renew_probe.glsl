// What a probe has that knows nothing: one that entered its volume, or was placed elsewhere, or fell asleep.
#ifndef PROBEGI_RENEW_PROBE_GLSL
#define PROBEGI_RENEW_PROBE_GLSL

#include "filter.glsl"
#include "sides.glsl"
#include "volume.glsl"

void renewProbe(int slot, uvec2 sides, uvec2 filters) {
    probegiStates.at[slot].backfaceShare = kNeverUpdated;
    Sides(sides).at[slot] = noSides();
    ProbeFilters(filters).at[slot] = newFilter();
    const ivec3 tile = poolTile(probegiField.tiles, slot);
    const int irradiance = probegiField.irradianceTexels, visibility = probegiField.visibilityTexels;
    for (int y = -1; y <= irradiance; ++y)
        for (int x = -1; x <= irradiance; ++x)
            imageStore(irradianceImage, ivec3(tileOrigin(tile, irradiance) + ivec2(x, y), tile.z), vec4(0.0));
    for (int y = -1; y <= visibility; ++y)
        for (int x = -1; x <= visibility; ++x)
            imageStore(visibilityImage, ivec3(tileOrigin(tile, visibility) + ivec2(x, y), tile.z), vec4(0.0));
}

#endif

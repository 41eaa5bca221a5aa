// Probes that entered a volume with a step of scrolling know nothing. One thread per probe of the volume.
#include "filter.glsl"
#include "sides.glsl"
#include "volume.glsl"

layout(push_constant, scalar) uniform Push {
    EnterPush push;
};

void main() {
    const Volume volume = probegiField.volumes[push.volume];
    const uint index = globalIndex();
    if (index >= uint(volumeProbes(volume))) return;
    const int slot = volume.firstSlot + int(index);
    if (!hasEntered(volume, probeCell(volume, slot), push.cells)) return;
    probegiStates.backfaceShare[slot] = kNeverUpdated;
    Sides(push.sides).at[slot] = noSides();
    ProbeFilters(push.filters).at[slot] = newFilter();
    const ivec3 tile = poolTile(probegiField.tiles, slot);
    const int irradiance = probegiField.irradianceTexels, visibility = probegiField.visibilityTexels;
    for (int y = -1; y <= irradiance; ++y)
        for (int x = -1; x <= irradiance; ++x)
            imageStore(irradianceImage, ivec3(tileOrigin(tile, irradiance) + ivec2(x, y), tile.z), vec4(0.0));
    for (int y = -1; y <= visibility; ++y)
        for (int x = -1; x <= visibility; ++x)
            imageStore(visibilityImage, ivec3(tileOrigin(tile, visibility) + ivec2(x, y), tile.z), vec4(0.0));
}

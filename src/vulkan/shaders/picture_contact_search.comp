// Horizon search around each sample, and the light of what rises above the horizon.
#include "picture_contact.glsl"

#include "kernels/screen/contact_way.h"

// One side of a slice, `across` pixels across and down for each pixel along it.
void searchSide(int x, int y, ScreenSample from, ContactSlice slice, float sign, vec2 across, float phase, float widest,
                ContactBlock block, inout ContactSums sums) {
    ContactSide side = contactSide(slice, sign);
    for (int step = 0; step < kContactSteps; ++step) {
        const vec2 off = sign * contactStep(step, phase, widest) * across;
        const int i = x + int(floor(off.x + 0.5));
        const int j = y + int(floor(off.y + 0.5));
        if (!inFrame(i, j)) break;
        const ScreenSample tap = Samples(push.samples).at[j * push.width + i];
        if (tap.kind == kSampleSky) continue;
        const vec3 offset = tap.position - from.position;
        const vec3 radiance = contactRadiance(tap.direct, tap.albedo, tap.irradiance);
        const float share = block.limited != 0 ? contactShare(radiance, from.irradiance) : 1.0;
        const float arc = raiseHorizon(side, slice, from.geometricNormal, offset, block.reach, share);
        if (arc > 0.0) addContact(sums, arc * slice.weight, offset, tap.geometricNormal, radiance, tap.albedo);
    }
}

void main() {
    const uint index = globalIndex();
    if (index >= push.sampleCount) return;
    const ContactBlock block = contactBlock();
    const ScreenSample from = Samples(push.samples).at[index];
    ContactSums sums = noContact();
    if (from.kind == kSampleSurface) {
        const int x = int(index) % push.width;
        const int y = int(index) / push.width;
        const vec2 random = contactPattern(x, push.firstRow + y, block.round + push.firstPlane);
        for (int i = 0; i < kContactSlices; ++i) {
            const ContactWay way = contactWay(push.camera, from.viewDirection, i, random.x);
            const float widest = contactWidest(way, from.distance, block.reach);
            const ContactSlice slice =
                contactSlice(-from.viewDirection, way.tangent, from.shadingNormal, from.geometricNormal);
            sums.whole += contactWhole(slice);
            for (int side = 0; side < 2; ++side)
                searchSide(x, y, from, slice, float(2 * side - 1), way.across, random.y, widest, block, sums);
        }
    }
    ContactFounds(block.found).at[index] = contactFound(sums, from.irradiance);
}

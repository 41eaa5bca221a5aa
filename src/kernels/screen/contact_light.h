// What the samples around a sample of the screen send to it (SDFDDGI paper, section 3.5; not by its eq. 5, see
// docs/architecture.md).
#ifndef PROBEGI_KERNELS_CONTACT_LIGHT_H
#define PROBEGI_KERNELS_CONTACT_LIGHT_H

#include "kernels/screen/contact_slice.h"

KERNELS_BEGIN

// Random numbers of a sample: the slices' turn and the steps' phase. 4 x 4 pixels share 16 turns, in Bayer's order, so
// that small groups of pixels are evenly spread too; `round` numbers the planes, and pictures of a series.
KERNEL_FN vec2 contactPattern(int x, int y, int round) {
    const int along = x & 3;
    const int down = y & 3;
    const int fine = 2 * ((along ^ down) & 1) + (down & 1);
    const int coarse = 2 * (((along ^ down) >> 1) & 1) + ((down >> 1) & 1);
    const float order = float(4 * fine + coarse);
    const float turns = float(round & 1023);
    return fract(vec2((order + 0.5f) * 0.0625f, 0.5f + order * 0.6180339887f) +
                 turns * vec2(0.6180339887f, 0.7548776662f));
}

// Radiance of a sample, whichever way one looks: its own and its lamps', and what it reflects as Lambert surfaces do.
KERNEL_FN vec3 contactRadiance(vec3 direct, vec3 albedo, vec3 irradiance) {
    return direct + albedo * irradiance * (1.0f / kPi);
}

// Times the mean radiance around a sample: what is brighter, lamps above all, is left to the probes, since a few
// samples of it are mostly noise.
KERNEL_CONST float kContactBrightest = 12.0f;

// How far a radiance is contact's, 1 to 0; `field`: E of the sample itself by the probes.
KERNEL_FN float contactShare(vec3 radiance, vec3 field) {
    const float bright = max(radiance.x, max(radiance.y, radiance.z));
    const float most = max(field.x, max(field.y, field.z)) * (kContactBrightest / kPi);
    return bright > most ? most / bright : 1.0f;
}

// Sums over slices.
struct ContactSums {
    vec3 irradiance;  // from sides that are seen
    vec3 hidden;      // share of E from sides that are not seen, times their albedo
    float taken;      // share of E of both
    float whole;
};

KERNEL_FN ContactSums noContact() {
    ContactSums sums;
    sums.irradiance = sums.hidden = vec3(0.0f);
    sums.taken = sums.whole = 0.0f;
    return sums;
}

// A sample that takes `arc` of E (raiseHorizon() times the slice's weight). What is seen of it may be its other side:
// then nothing is known but its albedo.
KERNEL_FN void addContact(INOUT(ContactSums) sums, float arc, vec3 offset, vec3 normal, vec3 radiance, vec3 albedo) {
    if (dot(normal, offset) < 0.0f)
        sums.irradiance += arc * radiance;
    else
        sums.hidden += arc * albedo;
    sums.taken += arc;
}

// What was found around a sample.
struct ContactFound {
    vec3 light;       // E of what was found, W m^-2
    vec4 difference;  // what E is more than the probes say, and the share of E's directions that was found
};

// Of a sample with E by the probes of `field`. They stand for what was not found, whose share of E is as large as its
// share of the directions; hidden sides have the light of the sample itself: E = open field + seen + hidden E. In
// uniform light all this is no difference.
KERNEL_FN ContactFound contactFound(IN(ContactSums) sums, vec3 field) {
    const float scale = sums.whole > 0.0f ? 1.0f / sums.whole : 0.0f;
    const float taken = min(sums.taken * scale, 1.0f);
    const vec3 seen = sums.irradiance * (kPi * scale);
    const vec3 hidden = min(sums.hidden * scale, vec3(0.99f));
    const vec3 more = (seen + field * (hidden - vec3(taken))) / (vec3(1.0f) - hidden);
    ContactFound found;
    found.light = more + field * taken;
    found.difference = vec4(more.x, more.y, more.z, taken);
    return found;
}

KERNELS_END

#endif

#include "lane.h"

#include "kernels/screen/contact_light.h"

void evaluate(INOUT(Lane) lane) {
    const int x = takeIndex(lane, 9000);
    const int y = takeIndex(lane, 9000);
    const int round = takeIndex(lane, 64);
    giveVec2(lane, contactPattern(x, y, round), 1e-3f);
    const vec3 irradiance = takeVector(lane, 0.0f, 10.0f);
    const vec3 albedo = takeVector(lane, 0.0f, 0.9f);
    const vec3 radiance = contactRadiance(irradiance, albedo, irradiance);
    giveVec3(lane, radiance, 1e-5f);
    const vec3 normal = takeDirection(lane);
    const vec3 offset = takeDirection(lane);
    const vec3 facing = dot(normal, offset) < 0.0f ? normal : -normal;
    ContactSums sums = noContact();
    sums.whole = takeBetween(lane, 1.0f, 2.0f);
    const float arc = takeBetween(lane, 0.01f, 0.4f);
    // Both sides, but not edge on, where a rounding decides which one is seen.
    const bool clear = dot(facing, offset) < -0.01f;
    if (clear) addContact(sums, arc, offset, facing, radiance, albedo);
    if (clear) addContact(sums, 0.5f * arc, offset, -facing, radiance, albedo);
    give(lane, contactShare(radiance, irradiance), 1e-4f);
    const ContactFound found = contactFound(sums, irradiance);
    giveVec3(lane, found.light, 1e-4f);
    giveVec3(lane, vec3(found.difference.x, found.difference.y, found.difference.z), 1e-3f);
    give(lane, found.difference.w, 1e-5f);
}

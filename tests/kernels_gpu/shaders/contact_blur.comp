#include "lane.h"

#include "kernels/screen/contact_blur.h"

void evaluate(INOUT(Lane) lane) {
    give(lane, contactTap(takeIndex(lane, 5) - 2, 1), 0.0f);
    const vec3 normal = takeDirection(lane);
    const GlossyGuide centre = contactGuide(vec3(0.0f), normal, takeBetween(lane, 1.0f, 5.0f));
    const vec3 beside = takeVector(lane, 0.0f, 0.01f);
    const vec3 turned = normalize(normal + takeVector(lane, -0.1f, 0.1f));
    const GlossyGuide tap = contactGuide(beside, turned, 2.0f);
    give(lane, guideWeight(centre, tap, takeBetween(lane, 0.0f, 3.0f), 1e-2f), 1e-4f);
    const vec3 light = takeVector(lane, -5.0f, 5.0f);
    ContactMean mean = contactMean(vec4(normal.x, normal.y, normal.z, 0.5f), 0.25f);
    addContactTap(mean, vec4(light.x, light.y, light.z, 0.1f), takeUnit(lane));
    const vec4 all = contactMeanOf(mean);
    giveVec3(lane, vec3(all.x, all.y, all.z), 1e-5f);
    give(lane, all.w, 1e-5f);
    giveVec3(lane, withContact(normal, all), 1e-5f);
}

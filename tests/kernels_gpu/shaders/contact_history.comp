#include "lane.h"

#include "kernels/screen/contact_history.h"

void evaluate(INOUT(Lane) lane) {
    const PinholeCamera camera =
        makePinhole(vec3(1.0f, 2.0f, 3.0f), vec3(0.0f, 0.0f, -1.0f), vec3(0.0f, 1.0f, 0.0f), 1.0f, 64, 48);
    const vec3 point = vec3(1.0f, 2.0f, -1.0f) + takeVector(lane, -2.0f, 2.0f);
    giveVec3(lane, pinholePixel(camera, point), 1e-3f);
    const vec3 normal = takeDirection(lane);
    ContactRecord record;
    const vec3 light = takeVector(lane, 0.0f, 5.0f);
    record.light = vec4(light.x, light.y, light.z, takeUnit(lane));
    record.position = takeVector(lane, 0.0f, 0.02f);
    record.normal = normalize(normal + takeVector(lane, -0.2f, 0.2f));
    record.count = takeBetween(lane, 0.0f, 20.0f);
    give(lane, recordWeight(record, vec3(0.0f), normal, 4.0f, 5e-3f), 1e-3f);
    ContactPast past = noPast();
    addRecord(past, record, takeBetween(lane, 0.05f, 0.5f));
    addRecord(past, record, takeBetween(lane, 0.05f, 0.5f));
    give(lane, past.weight, 1e-5f);
    float count = 0.0f;
    const vec4 kept = keptContact(past, vec4(normal.x, normal.y, normal.z, 0.5f), vec4(-2.0f), vec4(2.0f), count);
    giveVec3(lane, vec3(kept.x, kept.y, kept.z), 1e-4f);
    give(lane, kept.w, 1e-4f);
    give(lane, count, 1e-4f);
}

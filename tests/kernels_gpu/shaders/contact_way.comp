#include "lane.h"

#include "kernels/screen/contact_way.h"

void evaluate(INOUT(Lane) lane) {
    const vec3 forward = takeDirection(lane);
    const vec3 up = normalize(cross(forward, vec3(0.3f, 0.7f, 0.1f)) + forward * 1e-6f);
    const float yfov = takeBetween(lane, 0.1f, 2.0f);
    const int width = 1 + takeIndex(lane, 1920);
    const int height = 1 + takeIndex(lane, 1080);
    // Seen at grazing angles, which wider pictures have at their sides, ways are as long as rounding says.
    const int sides = clamp(width, height, 4 * height);
    const PinholeCamera camera = makePinhole(vec3(0.0f), forward, up, yfov, sides, height);
    const float x = takeBetween(lane, 0.0f, float(height));
    const float y = takeBetween(lane, 0.0f, float(height));
    const int slice = takeIndex(lane, kContactSlices);
    const float turn = takeUnit(lane);
    giveVec2(lane, contactAcross(slice, turn), 1e-5f);
    const ContactWay way = contactWay(camera, pinholeDirection(camera, x, y), slice, turn);
    giveVec2(lane, way.across, 1e-4f);
    giveVec3(lane, way.tangent, 1e-4f);
    give(lane, way.pixels, 1e-4f);
    const float distance = takeBetween(lane, 0.0f, 9.0f);
    const float widest = contactWidest(way, distance, 0.4f);
    give(lane, widest, 1e-4f);
    give(lane, contactStep(takeIndex(lane, kContactSteps), turn, widest), 1e-4f);
}

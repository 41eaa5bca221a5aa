#include "kernels/screen/contact_history.h"

#include <gtest/gtest.h>

namespace probegi::kernels {
namespace {

constexpr float kPixel = 2e-3f;  // radians

ContactRecord recordAt(vec3 position) {
    return {vec4(1, 2, 3, 0.5f), position, {0, 1, 0}, 3.0f};
}

TEST(ContactHistory, pointsAreFoundWhereTheyWereSeen) {
    const PinholeCamera camera = makePinhole(
        {1, 2, 3}, normalize(vec3(0.3f, -0.4f, -1)),
        normalize(cross(cross(normalize(vec3(0.3f, -0.4f, -1)), vec3(0, 1, 0)), normalize(vec3(0.3f, -0.4f, -1)))),
        1.0f, 64, 48);
    for (const vec2 at : {vec2(0.5f, 0.5f), vec2(31.25f, 40.5f), vec2(63.9f, 0.1f)}) {
        const vec3 point = camera.origin + pinholeDirection(camera, at.x, at.y) * 5.0f;
        const vec3 pixel = pinholePixel(camera, point);
        EXPECT_NEAR(pixel.x, at.x, 1e-3f);
        EXPECT_NEAR(pixel.y, at.y, 1e-3f);
        EXPECT_GT(pixel.z, 3.0f);
        EXPECT_LE(pinholePixel(camera, camera.origin - (point - camera.origin)).z, 0.0f);
    }
}

TEST(ContactHistory, otherSurfacesAreNotTheSame) {
    const vec3 up(0, 1, 0);
    EXPECT_NEAR(recordWeight(recordAt({0, 0, 0}), {0, 0, 0}, up, 5.0f, kPixel), 1.0f, 1e-6f);
    EXPECT_EQ(recordWeight(recordAt({0, 0.1f, 0}), {0, 0, 0}, up, 5.0f, kPixel), 0.0f);  // another depth
    EXPECT_EQ(recordWeight(recordAt({0.1f, 0, 0}), {0, 0, 0}, up, 5.0f, kPixel), 0.0f);  // another place
    EXPECT_EQ(recordWeight(recordAt({0, 0, 0}), {0, 0, 0}, {1, 0, 0}, 5.0f, kPixel), 0.0f);
    ContactRecord none = recordAt({0, 0, 0});
    none.count = 0.0f;
    EXPECT_EQ(recordWeight(none, {0, 0, 0}, up, 5.0f, kPixel), 0.0f);
}

TEST(ContactHistory, keepsTheMeanOfAllPicturesUpToTheLongest) {
    ContactPast past = noPast();
    float count = 0.0f;
    const vec4 lower(-100.0f), upper(100.0f);
    EXPECT_EQ(keptContact(past, vec4(4.0f), lower, upper, count), vec4(4.0f));
    EXPECT_EQ(count, 1.0f);
    ContactRecord record = recordAt({0, 0, 0});
    record.light = vec4(1.0f);
    addRecord(past, record, 0.25f);
    addRecord(past, record, 0.75f);
    EXPECT_NEAR(keptContact(past, vec4(5.0f), lower, upper, count).x, 2.0f, 1e-5f);  // (3 x 1 + 5) / 4
    EXPECT_NEAR(count, 4.0f, 1e-5f);
    past.count = 1000.0f;
    keptContact(past, vec4(5.0f), lower, upper, count);
    EXPECT_EQ(count, kContactLongest);
}

TEST(ContactHistory, oldLightIsHeldWithinTheNeighbourhood) {
    ContactPast past = noPast();
    ContactRecord record = recordAt({0, 0, 0});
    record.light = vec4(50.0f);
    addRecord(past, record, 1.0f);
    float count = 0.0f;
    EXPECT_EQ(keptContact(past, vec4(2.0f), vec4(2.0f), vec4(2.0f), count), vec4(2.0f));
    const vec4 kept = keptContact(past, vec4(2.0f), vec4(1.0f), vec4(2.0f), count);
    EXPECT_NEAR(kept.x, 2.0f + 0.75f, 1e-5f);
}

}  // namespace
}  // namespace probegi::kernels

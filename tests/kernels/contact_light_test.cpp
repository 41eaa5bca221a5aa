#include "kernels/screen/contact_light.h"

#include <gtest/gtest.h>

#include <set>

namespace probegi::kernels {
namespace {

TEST(ContactLight, sixteenPixelsHaveSixteenTurns) {
    std::set<int> turns, phases;
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x) {
            const vec2 random = contactPattern(x + 8, y + 12, 3);
            EXPECT_GE(random.x, 0.0f);
            EXPECT_LT(random.x, 1.0f);
            turns.insert(int(random.x * 16));
            phases.insert(int(random.y * 1000));
            EXPECT_EQ(random, contactPattern(x, y, 3));
            EXPECT_NE(random, contactPattern(x, y, 4));
        }
    EXPECT_EQ(turns.size(), 16u);
    EXPECT_EQ(phases.size(), 16u);
}

// Uniform light: whatever is taken, seen or hidden behind a white side, the light stays as it was.
TEST(ContactLight, aFurnaceStaysAsItIs) {
    const vec3 radiance(2, 1, 0.5f);
    ContactSums sums = noContact();
    sums.whole = 2.0f;
    addContact(sums, 0.3f, {1, 0.5f, 0}, {-1, 0, 0}, radiance, vec3(0.2f));
    addContact(sums, 0.2f, {1, 0.5f, 1}, {1, 0, 0}, vec3(7.0f), vec3(1.0f));
    const ContactFound found = contactFound(sums, kPi * radiance);
    EXPECT_NEAR(found.difference.w, 0.25f, 1e-6f);
    for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(found.difference[i], 0.0f, 1e-5f);
        EXPECT_NEAR(found.light[i], 0.25f * kPi * radiance[i], 1e-5f);
    }
}

TEST(ContactLight, nothingFoundIsNoDifference) {
    ContactSums sums = noContact();
    sums.whole = 2.0f;
    EXPECT_EQ(contactFound(sums, vec3(3, 2, 1)).light, vec3(0.0f));
    EXPECT_EQ(contactFound(sums, vec3(3, 2, 1)).difference, vec4(0.0f));
    EXPECT_EQ(contactFound(noContact(), vec3(3.0f)).difference, vec4(0.0f));  // no slices at all
}

// Half of the directions are black: E has lost half. All of them: all, and never more.
TEST(ContactLight, blackSurfacesTakeTheirShare) {
    for (const float share : {0.5f, 1.0f}) {
        ContactSums sums = noContact();
        sums.whole = 1.0f;
        addContact(sums, share, {0, 1, 1}, {0, 0, -1}, vec3(0.0f), vec3(0.0f));
        EXPECT_NEAR(contactFound(sums, vec3(4.0f)).difference.x, -4.0f * share, 1e-5f);
    }
}

// Hidden sides of albedo a have the light of the sample: E = (1 - s) field + s a E.
TEST(ContactLight, hiddenSidesSendWhatTheSampleHas) {
    ContactSums sums = noContact();
    sums.whole = 1.0f;
    addContact(sums, 0.5f, {0, 1, 1}, {0, 0, 1}, vec3(100.0f), vec3(0.6f));
    const ContactFound found = contactFound(sums, vec3(2.0f));
    const float wanted = 0.5f * 2.0f / (1.0f - 0.5f * 0.6f);
    EXPECT_NEAR(2.0f + found.difference.x, wanted, 1e-5f);
    EXPECT_NEAR(found.light.x, 0.5f * 0.6f * wanted, 1e-5f);
}

TEST(ContactLight, whatOutshinesTheSampleIsTheProbesOwn) {
    const vec3 field(kPi);  // a mean radiance of 1
    EXPECT_EQ(contactShare(vec3(1.0f), field), 1.0f);
    EXPECT_EQ(contactShare(vec3(kContactBrightest), field), 1.0f);
    EXPECT_NEAR(contactShare(vec3(0, 10.0f * kContactBrightest, 0), field), 0.1f, 1e-6f);
    EXPECT_EQ(contactShare(vec3(1.0f), vec3(0.0f)), 0.0f);
    EXPECT_EQ(contactShare(vec3(0.0f), vec3(0.0f)), 1.0f);
}

TEST(ContactLight, surfacesSendAllThatTheyHave) {
    EXPECT_NEAR(contactRadiance(vec3(1.0f), vec3(0.5f), vec3(2.0f * kPi)).x, 2.0f, 1e-5f);
}

}  // namespace
}  // namespace probegi::kernels

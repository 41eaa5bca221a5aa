// How likely each emissive triangle is to be sampled.
#include "scene/emitter_set.h"

#include <gmock/gmock.h>

#include <glm/geometric.hpp>

namespace probegi::test {

namespace {

EmissiveTriangle triangle(float size, int material) {
    EmissiveTriangle t;
    t.edge1 = {size, 0, 0};
    t.edge2 = {0, size, 0};
    t.material = material;
    return t;
}

float areaOf(const EmissiveTriangle& t) {
    return 0.5f * glm::length(glm::cross(t.edge1, t.edge2));
}

}  // namespace

TEST(EmitterSet, givesEachTriangleItsShareOfThePower) {
    // Areas 2, 0.5, 2 and luminances 1, 4, 3: powers 2, 2, 6.
    const EmitterSet set = makeEmitterSet({triangle(2, 0), triangle(1, 1), triangle(2, 2)}, {1, 4, 3});
    ASSERT_EQ(set.triangles.size(), 3u);
    EXPECT_NEAR(set.triangles[0].upTo / 4294967295.0, 0.2, 1e-6);
    EXPECT_NEAR(set.triangles[1].upTo / 4294967295.0, 0.4, 1e-6);
    EXPECT_EQ(set.triangles[2].upTo, 0xffffffffu);
    EXPECT_NEAR(set.inversePower, 0.1f, 1e-6f);
    float all = 0;
    for (const EmissiveTriangle& t : set.triangles) all += areaOf(t) * set.density(t.material);
    EXPECT_NEAR(all, 1.0f, 1e-5f);
    EXPECT_EQ(set.density(-1), 0.0f);
    EXPECT_EQ(set.density(3), 0.0f);
}

TEST(EmitterSet, neverChoosesWhatSendsNothing) {
    const EmitterSet set =
        makeEmitterSet({triangle(1, 0), triangle(0, 0), triangle(1, 1), triangle(1, 0), triangle(1, 1)}, {1, 0});
    ASSERT_EQ(set.triangles.size(), 5u);
    EXPECT_EQ(set.triangles[1].upTo, set.triangles[0].upTo);
    EXPECT_EQ(set.triangles[2].upTo, set.triangles[0].upTo);
    EXPECT_EQ(set.triangles[3].upTo, 0xffffffffu);
    EXPECT_EQ(set.triangles[4].upTo, 0xffffffffu);
}

TEST(EmitterSet, isEmptyWhereNothingSendsLight) {
    for (const EmitterSet& set : {makeEmitterSet({}, {}), makeEmitterSet({triangle(1, 0)}, {0}),
                                  makeEmitterSet({triangle(0, 0)}, {1}), makeEmitterSet({triangle(1e30f, 0)}, {1})}) {
        EXPECT_TRUE(set.empty());
        EXPECT_EQ(set.density(0), 0.0f);
    }
}

}  // namespace probegi::test

// Which triangles emit light, how likely each is to be sampled, and where a pose puts them.
#include "geometry/emitters.h"

#include "field/probe_emitters.h"
#include "support/field_setup.h"
#include "tracer/tracer_scene.h"

namespace probegi::test {

namespace {

Material glowing(glm::vec3 emission) {
    Material m;
    m.emission = emission;
    return m;
}

}  // namespace

TEST(EmitterGeometry, placesEveryInstanceOfAnEmissiveMesh) {
    TestScene s;
    const int lamp = s.addMaterial(glowing({1, 1, 1}));
    s.add(quad());
    const int shared = s.addMesh(quad(lamp));
    s.place(shared, glm::translate(glm::mat4(1.0f), {5, 0, 0}));
    s.place(shared, glm::scale(glm::mat4(1.0f), {2, 2, 2}));
    const EmitterSet set = EmitterGeometry(s.scene, s.pose).placed();
    ASSERT_EQ(set.triangles.size(), 4u);
    expectNear(set.triangles[0].corner, {4, 0, -1}, 1e-6f);
    EXPECT_NEAR(set.inversePower, 1.0f / (4 + 16), 1e-6f);
    EXPECT_NEAR(set.triangles[1].upTo / 4294967295.0, 0.2, 1e-6);
    for (const EmissiveTriangle& t : set.triangles) EXPECT_EQ(t.material, lamp);
}

TEST(EmitterGeometry, keepsTheFrontUnderAMirror) {
    TestScene s;
    const int lamp = s.addMaterial(glowing({1, 1, 1}));
    const int shared = s.addMesh(quad(lamp));
    s.place(shared);
    s.place(shared, glm::scale(glm::mat4(1.0f), {-1, 1, 1}));
    for (const EmissiveTriangle& t : EmitterGeometry(s.scene, s.pose).placed().triangles)
        expectNear(glm::normalize(glm::cross(t.edge1, t.edge2)), {0, 1, 0}, 1e-6f);
}

TEST(EmitterGeometry, movesWhatItsNodeMoves) {
    TestScene s;
    const int lamp = s.addMaterial(glowing({1, 1, 1}));
    const int mesh = s.addMesh(quad(lamp));
    s.pose.instances = {{mesh, 3, glm::mat4(1.0f)}, {mesh, 4, glm::mat4(1.0f)}};
    EmitterGeometry geometry(s.scene, s.pose);
    EXPECT_FALSE(geometry.place(5, glm::mat4(1.0f)));
    EXPECT_TRUE(geometry.place(4, glm::translate(glm::mat4(1.0f), {0, 7, 0})));
    const EmitterSet set = geometry.placed();
    EXPECT_EQ(set.triangles[0].corner.y, 0.0f);
    EXPECT_EQ(set.triangles[2].corner.y, 7.0f);
    // Scaled to nothing, it keeps its place in the list.
    geometry.place(4, glm::scale(glm::mat4(1.0f), glm::vec3(0)));
    EXPECT_EQ(geometry.placed().triangles.size(), 4u);
    EXPECT_EQ(geometry.placed().triangles[1].upTo, 0xffffffffu);
}

// Half of the texels are white, half sRGB 188 (linear 0.503): the mean is 0.75. A black texture emits nothing.
TEST(EmitterGeometry, weighsTexturesByTheirMean) {
    TestScene s;
    Material half = glowing({2, 2, 2}), black = glowing({2, 2, 2});
    half.emissiveTexture.image = s.addImage(2, 1, {255, 255, 255, 255, 188, 188, 188, 255});
    black.emissiveTexture.image = s.addImage(1, 1, {0, 0, 0, 255});
    const int lit = s.addMaterial(half), unlit = s.addMaterial(black);
    s.add(quad(lit));
    s.add(quad(unlit));
    const EmitterSet set = EmitterGeometry(s.scene, s.pose).placed();
    EXPECT_EQ(set.triangles.size(), 2u);
    EXPECT_NEAR(set.luminance[std::size_t(lit)], 1.503f, 2e-3f);
    EXPECT_EQ(set.luminance[std::size_t(unlit)], 0.0f);
}

TEST(EmitterSearch, isEmptyByThePaperWithoutSamplesAndWithoutEmitters) {
    TestScene s;
    s.add(quad(s.addMaterial(glowing({1, 1, 1}))));
    const auto tracer = trace(tracerMakers()[0], s);
    FieldSetup desc;
    const EmitterSearch search = emitterSearch(desc, *tracer, 5);
    EXPECT_TRUE(search);
    EXPECT_EQ(search.looks, desc.emitterSamples);
    EXPECT_LT(search.rayShare(1, 10.0f), 1e-3f);
    EXPECT_EQ(search.rayShare(0, 10.0f), 1.0f);
    EXPECT_EQ(search.rayShare(-1, 10.0f), 1.0f);
    desc.rules = FieldRules::paper;
    EXPECT_FALSE(emitterSearch(desc, *tracer, 5));
    EXPECT_EQ(EmitterSearch().rayShare(1, 10.0f), 1.0f);
    desc.emitterSamples = 0;
    desc.rules = FieldRules::measured;
    EXPECT_FALSE(emitterSearch(desc, *tracer, 5));
    TestScene dark;
    dark.add(quad());
    EXPECT_FALSE(emitterSearch({}, *trace(tracerMakers()[0], dark), 5));
}

}  // namespace probegi::test

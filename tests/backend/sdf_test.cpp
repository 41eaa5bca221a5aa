// Fields whose probes see primitives instead of triangles.
#include <gmock/gmock.h>

#include "backend/every_backend.h"
#include "probegi/shapes.h"

namespace probegi::test {
namespace {

constexpr float kAlbedo = 0.5f, kEmission = 2.0f;

SdfPrimitive boxBetween(glm::vec3 lower, glm::vec3 upper) {
    SdfPrimitive box;
    box.centre = 0.5f * (lower + upper);
    box.halfSize = 0.5f * (upper - lower);
    box.albedo = glm::vec3(kAlbedo);
    return box;
}

// Six slabs around a room of 4 x 3 x 5 m.
SdfScene room() {
    constexpr float kWall = 0.2f;
    const glm::vec3 size(4, 3, 5);
    SdfScene sdf;
    for (int axis = 0; axis < 3; ++axis) {
        glm::vec3 lower(-kWall), upper = size + kWall;
        upper[axis] = 0;
        sdf.primitives.push_back(boxBetween(lower, upper));
        lower[axis] = size[axis];
        upper[axis] = size[axis] + kWall;
        sdf.primitives.push_back(boxBetween(lower, upper));
    }
    return sdf;
}

class SdfField : public EveryBackend {
protected:
    std::unique_ptr<MovableTracer> open(const SdfScene& sdf, const Scene& scene = {}) const {
        return made(made(GetParam().open(context))->openSdf(sdf, scene, poseAt(scene)));
    }
    FieldSetup setup() const {
        FieldSetup setup;
        setup.volumes[0] = {{0.21f, 0.17f, 0.23f}, glm::vec3(0.9f), {5, 4, 6}};
        setup.raysPerProbe = 96;
        return setup;
    }
};
PROBEGI_ON_EVERY_BACKEND(SdfField);

// E = pi Le / (1 - a) at every point and normal of a furnace.
TEST_P(SdfField, isAFurnace) {
    SdfScene sdf = room();
    for (SdfPrimitive& wall : sdf.primitives) wall.emission = glm::vec3(kEmission);
    Field field = makeField(setup());
    const auto tracer = open(sdf);
    ASSERT_TRUE(field.converge(*tracer, {}, 0.002f));
    for (const glm::vec3 normal : {glm::vec3(0, 1, 0), glm::vec3(0.6f, 0, 0.8f)}) {
        const glm::vec3 e = field.irradiance({{1.2f, 1.1f, 2.9f}, normal, {}});
        EXPECT_NEAR(e.x / (3.14159265f * kEmission / (1 - kAlbedo)), 1, 0.01f);
    }
}

// Boxes as primitives and as triangles, a lamp and a box that throws a shadow: the same light.
TEST_P(SdfField, isThatOfTheSameTriangles) {
    SdfScene sdf = room();
    sdf.primitives.push_back(boxBetween({1.3f, 0, 1.2f}, {2.1f, 1.4f, 2.3f}));
    Scene scene;
    scene.materials.resize(1);
    scene.materials[0].baseColor = glm::vec4(glm::vec3(kAlbedo), 1);
    Primitive walls;
    addRoom(walls, {0, 0, 0}, {4, 3, 5});
    addObject(scene, walls, "walls");
    Primitive box;
    addBox(box, {1.3f, 0, 1.2f}, {2.1f, 1.4f, 2.3f});
    addObject(scene, box, "box");
    Lighting lighting;
    lighting.lights.resize(1);
    lighting.lights[0].type = LightType::point;
    lighting.lights[0].position = {2.9f, 2.6f, 3.8f};
    lighting.lights[0].intensity = {3, 2, 1};
    const auto primitives = open(sdf);
    const auto triangles = makeTracer(scene, poseAt(scene));
    Field field = makeField(setup()), reference = makeField(setup());
    for (int i = 0; i < 12; ++i) {
        ASSERT_TRUE(field.update(*primitives, lighting));
        ASSERT_TRUE(reference.update(*triangles, lighting));
    }
    std::vector<FieldQuery> queries;
    for (int i = 0; i < 200; ++i) {
        const glm::vec3 at(0.3f + 3.4f * float(i % 7) / 6, 0.3f + 2.4f * float(i % 5) / 4,
                           0.3f + 4.4f * float(i) / 199);
        queries.push_back({at, glm::normalize(glm::vec3(2, 1.5f, 2.5f) - at), {}});
    }
    const auto ours = ask(field, queries), theirs = ask(reference, queries);
    double sum = 0, difference = 0;
    for (std::size_t i = 0; i < ours.size(); ++i) {
        sum += theirs[i].x;
        difference += std::abs(ours[i].x - theirs[i].x);
    }
    EXPECT_GT(sum / 200, 0.05);
    EXPECT_LT(difference / sum, 0.005);
}

// A shutter that rides on a node opens a dark room to the sky.
TEST_P(SdfField, lightFollowsWhatMoves) {
    SdfScene sdf = room();
    sdf.primitives[3].node = "roof";
    Scene scene;
    scene.materials.resize(1);
    Primitive speck;
    addBox(speck, glm::vec3(0), glm::vec3(0.1f));
    addObject(scene, speck, "roof");
    Lighting lighting;
    lighting.sky.radiance = glm::vec3(1);
    const auto tracer = open(sdf, scene);
    Field field = makeField(setup());
    const auto light = [&] {
        for (int i = 0; i < 6; ++i) EXPECT_TRUE(field.update(*tracer, lighting));
        return field.irradiance({{2, 0.5f, 2.5f}, {0, 1, 0}, {}}).x;
    };
    EXPECT_EQ(light(), 0);
    scene.nodes[0].translation = {50, 0, 0};
    ASSERT_TRUE(tracer->setPose(poseAt(scene)));
    field.control().notify(FieldEvent::largeObjectChange);
    EXPECT_GT(light(), 0.1f);
}

// Their rays meet only the sky: E = pi L.
TEST_P(SdfField, withoutPrimitivesThereIsSky) {
    Lighting lighting;
    lighting.sky.radiance = glm::vec3(3);
    const auto tracer = open({});
    Field field = makeField(setup());
    for (int i = 0; i < 3; ++i) ASSERT_TRUE(field.update(*tracer, lighting));
    EXPECT_NEAR(field.irradiance({{2, 1, 2}, {0, 1, 0}, {}}).x / (3.14159265f * 3), 1, 0.01f);
}

TEST_P(SdfField, refusesWhatIsInvalid) {
    SdfScene sdf = room();
    sdf.primitives[1].halfSize.x = -1;
    const Scene scene;
    const auto opened = made(GetParam().open(context))->openSdf(sdf, scene, poseAt(scene));
    ASSERT_FALSE(opened);
    EXPECT_THAT(opened.error().message, testing::HasSubstr("primitive 1"));
}

}  // namespace
}  // namespace probegi::test

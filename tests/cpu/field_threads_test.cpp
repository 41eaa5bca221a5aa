// Whole fields bit for bit on 1, 2, 3 and all threads: every texel of every probe, and queries.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <glm/gtc/quaternion.hpp>
#include <set>
#include <thread>

#include "kernels/probe/octahedral_texel.h"
#include "probegi/probegi.h"
#include "support/field_setup.h"
#include "support/probes.h"

namespace probegi::test {
namespace {

constexpr int kDoor = 2;

/// Two rooms with a door between them; one has a double-sided lamp, the other a window to the sky.
Scene roomsWithDoor() {
    Scene scene;
    scene.materials.resize(3);
    scene.materials[1].emission = {9, 7, 5};
    scene.materials[1].doubleSided = true;
    scene.materials[2].baseColor = {0.8f, 0.2f, 0.1f, 1};
    scene.sky.radiance = {0.6f, 0.8f, 1.2f};
    Primitive walls, lamp, door;
    addBox(walls, {-4, -0.2f, -3}, {4, 0, 3});
    addBox(walls, {-4, 3, -3}, {4, 3.2f, 3});
    addBox(walls, {-4.2f, 0, -3}, {-4, 3, 3});
    addBox(walls, {-4, 0, -3.2f}, {4, 3, -3});
    addBox(walls, {-4, 0, 3}, {4, 3, 3.2f});
    addBox(walls, {-0.1f, 0, -3}, {0.1f, 3, 0.5f});
    addBox(walls, {-0.1f, 0, 1.5f}, {0.1f, 3, 3});
    addBox(lamp, {-2.2f, 2.7f, -0.2f}, {-1.8f, 2.8f, 0.2f});
    lamp.material = 1;
    addBox(door, {-0.05f, 0, 0.5f}, {0.05f, 3, 1.5f});
    door.material = 2;
    addObject(scene, walls, "walls");
    addObject(scene, lamp, "lamp");
    addObject(scene, door, "door");
    return scene;
}

/// All bits of a field that can be read.
std::vector<std::uint32_t> bitsOf(const Field& field) {
    std::vector<std::uint32_t> bits;
    const auto add = [&](float value) { bits.push_back(std::bit_cast<std::uint32_t>(value)); };
    const auto eachDirection = [](int size, const auto& visit) {
        for (int texel = 0; texel < size * size; ++texel)
            visit(kernels::octTexelDirection(texel % size, texel / size, size));
    };
    std::vector<FieldQuery> queries;
    const FieldDesc& desc = field.desc();
    for (int probe = 0; probe < probeCount(desc); ++probe) {
        add(probeBackfaceShare(field, probe));
        eachDirection(desc.irradianceTexels, [&](glm::vec3 n) {
            const glm::vec3 e = probeIrradiance(field, probe, n);
            for (int c = 0; c < 3; ++c) add(e[c]);
        });
        eachDirection(desc.visibilityTexels, [&](glm::vec3 n) {
            const glm::vec2 moments = probeDistanceMoments(field, probe, n);
            add(moments.x);
            add(moments.y);
        });
        queries.push_back({probePosition(desc.volumes[0], probe) + glm::vec3(0.13f, 0.21f, -0.17f), {0, 1, 0}});
    }
    std::vector<glm::vec3> answers(queries.size());
    field.irradiance(queries, answers).value();
    for (const glm::vec3& e : answers)
        for (int c = 0; c < 3; ++c) add(e[c]);
    bits.push_back(std::uint32_t(field.fallbackQueries()));
    return bits;
}

/// The field's contents after updates, after more of them with the door opened, and after convergence.
std::vector<std::vector<std::uint32_t>> partsOn(int threads, FieldRules rules) {
    const Context context = Context::create({.threads = threads}).value();
    Scene scene = roomsWithDoor();
    const ScenePose pose = poseAt(scene);
    const int moving[] = {kDoor};
    const auto tracer = makeMovableEmbreeTracer(context, scene, pose, {.nodes = moving}).value();
    const Lighting lighting{pose.lights, scene.sky};
    FieldSetup desc;
    desc.volumes = {placeVolume(pose.bounds, {.counts = {7, 4, 5}}).value()};
    desc.raysPerProbe = 40;
    desc.irradianceTexels = 6;
    desc.visibilityTexels = 8;
    desc.rules = rules;
    Field field = Field::create(context, desc, desc).value();
    std::vector<std::vector<std::uint32_t>> parts;
    const auto update = [&](int updates) {
        for (int i = 0; i < updates; ++i) field.update(*tracer, lighting).value();
        parts.push_back(bitsOf(field));
    };
    update(1);
    update(4);
    scene.nodes[kDoor].rotation = glm::angleAxis(1.2f, glm::vec3(0, 1, 0));
    tracer->setPose(poseAt(scene)).value();
    field.control().notify(FieldEvent::largeObjectChange);
    update(4);
    EXPECT_EQ(field.converge(*tracer, lighting, 1e-6f, 12).value().updates, 12);
    parts.push_back(bitsOf(field));
    return parts;
}

class FieldThreads : public testing::TestWithParam<FieldRules> {};
INSTANTIATE_TEST_SUITE_P(Rules, FieldThreads, testing::Values(FieldRules::measured, FieldRules::paper),
                         [](const auto& rules) { return rules.param == FieldRules::paper ? "paper" : "measured"; });

TEST_P(FieldThreads, updatesAMoveAndConvergenceAreTheSameBits) {
    const auto one = partsOn(1, GetParam());
    ASSERT_EQ(one.size(), 4u);
    for (std::size_t part = 1; part < one.size(); ++part) EXPECT_NE(one[part], one[part - 1]) << "something happens";
    for (const int threads : std::set<int>{2, 3, std::max(4, int(std::thread::hardware_concurrency()))}) {
        const auto many = partsOn(threads, GetParam());
        for (std::size_t part = 0; part < one.size(); ++part)
            EXPECT_TRUE(many[part] == one[part]) << threads << " threads, part " << part;
    }
}

}  // namespace
}  // namespace probegi::test

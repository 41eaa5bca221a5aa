// Guards that need more than the probes, in an engine's own command buffers and shaders.
#include "probegi/masks.h"
#include "probegi/sdf.h"
#include "vulkan/recorded_world.h"

namespace probegi::test {

using vulkan::GpuField;

// Masks that change from pass to pass, asked by the library and by a shader of the engine.
TEST_F(VulkanRecorded, masksAreLookedUp) {
    const vulkan::Device device = adopt();
    const auto tracer = makeEmbreeTracer(log, world.scene, world.pose).value();
    const auto baked = [&](int clusters, int factor) {
        FieldSetup masked = world.desc;
        masked.guard = LeakGuard::masks;
        masked.masks = bakeMasks(log, *tracer, masked, {.clusters = clusters, .factor = factor}).value();
        return masked;
    };
    // Two texels to a word and one, fewer words and more.
    const FieldSetup few = baked(4, 2), more = baked(8, 5), again = baked(3, 3);
    GpuField volume = *GpuField::create(device, few, few);
    const EngineBuffer of[] = {answers(), answers(), answers(), answers()}, byShader = answers(),
                       withoutMasks = answers();
    QueryShader shader(engine, PROBEGI_QUERY_MASKS_SPIRV, questions, byShader),
        blind(engine, PROBEGI_QUERY_SPIRV, questions, withoutMasks);
    for (const QueryShader* each : {&shader, &blind})
        volume.writeQueryBindings(each->volumeSet(), QueryShader::kFirstBinding);
    engine.run([&](VkCommandBuffer commands) {
        volume.recordClear(commands).value();
        volume.recordUpdate(commands, rayBuffer.range()).value();
        volume.recordQuery(commands, questions.address, of[0].address, count()).value();
        volume.control().setSettings(more).value();
        volume.recordQuery(commands, questions.address, of[1].address, count()).value();
        volume.control().setSettings(again).value();
        volume.recordQuery(commands, questions.address, of[2].address, count()).value();
        shader.record(commands, count());
        blind.record(commands, count());
        volume.control().setSettings(few).value();
        volume.recordSettings(commands).value();
        volume.recordQuery(commands, questions.address, of[3].address, count()).value();
    });
    // At a wall, rounding decides the side of a point.
    EXPECT_LE(differing(of[0], few), 2);
    EXPECT_LE(differing(of[1], more), 2);
    EXPECT_LE(differing(of[2], again), 2);
    EXPECT_LE(differing(of[3], few), 2);
    EXPECT_LE(differing(byShader, again), 2);
    EXPECT_GT(differing(of[1], few), 2) << "masks decide";
    EXPECT_GT(differing(withoutMasks, again), 2) << "this shader does not read them";
    FieldSetup byMoments = world.desc;
    byMoments.guard = LeakGuard::moments;
    EXPECT_LE(differing(withoutMasks, byMoments), 2);
    for (const glm::vec3& e : valuesOf(withoutMasks)) ASSERT_TRUE(finite(e));
    FieldSetup other = few;
    other.volumes[0].spacing.x *= 2;
    EXPECT_EQ(GpuField::create(device, other, few).error().code, ErrorCode::invalidArgument) << "baked for others";
    engine.run([&](VkCommandBuffer commands) {
        EXPECT_EQ(volume.recordScroll(commands, 0, {1, 0, 0}).error().code, ErrorCode::invalidArgument);
    });
}

// A wall that moves between passes, asked by the library and by shaders of the engine, of which one does not read it.
TEST_F(VulkanRecorded, primitivesShadow) {
    const vulkan::Device device = adopt();
    const auto walled = [&](float x) {
        SdfScene sdf;
        SdfPrimitive wall;
        wall.centre = world.pose.bounds.lower + glm::vec3(x, 0.5f, 0.5f) * world.pose.bounds.size();
        wall.halfSize = {0.01f, 9, 9};
        sdf.primitives = {wall};
        FieldSetup setup = world.desc;
        setup.guard = LeakGuard::sdfShadow;
        setup.blockers = placeSdf(sdf, world.scene, world.pose).value();
        return setup;
    };
    const FieldSetup left = walled(0.4f), right = walled(0.7f);
    FieldSetup byMoments = world.desc;
    byMoments.guard = LeakGuard::moments;
    GpuField volume = *GpuField::create(device, left, left);
    const EngineBuffer first = answers(), second = answers(), byShader = answers(), withoutIt = answers();
    QueryShader shader(engine, PROBEGI_QUERY_MASKS_SPIRV, questions, byShader),
        blind(engine, PROBEGI_QUERY_SPIRV, questions, withoutIt);
    for (const QueryShader* each : {&shader, &blind})
        volume.writeQueryBindings(each->volumeSet(), QueryShader::kFirstBinding);
    engine.run([&](VkCommandBuffer commands) {
        volume.recordClear(commands).value();
        volume.recordUpdate(commands, rayBuffer.range()).value();
        volume.recordQuery(commands, questions.address, first.address, count()).value();
        volume.control().setSettings(right).value();
        volume.recordQuery(commands, questions.address, second.address, count()).value();
        shader.record(commands, count());
        blind.record(commands, count());
    });
    EXPECT_LE(differing(first, left), 2);
    EXPECT_LE(differing(second, right), 2);
    EXPECT_LE(differing(byShader, right), 2);
    EXPECT_GT(differing(second, left), 20) << "the wall is where it was put last";
    EXPECT_LE(differing(withoutIt, byMoments), 2);
    EXPECT_GT(differing(withoutIt, right), 20);
}

}  // namespace probegi::test

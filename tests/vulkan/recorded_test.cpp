// Passes in an engine's own command buffers, under synchronisation validation.
#include "vulkan/recorded_world.h"

namespace probegi::test {

using vulkan::GpuField;

TEST_F(VulkanRecorded, updatesAndQueriesInOneCommandBuffer) {
    const vulkan::Device device = adopt();
    GpuField volume = *GpuField::create(device, world.desc, world.desc),
             other = *GpuField::create(device, world.desc, world.desc);
    const EngineBuffer first = answers(), second = answers(), unguarded = answers(), again = answers(),
                       others = answers();
    engine.run([&](VkCommandBuffer commands) {
        volume.recordClear(commands).value();
        other.recordClear(commands).value();
        EXPECT_TRUE(volume.recordUpdate(commands, rayBuffer.range()));
        EXPECT_TRUE(volume.recordQuery(commands, questions.address, first.address, count()));
        for (int i = 0; i < 2; ++i) {
            EXPECT_TRUE(volume.recordUpdate(commands, rayBuffer.range()));
            EXPECT_TRUE(other.recordUpdate(commands, rayBuffer.range()));
        }
        EXPECT_TRUE(volume.recordQuery(commands, questions.address, second.address, count()));
        changeSettings(volume, [&](FieldSettings& s) { s.guard = LeakGuard::none; });
        EXPECT_TRUE(volume.recordQuery(commands, questions.address, unguarded.address, count()));
        changeSettings(volume, [&](FieldSettings& s) { s.guard = LeakGuard::moments; });
        EXPECT_TRUE(volume.recordQuery(commands, questions.address, again.address, count()));
        EXPECT_TRUE(other.recordQuery(commands, questions.address, others.address, count()));
        EXPECT_TRUE(other.recordQuery(commands, questions.address, others.address, 0));
    });
    EXPECT_EQ(volume.control().frame(), 3);
    expectEqual(first, onCpu(1, LeakGuard::moments), 2e-3f);
    expectEqual(second, onCpu(3, LeakGuard::moments), 2e-3f);
    expectEqual(unguarded, onCpu(3, LeakGuard::none), 2e-3f);
    expectEqual(others, onCpu(2, LeakGuard::moments), 2e-3f);
    expectEqual(again, valuesOf(second), 0.0f);
    EXPECT_NE(valuesOf(unguarded), valuesOf(second));
}

// As an engine does whose volume follows the camera: scroll, update, ask, all in one command buffer.
TEST_F(VulkanRecorded, aVolumeScrollsBetweenUpdates) {
    const vulkan::Device device = adopt();
    GpuField volume = *GpuField::create(device, world.desc, world.desc);
    Field onCpu = *Field::create(log, world.desc, world.desc);
    const EngineBuffer before = answers(), after = answers();
    const glm::ivec3 cells(1, 0, -1);
    engine.run([&](VkCommandBuffer commands) {
        volume.recordClear(commands).value();
        volume.recordUpdate(commands, rayBuffer.range()).value();
        volume.recordScroll(commands, 0, cells).value();
        volume.recordQuery(commands, questions.address, before.address, count()).value();
        volume.recordUpdate(commands, rayBuffer.range()).value();
        volume.recordQuery(commands, questions.address, after.address, count()).value();
        EXPECT_EQ(volume.recordScroll(commands, 1, cells).error().code, ErrorCode::invalidArgument);
    });
    std::vector<glm::vec3> wanted(queries.size());
    onCpu.update(rays).value();
    onCpu.scroll(0, cells).value();
    onCpu.irradiance(queries, wanted).value();
    expectEqual(before, wanted, 2e-3f);
    onCpu.update(rays).value();
    onCpu.irradiance(queries, wanted).value();
    expectEqual(after, wanted, 2e-3f);
    EXPECT_EQ(volume.control().place(0), onCpu.control().place(0));
    EXPECT_NE(volume.control().place(0), world.desc.volumes[0]);
}

// Cascades that follow a camera, asked by a shader of the engine: irradiance and coverage.
TEST_F(VulkanRecorded, cascadesFollowACamera) {
    const vulkan::Device device = adopt();
    FieldSetup setup = world.desc;
    const glm::vec3 middle = world.pose.bounds.centre(), spacing = 0.08f * world.pose.bounds.size();
    setup.volumes = makeCascades({.centre = middle, .spacing = spacing, .counts = glm::ivec3(5), .levels = 2}).value();
    GpuField volumes = *GpuField::create(device, setup, setup);
    Field onCpu = *Field::create(log, setup, setup);
    rays.clear();
    for (const ProbeTask& task : onCpu.control().tasks())
        rays.insert(rays.end(), std::size_t(setup.raysPerProbe), {glm::vec3(1.0f + float(task.volume)), 50.0f});
    rayBuffer = engine.makeBuffer(std::span<const RayDatum>(rays));
    std::vector<FieldQuery> more = queries;
    for (const FieldQuery& q : queries) more.push_back({q.position, glm::vec3(0.0f), glm::vec3(0.0f)});
    questions = engine.makeBuffer(std::span<const FieldQuery>(more));
    const EngineBuffer answered = engine.makeBuffer(more.size() * sizeof(glm::vec3));
    QueryShader shader(engine, PROBEGI_QUERY_SPIRV, questions, answered);
    volumes.writeQueryBindings(shader.volumeSet(), QueryShader::kFirstBinding);
    const glm::vec3 camera = middle + 1.3f * spacing;
    engine.run([&](VkCommandBuffer commands) {
        volumes.recordClear(commands).value();
        volumes.recordFollowCamera(commands, camera).value();
        volumes.recordUpdate(commands, rayBuffer.range()).value();
        shader.record(commands, std::uint32_t(more.size()));
        const float bad = std::numeric_limits<float>::infinity();
        EXPECT_EQ(volumes.recordFollowCamera(commands, {bad, 0, 0}).error().code, ErrorCode::invalidArgument);
    });
    onCpu.followCamera(camera).value();
    onCpu.update(rays).value();
    EXPECT_EQ(volumes.control().place(0), onCpu.control().place(0));
    EXPECT_NE(volumes.control().place(0), setup.volumes[0]);
    std::vector<glm::vec3> wanted(queries.size());
    onCpu.irradiance(queries, wanted).value();
    int covered = 0;
    for (std::size_t i = 0; i < queries.size(); ++i) {
        const glm::vec3 e = answered.as<glm::vec3>()[i], c = answered.as<glm::vec3>()[queries.size() + i];
        EXPECT_NEAR(e.x, wanted[i].x, 2e-3f * wanted[i].x) << i;
        EXPECT_NEAR(c.x, onCpu.control().coverage(queries[i].position), 1e-4f) << i;
        covered += c.x > 0 ? 1 : 0;
    }
    EXPECT_GT(covered, 20);
    EXPECT_LT(covered, 200);
}

TEST_F(VulkanRecorded, updatesAndQueriesInSubmitsOfTheirOwn) {
    const vulkan::Device device = adopt();
    GpuField volume = *GpuField::create(device, world.desc, world.desc);
    const EngineBuffer result = answers();
    engine.submit([&](VkCommandBuffer commands) { volume.recordClear(commands).value(); });
    for (int i = 0; i < 3; ++i)
        engine.submit([&](VkCommandBuffer commands) { EXPECT_TRUE(volume.recordUpdate(commands, rayBuffer.range())); });
    engine.submit([&](VkCommandBuffer commands) {
        EXPECT_TRUE(volume.recordQuery(commands, questions.address, result.address, count()));
    });
    engine.wait();
    expectEqual(result, onCpu(3, LeakGuard::moments), 2e-3f);
}

TEST_F(VulkanRecorded, changedLightsEqualNewOnes) {
    const vulkan::Device device = adopt();
    vulkan::GpuScene scene = *vulkan::GpuScene::create(log, device, world.scene, world.pose);
    PlacedLight lamp;
    lamp.position = world.pose.bounds.centre();
    lamp.intensity = glm::vec3(3.0f);
    Lighting dark{{}, {}}, bright{{lamp, lamp}, {}};
    dark.sky.radiance = bright.sky.radiance = glm::vec3(0.1f);
    bright.sky.radiance = glm::vec3(0.4f);
    vulkan::GpuLighting changed = *vulkan::GpuLighting::create(device, dark, 2),
                        made = *vulkan::GpuLighting::create(device, bright);
    std::vector<GpuField> volumes;
    for (int i = 0; i < 3; ++i) volumes.push_back(*GpuField::create(device, world.desc, world.desc));
    const EngineBuffer before = answers(), after = answers(), wanted = answers();
    engine.run([&](VkCommandBuffer commands) {
        scene.recordUpload(commands).value();
        changed.recordUpload(commands).value();
        made.recordUpload(commands).value();
        for (GpuField& volume : volumes) volume.recordClear(commands).value();
        EXPECT_TRUE(volumes[0].recordUpdate(commands, scene, changed));
        EXPECT_TRUE(changed.recordUpdate(commands, bright));
        EXPECT_TRUE(volumes[1].recordUpdate(commands, scene, changed));
        EXPECT_TRUE(volumes[2].recordUpdate(commands, scene, made));
        EXPECT_TRUE(volumes[0].recordQuery(commands, questions.address, before.address, count()));
        EXPECT_TRUE(volumes[1].recordQuery(commands, questions.address, after.address, count()));
        EXPECT_TRUE(volumes[2].recordQuery(commands, questions.address, wanted.address, count()));
        const auto tooMany = changed.recordUpdate(commands, {{lamp, lamp, lamp}, {}});
        ASSERT_FALSE(tooMany);
        EXPECT_EQ(tooMany.error().code, ErrorCode::invalidArgument);
        EXPECT_NE(tooMany.error().message.find("maxLights"), std::string::npos);
    });
    scene.releaseStaging();
    changed.releaseStaging();
    expectEqual(after, valuesOf(wanted), 1e-6f);
    EXPECT_NE(valuesOf(before), valuesOf(after));
}

// The Cornell box's lamp moves and grows: probes must sample it where it is.
TEST_F(VulkanRecorded, movingLampsAreSampledWhereTheyAre) {
    const vulkan::Device device = adopt();
    Scene moving = world.scene;
    int lamp = 0;
    while (moving.nodes[std::size_t(lamp)].name != "lamp") ++lamp;
    moving.animations = {
        {lamp, AnimationPath::translation, Interpolation::linear, {0, 1}, {{0, 0, 0, 0}, {-1.2f, -1, 0.9f, 0}}},
        {lamp, AnimationPath::scale, Interpolation::linear, {0, 1}, {{1, 1, 1, 0}, {1.2f, 1, 1.2f, 0}}}};
    vulkan::GpuLighting none = *vulkan::GpuLighting::create(device, {});
    for (const bool movable : {true, false}) {
        vulkan::GpuScene scene = *vulkan::GpuScene::create(log, device, moving, poseAt(moving), {.movable = movable});
        GpuField volume = *GpuField::create(device, world.desc, world.desc);
        const EngineBuffer result = answers();
        engine.run([&](VkCommandBuffer commands) {
            scene.recordUpload(commands).value();
            none.recordUpload(commands).value();
            volume.recordClear(commands).value();
            EXPECT_TRUE(scene.recordPose(commands, poseAt(moving, 1.0f)));
            EXPECT_TRUE(volume.recordUpdate(commands, scene, none));
            EXPECT_TRUE(volume.recordQuery(commands, questions.address, result.address, count()));
        });
        // Merged meshes stay where they were, for emitter samples as for rays.
        const auto tracer = *makeEmbreeTracer(log, moving, poseAt(moving, movable ? 1.0f : 0.0f));
        Field field = *Field::create(log, world.desc, world.desc);
        EXPECT_TRUE(field.update(*tracer, Lighting{}));
        std::vector<glm::vec3> wanted(queries.size());
        EXPECT_TRUE(field.irradiance(queries, wanted));
        expectEqual(result, wanted, 4e-3f);
    }
}

TEST_F(VulkanRecorded, theIncludeGivesTheSameAsThePass) {
    const vulkan::Device device = adopt();
    GpuField volume = *GpuField::create(device, world.desc, world.desc);
    const EngineBuffer byPass = answers(), byInclude = answers();
    QueryShader shader(engine, PROBEGI_QUERY_SPIRV, questions, byInclude);
    volume.writeQueryBindings(shader.volumeSet(), QueryShader::kFirstBinding);
    engine.run([&](VkCommandBuffer commands) {
        volume.recordClear(commands).value();
        EXPECT_TRUE(volume.recordUpdate(commands, rayBuffer.range()));
        shader.record(commands, count());
        EXPECT_TRUE(volume.recordUpdate(commands, rayBuffer.range()));
        EXPECT_TRUE(volume.recordUpdate(commands, rayBuffer.range()));
        shader.record(commands, count());
        EXPECT_TRUE(volume.recordQuery(commands, questions.address, byPass.address, count()));
    });
    expectEqual(byInclude, valuesOf(byPass), 1e-5f);
}

#ifdef PROBEGI_QUERY_HLSL_SPIRV
TEST_F(VulkanRecorded, theIncludeInHlslGivesTheSame) {
    const vulkan::Device device = adopt();
    GpuField volume = *GpuField::create(device, world.desc, world.desc);
    const std::size_t asked = queries.size();
    queries.push_back({world.pose.bounds.centre(), glm::vec3(0), glm::vec3(0)});
    queries.push_back({world.pose.bounds.lower - 9.0f, glm::vec3(0), glm::vec3(0)});
    for (int ray = 0; ray < world.desc.raysPerProbe; ++ray)
        queries.push_back({glm::vec3(0), glm::vec3(0), glm::vec3(2 + ray, 0, 0)});
    for (int ray = 0; ray < world.desc.fixedRays; ++ray)
        queries.push_back({glm::vec3(0), glm::vec3(0), glm::vec3(0, 2 + ray, 0)});
    questions = engine.makeBuffer(std::span<const FieldQuery>(queries));
    const EngineBuffer byGlsl = answers(), byHlsl = answers();
    QueryShader glsl(engine, PROBEGI_QUERY_SPIRV, questions, byGlsl);
    volume.writeQueryBindings(glsl.volumeSet(), QueryShader::kFirstBinding);
    constexpr auto kInBuffer = vulkan::QueryConstants::storageBuffer;
    QueryShader hlsl(engine, PROBEGI_QUERY_HLSL_SPIRV, questions, byHlsl, kInBuffer);
    volume.writeQueryBindings(hlsl.volumeSet(), QueryShader::kFirstBinding, kInBuffer);
    engine.run([&](VkCommandBuffer commands) {
        volume.recordClear(commands).value();
        volume.recordUpdate(commands, rayBuffer.range()).value();
        glsl.record(commands, count());
        hlsl.record(commands, count());
    });
    expectEqual(byHlsl, valuesOf(byGlsl), 1e-5f);
    EXPECT_EQ(byHlsl.as<glm::vec3>()[asked].x, 1.0f);
    EXPECT_EQ(byHlsl.as<glm::vec3>()[asked + 1].x, 0.0f);
}
#endif

// After each update shaders have the directions of the next one.
TEST_F(VulkanRecorded, theIncludeKnowsTheComingRays) {
    for (const FieldRules rules : {FieldRules::measured, FieldRules::paper}) {
        const vulkan::Device device = adopt();
        FieldDesc desc = world.desc;
        desc.rules = rules;
        GpuField volume = *GpuField::create(device, desc);
        queries.clear();
        for (int ray = 0; ray < desc.raysPerProbe; ++ray)
            queries.push_back({glm::vec3(0), glm::vec3(0), glm::vec3(2 + ray, 0, 0)});
        const std::size_t fixed = volume.control().fixedRayDirections().size();
        for (std::size_t ray = 0; ray < fixed; ++ray)
            queries.push_back({glm::vec3(0), glm::vec3(0), glm::vec3(0, 2 + ray, 0)});
        questions = engine.makeBuffer(std::span<const FieldQuery>(queries));
        const EngineBuffer answered = answers();
        QueryShader shader(engine, PROBEGI_QUERY_SPIRV, questions, answered);
        volume.writeQueryBindings(shader.volumeSet(), QueryShader::kFirstBinding);
        for (int frame = 0; frame < 4; ++frame) {
            engine.run([&](VkCommandBuffer commands) {
                if (frame == 0) volume.recordClear(commands).value();
                if (frame > 0) volume.recordUpdate(commands, rayBuffer.range()).value();
                if (frame == 2) changeSettings(volume, [](FieldSettings& s) { s.guard = LeakGuard::none; });
                volume.recordSettings(commands).value();
                shader.record(commands, count());
            });
            std::vector<glm::vec3> wanted(volume.control().rayDirections().begin(),
                                          volume.control().rayDirections().end());
            wanted.insert(wanted.end(), volume.control().fixedRayDirections().begin(),
                          volume.control().fixedRayDirections().end());
            ASSERT_EQ(volume.control().frame(), frame);
            expectEqual(answered, wanted, 1e-5f);
        }
    }
}

// Half the bytes a ray, for own rays with and without fixed ones.
TEST_F(VulkanRecorded, packedRaysAreThoseOfTheCpu) {
    const vulkan::Device device = adopt();
    rays[3] = {{-0.5f, -0.25f, -1.0f}, -0.4f};
    rays[20].distance = -0.3f;
    rays[40].distance = 1e30f;
    std::vector<PackedRayDatum> packed;
    for (const RayDatum& d : rays) packed.push_back(packRay(d));
    std::vector<FixedRayDatum> fixed(18 * std::size_t(world.desc.fixedRays), {0.5f, 0.1f, 1.0f});
    const EngineBuffer packedBuffer = engine.makeBuffer(std::span<const PackedRayDatum>(packed)),
                       fixedBuffer = engine.makeBuffer(std::span<const FixedRayDatum>(fixed));
    for (const bool withFixed : {false, true}) {
        GpuField volume = *GpuField::create(device, world.desc, world.desc);
        Field onCpu = *Field::create(log, world.desc, world.desc);
        const EngineBuffer result = answers();
        const vulkan::BufferRange fixedRange = withFixed ? fixedBuffer.range() : vulkan::BufferRange();
        engine.run([&](VkCommandBuffer commands) {
            volume.recordClear(commands).value();
            for (int i = 0; i < 3; ++i)
                volume.recordUpdate(commands, packedBuffer.range(), fixedRange, nullptr, vulkan::RayFormat::packed)
                    .value();
            volume.recordQuery(commands, questions.address, result.address, count()).value();
            const vulkan::BufferRange half{packedBuffer.address, packedBuffer.bytes - 1};
            EXPECT_EQ(volume.recordUpdate(commands, half, fixedRange, nullptr, vulkan::RayFormat::packed).error().code,
                      ErrorCode::invalidArgument);
        });
        for (int i = 0; i < 3; ++i)
            onCpu.update(packed, withFixed ? std::span<const FixedRayDatum>(fixed) : std::span<const FixedRayDatum>())
                .value();
        std::vector<glm::vec3> wanted(queries.size());
        onCpu.irradiance(queries, wanted).value();
        expectEqual(result, wanted, 2e-3f);
    }
}

// Without an update or a query by the library in between.
TEST_F(VulkanRecorded, theSettingsReachShadersOfTheEngine) {
    const vulkan::Device device = adopt();
    GpuField volume = *GpuField::create(device, world.desc, world.desc);
    const EngineBuffer answered = answers();
    QueryShader shader(engine, PROBEGI_QUERY_SPIRV, questions, answered);
    volume.writeQueryBindings(shader.volumeSet(), QueryShader::kFirstBinding);
    const auto askedWith = [&](LeakGuard guard, bool recorded) {
        engine.run([&](VkCommandBuffer commands) {
            changeSettings(volume, [&](FieldSettings& s) { s.guard = guard; });
            if (recorded) volume.recordSettings(commands).value();
            shader.record(commands, count());
        });
        return valuesOf(answered);
    };
    engine.run([&](VkCommandBuffer commands) {
        volume.recordClear(commands).value();
        EXPECT_TRUE(volume.recordUpdate(commands, rayBuffer.range()));
    });
    const auto guarded = askedWith(LeakGuard::moments, true);
    expectEqual(answered, onCpu(1, LeakGuard::moments), 2e-3f);
    const auto unguarded = askedWith(LeakGuard::none, true);
    expectEqual(answered, onCpu(1, LeakGuard::none), 2e-3f);
    EXPECT_NE(unguarded, guarded);
    EXPECT_EQ(askedWith(LeakGuard::moments, false), unguarded);  // until a pass uploads it
    EXPECT_EQ(askedWith(LeakGuard::moments, true), guarded);
    // Clearing the probes keeps the guard.
    engine.run([&](VkCommandBuffer commands) {
        changeSettings(volume, [&](FieldSettings& s) { s.guard = LeakGuard::none; });
        EXPECT_TRUE(volume.recordClear(commands));
        EXPECT_TRUE(volume.recordUpdate(commands, rayBuffer.range()));
        shader.record(commands, count());
    });
    EXPECT_EQ(valuesOf(answered), unguarded);
}

TEST_F(VulkanRecorded, rayDataThatIsTooShortIsRefused) {
    const vulkan::Device device = adopt();
    GpuField volume = *GpuField::create(device, world.desc, world.desc);
    const std::size_t fixed =
        std::size_t(probeCount(world.desc.volumes[0])) * volume.control().fixedRayDirections().size();
    const EngineBuffer fixedBuffer = engine.makeBuffer(fixed * sizeof(FixedRayDatum));
    const auto shorter = [](const EngineBuffer& buffer) {
        return vulkan::BufferRange{buffer.address, buffer.bytes - 1};
    };
    const auto expectRefused = [](const Result<void>& done, const char* named) {
        ASSERT_FALSE(done);
        EXPECT_EQ(done.error().code, ErrorCode::invalidArgument);
        EXPECT_NE(done.error().message.find(named), std::string::npos) << done.error().message;
    };
    engine.run([&](VkCommandBuffer commands) {
        EXPECT_TRUE(volume.recordClear(commands));
        expectRefused(volume.recordUpdate(commands, shorter(rayBuffer)), "rayData");
        expectRefused(volume.recordUpdate(commands, vulkan::BufferRange()), "rayData");
        expectRefused(volume.recordUpdate(commands, {rayBuffer.address + 2, rayBuffer.bytes}), "multiple of 4");
        expectRefused(volume.recordUpdate(commands, {0, rayBuffer.bytes}), "multiple of 4");
        expectRefused(volume.recordUpdate(commands, rayBuffer.range(), shorter(fixedBuffer)), "fixedRays");
        EXPECT_EQ(volume.control().frame(), 0);
        EXPECT_TRUE(volume.recordUpdate(commands, rayBuffer.range(), fixedBuffer.range()));
    });
    EXPECT_EQ(volume.control().frame(), 1);
}

TEST_F(VulkanRecorded, anUploadAfterItsStagingIsGoneIsRefused) {
    const vulkan::Device device = adopt();
    vulkan::GpuScene scene = *vulkan::GpuScene::create(log, device, world.scene, world.pose);
    vulkan::GpuLighting lighting = *vulkan::GpuLighting::create(device, world.lighting);
    engine.run([&](VkCommandBuffer commands) {
        EXPECT_TRUE(scene.recordUpload(commands));
        EXPECT_TRUE(lighting.recordUpload(commands));
    });
    scene.releaseStaging();
    lighting.releaseStaging();
    engine.run([&](VkCommandBuffer commands) {
        for (const Result<void>& done : {scene.recordUpload(commands), lighting.recordUpload(commands)}) {
            ASSERT_FALSE(done);
            EXPECT_EQ(done.error().code, ErrorCode::invalidArgument);
        }
    });
}

TEST_F(VulkanRecorded, passesAreTimed) {
    const vulkan::Device device = adopt();
    GpuField volume = *GpuField::create(device, world.desc, world.desc);
    vulkan::GpuScene scene = *vulkan::GpuScene::create(log, device, world.scene, world.pose);
    vulkan::GpuLighting lighting = *vulkan::GpuLighting::create(device, world.lighting);
    vulkan::Profiler all = *vulkan::Profiler::create(device), few = *vulkan::Profiler::create(device, 2);
    EXPECT_TRUE(all.read()->empty());
    const EngineBuffer result = answers();
    for (int frame = 0; frame < 2; ++frame)
        engine.run([&](VkCommandBuffer commands) {
            if (frame == 0) {
                scene.recordUpload(commands).value();
                lighting.recordUpload(commands).value();
                volume.recordClear(commands).value();
            }
            all.recordReset(commands);
            few.recordReset(commands);
            EXPECT_TRUE(volume.recordUpdate(commands, scene, lighting, &all));
            EXPECT_TRUE(volume.recordQuery(commands, questions.address, result.address, count(), &all));
            all.recordBegin(commands, "mine");
            all.recordEnd(commands);
            EXPECT_TRUE(volume.recordUpdate(commands, rayBuffer.range(), &few));
        });
    const auto times = all.read();
    ASSERT_TRUE(times);
    std::vector<std::string> names;
    for (const vulkan::PassTime& pass : *times) {
        names.push_back(pass.name);
        EXPECT_TRUE(std::isfinite(pass.milliseconds) && pass.milliseconds >= 0) << pass.name;
    }
    EXPECT_EQ(names, (std::vector<std::string>{"weights", "trace", "shade", "emitters", "windows", "blend irradiance",
                                               "blend visibility", "filter", "solid probes", "query", "mine"}));
    const auto first = few.read();
    ASSERT_TRUE(first);
    EXPECT_EQ(first->size(), 2u);
    EXPECT_FALSE(vulkan::Profiler::create(device, 0));
    EXPECT_FALSE(vulkan::Profiler::create(device, 1025));
}

}  // namespace probegi::test

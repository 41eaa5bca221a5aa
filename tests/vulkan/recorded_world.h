#pragma once

#include <cmath>
#include <random>

#include "support/field_setup.h"
#include "vulkan/engine.h"
#include "vulkan/hooks.h"
#include "vulkan/log_book.h"
#include "vulkan/query_shader.h"
#include "vulkan/small_world.h"

namespace probegi::test {

/// A small world, points in it to ask about, and ray data of one update, in buffers of an engine.
class VulkanRecorded : public testing::Test {
protected:
    void SetUp() override {
        hooks().reset();
        std::mt19937 random(5);
        std::uniform_real_distribution<float> unit(0.0f, 1.0f);
        const Bounds& bounds = world.pose.bounds;
        for (int i = 0; i < 200; ++i) {
            const glm::vec3 at = bounds.lower + bounds.size() * glm::vec3(unit(random), unit(random), unit(random));
            const glm::vec3 normal = glm::normalize(glm::vec3(unit(random), unit(random), unit(random)) - 0.5f);
            queries.push_back({at, normal, normal});
        }
        rays.resize(18 * 16);
        for (RayDatum& d : rays) d = {{unit(random), 2.0f * unit(random), 0.5f}, 0.2f + unit(random)};
        questions = engine.makeBuffer(std::span<const FieldQuery>(queries));
        rayBuffer = engine.makeBuffer(std::span<const RayDatum>(rays));
    }

    vulkan::Device adopt() { return *vulkan::Device::adopt(log, engine.adoptDesc()); }
    EngineBuffer answers() { return engine.makeBuffer(queries.size() * sizeof(glm::vec3)); }
    std::uint32_t count() const { return std::uint32_t(queries.size()); }

    // The CPU's result for the same rays.
    std::vector<glm::vec3> onCpu(int updates, LeakGuard guard) const {
        Field field = *Field::create(log, world.desc, world.desc);
        for (int i = 0; i < updates; ++i) EXPECT_TRUE(field.update(rays));
        changeSettings(field, [&](FieldSettings& s) { s.guard = guard; });
        std::vector<glm::vec3> e(queries.size());
        EXPECT_TRUE(field.irradiance(queries, e));
        return e;
    }
    static void expectEqual(const EngineBuffer& buffer, const std::vector<glm::vec3>& wanted, float relative) {
        const auto got = buffer.as<glm::vec3>();
        float brightest = 0;
        for (const glm::vec3& e : wanted) brightest = std::max({brightest, e.x, e.y, e.z});
        ASSERT_GT(brightest, 0.0f);
        for (std::size_t i = 0; i < wanted.size(); ++i)
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(got[i][c], wanted[i][c], relative * brightest) << i;
    }
    // Points at which the CPU finds something else after one update.
    int differing(const EngineBuffer& got, const FieldSetup& setup) const {
        Field field = *Field::create(log, setup, setup);
        field.update(rays).value();
        std::vector<glm::vec3> wanted(queries.size());
        field.irradiance(queries, wanted).value();
        const std::vector<glm::vec3> values = valuesOf(got);
        int differ = 0;
        for (std::size_t i = 0; i < wanted.size(); ++i)
            differ += std::abs(values[i].y - wanted[i].y) > 0.01f * wanted[i].y + 1e-4f ? 1 : 0;
        return differ;
    }
    static std::vector<glm::vec3> valuesOf(const EngineBuffer& buffer) {
        const auto values = buffer.as<glm::vec3>();
        return {values.begin(), values.end()};
    }

    const SmallWorld world;
    LogBook log;
    Engine engine;
    std::vector<FieldQuery> queries;
    std::vector<RayDatum> rays;
    EngineBuffer questions, rayBuffer;
};

}  // namespace probegi::test

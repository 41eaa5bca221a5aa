#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "kernels/random.h"
#include "probegi/field.h"

namespace probegi {
namespace {

const Context kContext = *Context::create({.threads = 2});

FieldDesc smallDesc() {
    FieldDesc d;
    d.grid = {{-1, -1, -1}, {0.5f, 1.0f, 0.7f}, {6, 4, 5}};
    d.raysPerProbe = 64;
    return d;
}

std::vector<RayDatum> constantData(const FieldDesc& d, glm::vec3 radiance, float distance) {
    return std::vector<RayDatum>(std::size_t(probeCount(d.grid)) * d.raysPerProbe, {radiance, distance});
}

std::vector<FieldQuery> randomQueries(int count) {
    std::uint32_t state = 4;
    const auto r = [&] { return 2 * kernels::nextRandom(state) - 1; };
    std::vector<FieldQuery> queries;
    for (int i = 0; i < count; ++i) {
        const glm::vec3 n = glm::normalize(glm::vec3(r(), r(), r()) + 1e-3f);
        queries.push_back({4.0f * glm::vec3(r(), r(), r()), n, glm::normalize(n + 0.9f * glm::vec3(r(), r(), r()))});
    }
    return queries;
}

// Quality.md: a constant field is returned exactly, inside, on faces and outside, whatever the guard.
TEST(Field, constantFieldIsConstantEverywhere) {
    for (const LeakGuard guard : {LeakGuard::none, LeakGuard::moments}) {
        FieldDesc desc = smallDesc();
        desc.guard = guard;
        Field field = *Field::create(kContext, desc);
        ASSERT_TRUE(field.update(constantData(desc, {1, 32, 0}, 0.4f)));  // fifth roots exact in half floats
        for (const FieldQuery& q : randomQueries(2000)) {
            const glm::vec3 e = field.irradiance(q);
            EXPECT_NEAR(e.x, 3.14159265f * 1, 1e-3f);
            EXPECT_NEAR(e.y, 3.14159265f * 32, 3e-2f);
            EXPECT_EQ(e.z, 0.0f);
        }
    }
}

TEST(Field, spanQueryEqualsSingleQueriesForAnyNumberOfThreads) {
    FieldDesc desc = smallDesc();
    std::vector<RayDatum> data = constantData(desc, {}, 1);
    std::uint32_t state = 8;
    for (RayDatum& d : data)
        d = {glm::vec3(kernels::nextRandom(state), kernels::nextRandom(state), 1), kernels::nextRandom(state)};
    const auto queries = randomQueries(3000);
    std::vector<glm::vec3> first;
    for (const int threads : {1, 2, 5}) {
        Field field = *Field::create(*Context::create({.threads = threads}), desc);
        ASSERT_TRUE(field.update(data));
        ASSERT_TRUE(field.update(data));
        std::vector<glm::vec3> out(queries.size());
        ASSERT_TRUE(field.irradiance(queries, out));
        for (std::size_t i = 0; i < queries.size(); i += 97) EXPECT_EQ(out[i], field.irradiance(queries[i]));
        if (first.empty()) first = out;
        EXPECT_EQ(out, first);
    }
}

TEST(Field, memoryIsWithinItsBudget) {
    FieldDesc desc;
    desc.grid.counts = {22, 14, 32};
    const Field field = *Field::create(kContext, desc);
    EXPECT_LE(double(field.memory().persistentBytes()) / probeCount(desc.grid), 1600.0);
    EXPECT_GE(double(field.memory().persistentBytes()) / probeCount(desc.grid), 64 * 6 + 256 * 4);
}

TEST(Field, mapSizesAreRuntimeParameters) {
    for (const int size : {4, 6, 32}) {
        FieldDesc desc = smallDesc();
        desc.irradianceTexels = size;
        desc.visibilityTexels = 2 * size;
        Field field = *Field::create(kContext, desc);
        ASSERT_TRUE(field.update(constantData(desc, glm::vec3(1), 0.5f)));
        EXPECT_NEAR(field.irradiance(randomQueries(1)[0]).y, 3.14159265f, 1e-3f);
        EXPECT_NEAR(field.probeDistanceMoments(3, {0, 0, 1}).x, 0.5f, 1e-3f);
        EXPECT_NEAR(field.probeDistanceMoments(3, {0, 0, 1}).y, 0.25f, 1e-3f);
    }
}

TEST(Field, wrongAmountOfRayDataIsRefused) {
    Field field = *Field::create(kContext, smallDesc());
    const std::vector<RayDatum> tooFew(17);
    const auto result = field.update(tooFew);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::invalidArgument);
    EXPECT_NE(result.error().message.find("17"), std::string::npos);
    EXPECT_EQ(field.frame(), 0);
}

TEST(Field, raysTurnEveryFrameAndRepeatWithTheSeed) {
    const FieldDesc desc = smallDesc();
    Field a = *Field::create(kContext, desc), b = *Field::create(kContext, desc);
    const std::vector<glm::vec3> first(a.rayDirections().begin(), a.rayDirections().end());
    ASSERT_TRUE(a.update(constantData(desc, glm::vec3(1), 1)));
    EXPECT_NE(first[0], a.rayDirections()[0]);
    EXPECT_EQ(first[0], b.rayDirections()[0]);
    for (const glm::vec3& d : a.rayDirections()) EXPECT_NEAR(glm::length(d), 1.0f, 1e-5f);
}

// One wall of probes that sees a near surface towards +X: what lies beyond is shadowed, what lies before is not.
TEST(Field, momentsGuardIgnoresProbesBehindAWall) {
    FieldDesc desc;
    desc.grid = {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}};
    desc.raysPerProbe = 512;
    const auto lightSide = [&](int probe) { return probePosition(desc.grid, probe).x > 0.5f; };
    const auto irradianceIn = [&](LeakGuard guard) {
        FieldDesc d = desc;
        d.guard = guard;
        Field field = *Field::create(kContext, d);
        for (int frame = 0; frame < 30; ++frame) {
            std::vector<RayDatum> data;
            for (int probe = 0; probe < probeCount(d.grid); ++probe)
                for (const glm::vec3& w : field.rayDirections()) {
                    // A thin wall at x = 0.5; bright for the probes beyond it, black for those before it.
                    const float x = 0.5f - probePosition(d.grid, probe).x;
                    const float t = x * w.x > 0 ? x / w.x : 1e30f;
                    data.push_back({glm::vec3(lightSide(probe) ? 1.0f : 0.0f), t});
                }
            EXPECT_TRUE(field.update(data));
        }
        // A point on the dark side, facing along the wall: half of what it faces lies beyond.
        return field.irradiance({{0.4f, 0.5f, 0.5f}, {0, 1, 0}, {-0.6f, 0.8f, 0}}).x;
    };
    EXPECT_GT(irradianceIn(LeakGuard::none), 0.05f * 3.14159f);
    EXPECT_LT(irradianceIn(LeakGuard::moments), 0.005f * 3.14159f);
}

// The wider search too: where the cage stands in a wall, the guard alone decides whether distances count.
TEST(Field, onlyTheMomentsGuardLooksAtDistances) {
    const auto irradianceIn = [](LeakGuard guard, float distanceOfBrightProbes) {
        FieldDesc desc;
        desc.grid = {{0, 0, 0}, {1, 1, 1}, {6, 4, 4}};
        desc.guard = guard;
        Field field = *Field::create(kContext, desc);
        std::vector<RayDatum> data;
        for (int probe = 0; probe < probeCount(desc.grid); ++probe) {
            const int x = probe % 6;
            const bool wall = x == 2 || x == 3;
            const RayDatum bright{glm::vec3(1.0f), distanceOfBrightProbes}, dark{glm::vec3(0.0f), 5.0f};
            data.insert(data.end(), std::size_t(desc.raysPerProbe),
                        wall    ? RayDatum{glm::vec3(0.0f), -0.1f}
                        : x < 2 ? bright
                                : dark);
        }
        EXPECT_TRUE(field.update(data));
        const float e = field.irradiance({{2.5f, 1.5f, 1.5f}, {0, 1, 0}, {0, 1, 0}}).x;
        EXPECT_EQ(field.fallbackQueries(), 1u);
        return e;
    };
    EXPECT_GT(irradianceIn(LeakGuard::none, 5.0f), 0.5f);
    EXPECT_EQ(irradianceIn(LeakGuard::none, 5.0f), irradianceIn(LeakGuard::none, 0.05f));
    EXPECT_GT(irradianceIn(LeakGuard::moments, 5.0f), 2.0f * irradianceIn(LeakGuard::moments, 0.05f));
}

}  // namespace
}  // namespace probegi

// Field::converge and Field::update as documented, in a closed furnace, whose light is a closed form.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <thread>

#include "probegi/field.h"
#include "support/analytic_tracer.h"
#include "support/field_setup.h"

namespace probegi::test {
namespace {

/// The inside of a sphere that emits 1 and reflects a half: the radiance is 1 / (1 - 1/2) = 2 everywhere.
struct Furnace : AnalyticTracer {
    Furnace() {
        Material m;
        m.emission = glm::vec3(1.0f);
        m.baseColor = {0.5f, 0.5f, 0.5f, 1};
        materials.push_back(m);
        addSphere(glm::vec3(0.0f), 2, true, 0);
    }
};

FieldSetup smallDesc() {
    FieldSetup desc;
    desc.volumes = {{glm::vec3(-0.5f), glm::vec3(1.0f), {2, 2, 2}}};
    desc.raysPerProbe = 64;
    return desc;
}

TEST(FieldConverge, arrivesAtTheFurnacesLight) {
    const Furnace furnace;
    Field field = *Field::create(*Context::create({.threads = 2}), smallDesc(), smallDesc());
    int told = 0;
    double total = 0;
    const auto done = field.converge(furnace, {}, 0.01f, 64, [&](const UpdateTimes& t) { ++told, total += t.total; });
    ASSERT_TRUE(done);
    EXPECT_TRUE(done->converged);
    EXPECT_LT(done->remaining, 0.01f);
    EXPECT_LE(done->updates, 32);
    EXPECT_EQ(told, done->updates);
    EXPECT_EQ(field.control().frame(), done->updates + 1) << "a last one only looks, for the updates to come";
    EXPECT_GT(total, 0);
    const glm::vec3 e = field.irradiance({glm::vec3(0.1f), {0, 1, 0}});
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(e[c] / 3.14159265f, 2, 0.02);
}

TEST(FieldConverge, reportsReachingTheCap) {
    Field field = *Field::create(*Context::create({.threads = 1}), smallDesc(), smallDesc());
    const auto done = field.converge(Furnace(), {}, 0.01f, 1);
    ASSERT_TRUE(done);
    EXPECT_EQ(done->updates, 1);
    EXPECT_FALSE(done->converged);
    EXPECT_NEAR(field.irradiance({glm::vec3(0.0f), {0, 0, 1}}).y / 3.14159265f, 1, 0.01) << "no bounce yet";
}

TEST(FieldConverge, refusesWhatCannotEnd) {
    Field field = *Field::create(*Context::create({.threads = 1}), smallDesc(), smallDesc());
    for (const float tolerance : {0.0f, -1.0f, std::nanf("")}) {
        const auto done = field.converge(Furnace(), {}, tolerance, 8);
        ASSERT_FALSE(done);
        EXPECT_NE(done.error().message.find("tolerance"), std::string::npos);
    }
    const auto none = field.converge(Furnace(), {}, 0.01f, 0);
    ASSERT_FALSE(none);
    EXPECT_NE(none.error().message.find("maxFrames"), std::string::npos);
    EXPECT_EQ(field.control().frame(), 0);
}

TEST(FieldConverge, endsWhenItIsCancelled) {
    const Context context = *Context::create({.threads = 1, .progress = [](const ProgressReport&) { return false; }});
    Field field = *Field::create(context, smallDesc(), smallDesc());
    // Progress is reported at most ten times a second.
    const auto pause = [](const UpdateTimes&) { std::this_thread::sleep_for(std::chrono::milliseconds(150)); };
    const auto done = field.converge(Furnace(), {}, 1e-6f, 50, pause);
    ASSERT_FALSE(done);
    EXPECT_EQ(done.error().code, ErrorCode::cancelled);
}

TEST(FieldUpdate, wantsARayDatumForEachRay) {
    const FieldSetup desc = smallDesc();
    Field field = *Field::create(*Context::create({.threads = 1}), desc, desc);
    std::vector<RayDatum> rays(8 * 64, {glm::vec3(1.0f), 1});
    std::vector<FixedRayDatum> fixed(std::size_t(8 * desc.fixedRays), {1, 0, 1});
    for (const std::size_t wrong : {std::size_t(0), rays.size() - 1}) {
        const auto done = field.update(std::span(rays).first(wrong));
        ASSERT_FALSE(done);
        EXPECT_NE(done.error().message.find("rayData"), std::string::npos);
    }
    const auto done = field.update(rays, std::span(fixed).first(31));
    ASSERT_FALSE(done);
    EXPECT_NE(done.error().message.find("fixedRays"), std::string::npos);
    EXPECT_EQ(field.control().frame(), 0);
    EXPECT_TRUE(field.update(rays, fixed));
    EXPECT_TRUE(field.update(rays));
    EXPECT_EQ(field.control().frame(), 2);
    std::vector<FieldQuery> queries(3);
    std::vector<glm::vec3> answers(2);
    EXPECT_FALSE(field.irradiance(queries, answers));
}

/// Fails when told to.
struct BrokenTracer : Furnace {
    bool hits = true;
    Result<void> closestHits(std::span<const Ray> rays, std::span<Hit> out) const override {
        if (hits) return fail(ErrorCode::outOfMemory, "no hits today");
        return Furnace::closestHits(rays, out);
    }
    Result<void> surfaces(std::span<const Ray>, std::span<const Hit>, std::span<Surface>) const override {
        return fail(ErrorCode::outOfMemory, "no surfaces today");
    }
};

// A failed update does not count as a frame: the next one reuses its rays.
TEST(FieldUpdate, doesNotCountAsAFrameIfItFails) {
    Field field = *Field::create(*Context::create({.threads = 1}), smallDesc(), smallDesc());
    const glm::vec3 ray = field.control().rayDirections()[0];
    BrokenTracer broken;
    EXPECT_EQ(field.update(broken, {}).error().message, "no hits today");
    broken.hits = false;
    EXPECT_EQ(field.update(broken, {}).error().message, "no surfaces today");
    EXPECT_EQ(field.converge(broken, {}, 0.1f, 3).error().message, "no surfaces today");
    EXPECT_EQ(field.control().frame(), 0);
    EXPECT_EQ(field.control().rayDirections()[0], ray);
    ASSERT_TRUE(field.update(Furnace(), {}));
    EXPECT_NE(field.control().rayDirections()[0], ray);
}

// Each update adds a bounce: 1, 1.5, 1.75 ... towards 2.
TEST(FieldUpdate, addsABounceAFrame) {
    FieldSetup desc = smallDesc();
    desc.hysteresis = desc.visibilityHysteresis = 0;
    desc.rules = FieldRules::paper;
    Field field = *Field::create(*Context::create({.threads = 1}), desc, desc);
    float expected = 0;
    for (int i = 0; i < 5; ++i) {
        ASSERT_TRUE(field.update(Furnace(), {}));
        expected = 1 + 0.5f * expected;
        EXPECT_NEAR(field.irradiance({glm::vec3(0.0f), {1, 0, 0}}).x / 3.14159265f, expected, 0.01f * expected) << i;
    }
}

}  // namespace
}  // namespace probegi::test

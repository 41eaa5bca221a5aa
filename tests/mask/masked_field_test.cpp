// Fields that are looked up through masks.
#include <gmock/gmock.h>

#include <glm/geometric.hpp>
#include <random>

#include "halls.h"

namespace probegi::test {
namespace {

using testing::HasSubstr;

constexpr float kPi = 3.14159265f;

/// Fills a field by rays that the scene blocks, with the light that each probe is given.
void fill(Field& field, const Tracer& tracer, const std::function<float(glm::vec3)>& lightOf) {
    const auto directions = field.control().rayDirections();
    std::vector<Ray> rays;
    std::vector<RayDatum> data;
    for (const ProbeTask& task : field.control().tasks())
        for (const glm::vec3& direction : directions) rays.push_back({.origin = task.origin, .direction = direction});
    std::vector<Hit> hits(rays.size());
    ASSERT_TRUE(tracer.closestHits(rays, hits));
    for (std::size_t i = 0; i < rays.size(); ++i)
        data.push_back({glm::vec3(lightOf(rays[i].origin)), hits[i].valid() ? hits[i].distance : 1e3f});
    ASSERT_TRUE(field.update(data));
}

FieldSetup masked(const std::shared_ptr<const Masks>& masks) {
    FieldSetup setup{Halls::field()};
    setup.volumes = masks->volumes();
    setup.guard = LeakGuard::masks;
    setup.masks = masks;
    return setup;
}

/// Points on the surfaces of the halls that face the side of the wall they are on.
std::vector<FieldQuery> surfacePoints(float wall, bool right, int count) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    const glm::vec3 lower(right ? wall + Halls::kHalfWall : -2.0f, 0, -2),
        upper(right ? 2.0f : wall - Halls::kHalfWall, 3, 2);
    std::vector<FieldQuery> points;
    for (int i = 0; i < count; ++i) {
        const int axis = i % 3;
        const bool high = i / 3 % 2 == 1;
        const float a = unit(random), b = unit(random), c = unit(random);
        FieldQuery q;
        q.position = lower + glm::vec3(a, b, c) * (upper - lower);
        q.position[axis] = high ? upper[axis] : lower[axis];
        q.normal = glm::vec3(0);
        q.normal[axis] = high ? -1.0f : 1.0f;
        points.push_back(q);
    }
    return points;
}

std::vector<glm::vec3> answersOf(const Field& field, const std::vector<FieldQuery>& queries) {
    std::vector<glm::vec3> answers(queries.size());
    EXPECT_TRUE(field.irradiance(queries, answers));
    return answers;
}

TEST(MaskedField, constantLightIsExactEverywhere) {
    const Halls halls(0.17f);
    for (const bool strict : {false, true}) {
        Field field = masked(halls.bake({.clusters = 3, .strict = strict})).make(halls.context).value();
        fill(field, *halls.tracer, [](glm::vec3) { return 2.5f; });
        auto points = surfacePoints(0.17f, false, 2000), more = surfacePoints(0.17f, true, 2000);
        points.insert(points.end(), more.begin(), more.end());
        for (const glm::vec3& e : answersOf(field, points)) ASSERT_NEAR(e.x, 2.5f * kPi, 2e-3f * 2.5f * kPi);
    }
}

TEST(MaskedField, aWallPartsTwoLights) {
    // Left 1, right 100: what the left has more than 1 came through the wall.
    for (const float wall : {0.17f, 0.4f, 0.3f, -0.3f}) {
        const Halls halls(wall);
        const auto leak = [&](FieldSetup setup) {
            Field field = setup.make(halls.context).value();
            fill(field, *halls.tracer, [&](glm::vec3 at) { return at.x < wall ? 1.0f : 100.0f; });
            double sum = 0;
            const auto points = surfacePoints(wall, false, 6000);
            for (const glm::vec3& e : answersOf(field, points)) sum += double(e.x / kPi - 1) / 99;
            for (const glm::vec3& e : answersOf(field, surfacePoints(wall, true, 6000))) EXPECT_LE(e.x, 101 * kPi);
            return sum / double(points.size());
        };
        FieldSetup leaking = masked(halls.bake());
        leaking.guard = LeakGuard::none;
        EXPECT_GT(leak(leaking), 0.01) << "the scene can leak";
        EXPECT_LT(leak(masked(halls.bake({.clusters = 4}))), 1e-3) << wall;
        EXPECT_LT(leak(masked(halls.bake({.clusters = 6, .strict = true}))), 5e-4) << wall;
    }
}

TEST(MaskedField, withoutItsGuardMasksChangeNothing) {
    const Halls halls(0.17f);
    FieldSetup with = masked(halls.bake()), without{Halls::field()};
    with.guard = LeakGuard::moments;
    Field a = with.make(halls.context).value(), b = without.make(halls.context).value();
    for (Field* field : {&a, &b}) fill(*field, *halls.tracer, [](glm::vec3 at) { return at.y + 3.0f; });
    const auto points = surfacePoints(0.17f, false, 500);
    EXPECT_EQ(answersOf(a, points), answersOf(b, points));
}

TEST(MaskedField, oneAtATimeAnswersAsManyAtOnce) {
    const Halls halls(0.17f);
    Field field = masked(halls.bake({.clusters = 5})).make(halls.context).value();
    fill(field, *halls.tracer, [](glm::vec3 at) { return at.x < 0.17f ? 1.0f : 100.0f; });
    const auto points = surfacePoints(0.17f, true, 300);
    const auto together = answersOf(field, points);
    for (std::size_t i = 0; i < points.size(); ++i)
        EXPECT_NEAR(field.irradiance(points[i]).x, together[i].x, 1e-5f * together[i].x);
}

TEST(MaskedField, bouncesStayOnTheirSide) {
    // A lamp on the left; what bounces lights the right through the field alone.
    Halls halls(0.17f);
    halls.scene.materials[0].baseColor = glm::vec4(0.7f);
    halls.scene.materials.emplace_back().emission = glm::vec3(10);
    Primitive lamp;
    lamp.material = 1;
    addQuad(lamp, {-1.5f, 2.9f, -0.5f}, {1, 0, 0}, {0, 0, 1});
    addObject(halls.scene, std::move(lamp));
    halls.finish();
    const auto light = [&](FieldSetup setup) {
        setup.raysPerProbe = 64;
        Field field = setup.make(halls.context).value();
        EXPECT_TRUE(field.converge(*halls.tracer, {}, 0.05f, 10));
        const auto mean = [&](bool right) {
            double sum = 0;
            for (const glm::vec3& e : answersOf(field, surfacePoints(0.17f, right, 2000))) sum += double(e.x);
            return sum;
        };
        return mean(true) / mean(false);
    };
    FieldSetup leaking = masked(halls.bake());
    leaking.guard = LeakGuard::none;
    EXPECT_GT(light(leaking), 0.01);
    EXPECT_LT(light(masked(halls.bake())), 1e-5);
}

TEST(MaskedField, refusesWhatDoesNotFit) {
    const Halls halls(0.17f);
    const auto masks = halls.bake();
    const auto complaint = [](const auto& result) { return result ? std::string() : result.error().message; };
    FieldSetup setup = masked(masks);
    setup.masks = nullptr;
    EXPECT_THAT(complaint(setup.make(halls.context)), HasSubstr("needs FieldSettings::masks"));
    setup = masked(masks);
    setup.volumes[0].spacing.x = 0.8f;
    EXPECT_THAT(complaint(setup.make(halls.context)), HasSubstr("baked for other volumes"));

    Field field = FieldSetup{Halls::field()}.make(halls.context).value();
    FieldSettings settings = field.control().settings();
    settings.guard = LeakGuard::masks;
    EXPECT_THAT(complaint(field.control().setSettings(settings)), HasSubstr("needs FieldSettings::masks"));
    settings.masks = masks;
    EXPECT_TRUE(field.control().setSettings(settings));
    EXPECT_THAT(complaint(field.scroll(0, {1, 0, 0})), HasSubstr("cannot scroll"));
    settings.guard = LeakGuard::moments;
    EXPECT_TRUE(field.control().setSettings(settings));
    EXPECT_TRUE(field.scroll(0, {1, 0, 0}));
    settings.guard = LeakGuard::masks;
    EXPECT_THAT(complaint(field.control().setSettings(settings)), HasSubstr("cannot scroll"));
}

}  // namespace
}  // namespace probegi::test

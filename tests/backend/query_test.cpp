// Atlases to answers: against closed forms, and every backend against the CPU's.
#include <cmath>

#include "backend/every_backend.h"
#include "field/layout.h"
#include "kernels/random.h"
#include "support/field_setup.h"
#include "support/probes.h"

namespace probegi::test {
namespace {

constexpr float kPi = 3.14159265f;

class BackendQuery : public EveryBackend {
protected:
    /// Two updates with random rays, on this backend and on the CPU.
    std::pair<Field, Field> randomPair(FieldDesc desc, bool walls = false) const {
        std::pair<Field, Field> pair{makeField(desc), made(kCpu.makeField(context, desc))};
        for (std::uint32_t frame = 0; frame < 2; ++frame) {
            auto data = randomData(desc, 50 + frame);
            // Half of the probes stand in walls, in slabs that are wider than a cage.
            for (std::size_t i = 0; walls && i < data.size(); ++i)
                if (int(i / std::size_t(desc.raysPerProbe)) % desc.volumes[0].counts.x % 4 < 2)
                    data[i].distance = -std::abs(data[i].distance);
            EXPECT_TRUE(pair.first.update(data));
            EXPECT_TRUE(pair.second.update(data));
        }
        return pair;
    }

    /// Answers of the two for the same points. Atlases may differ by a storage step here and there, whose share in an
    /// answer is at most 5 * 2^-10 per channel.
    void expectSameAnswers(const std::pair<Field, Field>& pair, std::span<const FieldQuery> queries) const {
        const auto got = ask(pair.first, queries), want = ask(pair.second, queries);
        int beyondRounding = 0;
        for (std::size_t i = 0; i < queries.size(); ++i) {
            ASSERT_GT(want[i].x, 0.0f);
            for (int c = 0; c < 3; ++c) {
                const double relative = std::abs(double(got[i][c]) / want[i][c] - 1);
                ASSERT_LE(relative, 5.0 / 1024) << "query " << i;
                beyondRounding += relative > 1e-4 ? 1 : 0;
            }
        }
        EXPECT_LE(beyondRounding, int(queries.size() * 3 / 50));
        EXPECT_EQ(pair.first.fallbackQueries(), pair.second.fallbackQueries());
    }
};
PROBEGI_ON_EVERY_BACKEND(BackendQuery);

// Quality.md: a constant field is returned exactly, inside, on faces and outside, whatever the guard.
TEST_P(BackendQuery, constantFieldIsConstantEverywhere) {
    for (const LeakGuard guard : {LeakGuard::none, LeakGuard::moments}) {
        FieldSetup desc = smallDesc();
        desc.guard = guard;
        Field field = makeField(desc);
        ASSERT_TRUE(field.update(constantData(desc, {1, 32, 0}, 0.4f)));  // fifth roots exact in half floats
        for (const glm::vec3& e : ask(field, randomQueries(2000))) {
            EXPECT_NEAR(e.x, kPi * 1, 1e-3f);
            EXPECT_NEAR(e.y, kPi * 32, 3e-2f);
            EXPECT_EQ(e.z, 0.0f);
        }
    }
}

TEST_P(BackendQuery, answersAreTheCpus) {
    for (const LeakGuard guard : {LeakGuard::none, LeakGuard::moments}) {
        FieldSetup desc = smallDesc();
        desc.guard = guard;
        expectSameAnswers(randomPair(desc), randomQueries(5000));
    }
}

TEST_P(BackendQuery, aGuardThatIsNotThereGuardsNothing) {
    Field field = makeField(smallDesc());
    ASSERT_TRUE(field.update(randomData(field.desc(), 6)));
    const auto queries = randomQueries(200);
    changeSettings(field, [](FieldSettings& s) { s.guard = LeakGuard{100}; });
    const auto unknown = ask(field, queries);
    changeSettings(field, [](FieldSettings& s) { s.guard = LeakGuard::none; });
    EXPECT_EQ(ask(field, queries), unknown);
}

// A point between probes that stand in walls, or far from all that see it: the wider search answers.
TEST_P(BackendQuery, fallbackAnswersAreTheCpus) {
    for (const LeakGuard guard : {LeakGuard::none, LeakGuard::moments}) {
        FieldSetup desc = smallDesc();
        desc.volumes[0].counts = {12, 4, 4};
        desc.guard = guard;
        const auto pair = randomPair(desc, true);
        std::vector<FieldQuery> queries = randomQueries(3000);
        for (FieldQuery& q : queries) q.position *= glm::vec3(1.5f, 0.4f, 0.4f);
        expectSameAnswers(pair, queries);
        EXPECT_GT(pair.first.fallbackQueries(), 300u);
    }
}

TEST_P(BackendQuery, whereAllProbesStandInWallsItIsDark) {
    const FieldSetup desc = smallDesc();
    Field field = makeField(desc);
    ASSERT_TRUE(field.update(constantData(desc, glm::vec3(7.0f), -0.1f)));
    for (const glm::vec3& e : ask(field, randomQueries(100))) EXPECT_EQ(e, glm::vec3(0.0f));
    EXPECT_EQ(field.fallbackQueries(), 100u);
}

// Directions on the octahedral map's seams and corners, and a hair beside them: where a border is read.
TEST_P(BackendQuery, seamsOfTheMapsAreTheCpus) {
    for (const int size : {4, 8}) {
        FieldSetup desc = smallDesc();
        desc.irradianceTexels = size;
        desc.visibilityTexels = 2 * size;
        const auto pair = randomPair(desc);
        std::vector<glm::vec3> seams = {{0, 0, -1}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}};
        for (int i = 0; i < 64; ++i) {
            const float angle = 2 * kPi * float(i) / 64, z = i % 2 ? -0.3f : -0.9f;
            // The map's edge is the half circles of the lower half in the planes of the axes.
            const glm::vec3 along = i % 4 < 2 ? glm::vec3(std::cos(angle), 0, 0) : glm::vec3(0, std::cos(angle), 0);
            for (const float beside : {-1e-3f, 0.0f, 1e-3f})
                seams.push_back(glm::normalize(along + glm::vec3(beside, beside, z)));
        }
        for (const glm::vec3& n : seams)
            for (const int probe : {0, 17, 119}) {
                const glm::vec3 got = probeIrradiance(pair.first, probe, n),
                                want = probeIrradiance(pair.second, probe, n);
                for (int c = 0; c < 3; ++c) EXPECT_NEAR(got[c] / want[c], 1.0f, 5.0f / 1024);
                const glm::vec2 moments = probeDistanceMoments(pair.first, probe, n);
                EXPECT_LE(glm::length(moments - probeDistanceMoments(pair.second, probe, n)), 3e-4f);
            }
    }
}

// A probe's map is continuous across its seams: two directions a hair apart on either side of an edge.
TEST_P(BackendQuery, mapsAreContinuousAcrossTheirSeams) {
    Field field = makeField(smallDesc());
    ASSERT_TRUE(field.update(randomData(field.desc(), 3)));
    for (int i = 0; i < 50; ++i) {
        const float along = 0.9f * (2.0f * float(i) / 49 - 1);
        for (const glm::vec3 hair : {glm::vec3(1e-4f, 0, 0), glm::vec3(0, 1e-4f, 0)}) {
            const glm::vec3 seam = hair.x > 0 ? glm::vec3(0, along, -1) : glm::vec3(along, 0, -1);
            const glm::vec3 a = probeIrradiance(field, 11, glm::normalize(seam + hair));
            const glm::vec3 b = probeIrradiance(field, 11, glm::normalize(seam - hair));
            EXPECT_NEAR(a.x / b.x, 1.0f, 2e-3f) << along;
        }
    }
}

TEST_P(BackendQuery, manyAtOnceEqualOneByOne) {
    Field field = makeField(smallDesc());
    ASSERT_TRUE(field.update(randomData(field.desc(), 6)));
    const auto queries = randomQueries(40);
    const auto answers = ask(field, queries);
    for (std::size_t i = 0; i < queries.size(); ++i) EXPECT_EQ(answers[i], field.irradiance(queries[i]));
}

TEST_P(BackendQuery, anyNumberOfQueries) {
    Field field = makeField(smallDesc());
    ASSERT_TRUE(field.update(constantData(field.desc(), glm::vec3(1.0f), 1.0f)));
    for (const int count : {0, 1, 63, 64, 65, 70000})
        for (const glm::vec3& e : ask(field, randomQueries(count))) ASSERT_NEAR(e.y, kPi, 1e-3f);
}

// One wall of probes that sees a near surface towards +X: what lies beyond is shadowed, what lies before is not.
TEST_P(BackendQuery, momentsGuardIgnoresProbesBehindAWall) {
    FieldSetup desc;
    desc.volumes = {{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}};
    desc.raysPerProbe = 512;
    const auto irradianceIn = [&](LeakGuard guard) {
        FieldSetup d = desc;
        d.guard = guard;
        Field field = makeField(d);
        for (int frame = 0; frame < 30; ++frame) {
            std::vector<RayDatum> data;
            for (int probe = 0; probe < probeCount(d.volumes[0]); ++probe)
                for (const glm::vec3& w : field.control().rayDirections()) {
                    // A thin wall at x = 0.5; bright for the probes beyond it, black for those before it.
                    const float x = 0.5f - probePosition(d.volumes[0], probe).x;
                    const float t = x * w.x > 0 ? x / w.x : 1e30f;
                    data.push_back({glm::vec3(x < 0 ? 1.0f : 0.0f), t});
                }
            EXPECT_TRUE(field.update(data));
        }
        // A point on the dark side, facing along the wall: half of what it faces lies beyond.
        return field.irradiance({{0.4f, 0.5f, 0.5f}, {0, 1, 0}, {-0.6f, 0.8f, 0}}).x;
    };
    EXPECT_GT(irradianceIn(LeakGuard::none), 0.05f * kPi);
    EXPECT_LT(irradianceIn(LeakGuard::moments), 0.005f * kPi);
}

// The wider search too: where the cage stands in a wall, the guard alone decides whether distances count.
TEST_P(BackendQuery, onlyTheMomentsGuardLooksAtDistances) {
    const auto irradianceIn = [this](LeakGuard guard, float distanceOfBrightProbes) {
        FieldSetup desc;
        desc.volumes = {{{0, 0, 0}, {1, 1, 1}, {6, 4, 4}}};
        desc.guard = guard;
        Field field = makeField(desc);
        std::vector<RayDatum> data;
        for (int probe = 0; probe < probeCount(desc); ++probe) {
            const int x = probe % 6;
            RayDatum datum{glm::vec3(0.0f), 5.0f};
            if (x < 2) datum = {glm::vec3(1.0f), distanceOfBrightProbes};
            if (x == 2 || x == 3) datum.distance = -0.1f;
            data.insert(data.end(), std::size_t(desc.raysPerProbe), datum);
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

// Zero stands for the normal: on a wall as on a floor, nobody has to name a viewer.
TEST_P(BackendQuery, aViewerOfZeroIsTheNormal) {
    for (const FieldRules rules : {FieldRules::measured, FieldRules::paper}) {
        FieldSetup desc = smallDesc();
        desc.rules = rules;
        const auto pair = randomPair(desc);
        std::vector<FieldQuery> named = randomQueries(500), unnamed;
        for (FieldQuery& q : named) {
            unnamed.push_back({.position = q.position, .normal = q.normal});
            q.toViewer = q.normal;
        }
        EXPECT_EQ(ask(pair.first, unnamed), ask(pair.first, named));
        for (FieldQuery& q : named) q.toViewer = {0, 1, 0};
        EXPECT_NE(ask(pair.first, unnamed), ask(pair.first, named));
    }
}

TEST_P(BackendQuery, spansOfDifferentLengthsAreRefused) {
    const Field field = makeField(smallDesc());
    const std::vector<FieldQuery> queries(5);
    for (const std::size_t room : {0, 4, 6}) {
        std::vector<glm::vec3> answers(room);
        const auto asked = field.irradiance(queries, answers);
        ASSERT_FALSE(asked);
        EXPECT_EQ(asked.error().code, ErrorCode::invalidArgument);
        EXPECT_NE(asked.error().message.find("5 queries"), std::string::npos) << asked.error().message;
    }
}

TEST_P(BackendQuery, theGuardMayChangeBetweenQueries) {
    Field field = makeField(smallDesc());
    ASSERT_TRUE(field.update(randomData(field.desc(), 6)));
    const auto queries = randomQueries(200);
    const auto guarded = ask(field, queries);
    changeSettings(field, [&](FieldSettings& s) { s.guard = LeakGuard::none; });
    EXPECT_NE(ask(field, queries), guarded);
    changeSettings(field, [&](FieldSettings& s) { s.guard = LeakGuard::moments; });
    EXPECT_EQ(ask(field, queries), guarded);
}

}  // namespace
}  // namespace probegi::test

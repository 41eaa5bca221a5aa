// Volumes that blend, cover, and follow a camera (DDGI paper, section 7.4), on every backend.
#include <array>
#include <functional>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <random>

#include "backend/every_backend.h"

namespace probegi::test {
namespace {

constexpr float kPi = 3.14159265f;
constexpr glm::vec3 kUp(0, 1, 0);

// A level, a finer volume in its middle, turned, and a still finer one that sticks out of the level.
const VolumeDesc kLevel{.origin = {-4, -2, -4}, .spacing = {1, 1, 1}, .counts = {9, 6, 9}};
const VolumeDesc kHero{.origin = {-1, -1, -1},
                       .spacing = glm::vec3(0.5f),
                       .counts = {5, 5, 5},
                       .orientation = glm::angleAxis(0.6f, glm::normalize(glm::vec3(1, 2, 0.5f)))};
const VolumeDesc kBalcony{.origin = {2.5f, 0, 0}, .spacing = glm::vec3(0.4f), .counts = {7, 5, 6}};

VolumeDesc tracking(VolumeDesc volume) {
    volume.tracksCamera = true;
    return volume;
}

FieldSetup setupOf(std::vector<VolumeDesc> volumes) {
    FieldSetup setup;
    setup.volumes = std::move(volumes);
    setup.raysPerProbe = 16;
    setup.fixedRays = 0;
    setup.emitterSamples = 0;
    return setup;
}

// Each volume has its own light, the same from all sides, by the size of its cells.
float lightOf(const VolumeDesc& volume) {
    return 1.0f / (volume.spacing.x * volume.spacing.x);
}

glm::vec3 inWorld(const VolumeDesc& v, glm::vec3 cell) {
    return v.origin + v.orientation * (cell * v.spacing);
}

class BackendVolumeBlend : public EveryBackend {
protected:
    static void updateWith(Field& field, const std::function<float(const VolumeDesc&)>& light) {
        std::vector<RayDatum> rays;
        for (const ProbeTask& task : field.control().tasks())
            rays.insert(rays.end(), std::size_t(field.desc().raysPerProbe),
                        {glm::vec3(light(field.desc().volumes[task.volume])), 50.0f});
        ASSERT_TRUE(field.update(rays));
    }
    Field lit(const FieldSetup& setup) const {
        Field field = makeField(setup);
        updateWith(field, lightOf);
        return field;
    }
    // E / pi upwards.
    static float at(const Field& field, glm::vec3 point) { return field.irradiance({point, kUp, kUp}).x / kPi; }

    static std::vector<FieldQuery> randomPoints(int count, float reach) {
        std::mt19937 random(11);
        std::uniform_real_distribution<float> unit(-reach, reach);
        std::vector<FieldQuery> queries;
        for (int i = 0; i < count; ++i) {
            const float x = unit(random), y = unit(random), z = unit(random);
            queries.push_back({glm::vec3(x, y, z), i % 2 == 0 ? kUp : glm::vec3(0.6f, 0, -0.8f)});
        }
        return queries;
    }
    // On and beside each volume's faces, edges and corners, and where its weight begins to fall.
    static std::vector<FieldQuery> seams(const std::vector<VolumeDesc>& volumes) {
        std::vector<FieldQuery> queries;
        for (const VolumeDesc& v : volumes) {
            const auto places = [&](int axis) {
                const float last = float(v.counts[axis] - 1);
                return std::array{-0.3f, 0.0f, 0.5f, 1.0f, 1.5f, last - 1.0f, last - 0.2f, last, last + 0.7f};
            };
            for (const float x : places(0))
                for (const float y : places(1))
                    for (const float z : places(2)) queries.push_back({inWorld(v, {x, y, z}), kUp});
        }
        return queries;
    }
};
PROBEGI_ON_EVERY_BACKEND(BackendVolumeBlend);

TEST_P(BackendVolumeBlend, aConstantFieldIsConstantAtEverySeam) {
    const std::vector<VolumeDesc> volumes{kLevel, kHero, tracking(kBalcony)};
    for (const FieldRules rules : {FieldRules::measured, FieldRules::paper})
        for (const bool camera : {false, true}) {
            FieldSetup setup = setupOf(volumes);
            setup.rules = rules;
            if (camera) setup.camera = inWorld(kBalcony, {3.3f, 1.8f, 2.6f});
            Field field = makeField(setup);
            updateWith(field, [](const VolumeDesc&) { return 1.0f; });
            std::vector<FieldQuery> queries = seams(volumes);
            const auto more = randomPoints(1000, 6);
            queries.insert(queries.end(), more.begin(), more.end());
            const auto e = ask(field, queries);
            for (std::size_t i = 0; i < e.size(); ++i) ASSERT_NEAR(e[i].x, kPi, 2e-5f * kPi) << i;
        }
}

// What volumeShares() says is what look-ups do.
TEST_P(BackendVolumeBlend, answersAreTheSharesOfTheVolumes) {
    VolumeDesc hero = kHero;
    hero.counts = {9, 8, 9};
    const std::vector<VolumeDesc> volumes{kLevel, tracking(hero), kBalcony};
    FieldSetup setup = setupOf(volumes);
    for (const bool camera : {false, true}) {
        if (camera) setup.camera = inWorld(hero, {4.2f, 3.7f, 4.4f});
        const Field field = lit(setup);
        std::vector<FieldQuery> queries = seams(volumes);
        const auto more = randomPoints(1000, 6);
        queries.insert(queries.end(), more.begin(), more.end());
        const auto e = ask(field, queries);
        std::array<int, 3> alone{};
        int blended = 0;
        for (std::size_t i = 0; i < e.size(); ++i) {
            const std::vector<float> shares = field.control().volumeShares(queries[i].position).value();
            float sum = 0, want = 0;
            for (std::size_t v = 0; v < 3; ++v) {
                sum += shares[v];
                want += shares[v] * lightOf(volumes[v]);
                alone[v] += shares[v] == 1.0f ? 1 : 0;
                blended += shares[v] > 0.05f && shares[v] < 0.95f ? 1 : 0;
            }
            ASSERT_NEAR(sum, 1.0f, 1e-5f);
            ASSERT_NEAR(e[i].x / kPi, want, 5e-3f * want) << i;
        }
        for (const int count : alone) EXPECT_GT(count, 15);
        EXPECT_GT(blended, 100);
    }
}

// From a dense volume into a sparse one: as steep as the weight's fall over a cell, and no steeper.
TEST_P(BackendVolumeBlend, lightIsContinuousAcrossASeam) {
    for (const bool turned : {false, true}) {
        VolumeDesc dense = kHero;
        if (!turned) dense.orientation = glm::quat(1, 0, 0, 0);
        const Field field = lit(setupOf({kLevel, dense}));
        const float inner = lightOf(dense), outer = lightOf(kLevel);
        const int steps = 120;
        std::vector<FieldQuery> line;
        for (int i = 0; i <= steps; ++i)
            line.push_back({inWorld(dense, {2.0f + 3.0f * float(i) / float(steps), 2.1f, 1.9f}), kUp});
        const auto e = ask(field, line);
        EXPECT_NEAR(e.front().x / kPi, inner, 0.01f * inner);
        EXPECT_NEAR(e.back().x / kPi, outer, 0.01f * outer);
        for (int i = 1; i <= steps; ++i) {
            const float fall = (e[std::size_t(i) - 1].x - e[std::size_t(i)].x) / kPi;
            EXPECT_LE(fall, 1.05f * (inner - outer) * 3.0f / float(steps)) << i;
            EXPECT_GE(fall, -1e-3f) << i;
        }
        // Half way down the last cell.
        EXPECT_NEAR(at(field, inWorld(dense, {3.5f, 2.1f, 1.9f})), 0.5f * (inner + outer), 0.02f * inner);
    }
}

TEST_P(BackendVolumeBlend, theDensestAnswersWhateverTheListsOrder) {
    const std::vector<FieldQuery> queries = randomPoints(1500, 5);
    std::vector<VolumeDesc> volumes{kLevel, kHero, kBalcony};
    const auto want = ask(lit(setupOf(volumes)), queries);
    for (const auto& order : {std::array{2, 0, 1}, std::array{1, 2, 0}, std::array{2, 1, 0}}) {
        std::vector<VolumeDesc> permuted;
        for (const int i : order) permuted.push_back(volumes[std::size_t(i)]);
        const auto got = ask(lit(setupOf(permuted)), queries);
        for (std::size_t i = 0; i < got.size(); ++i) ASSERT_NEAR(got[i].x, want[i].x, 1e-4f * want[i].x) << i;
    }
    // Of equally dense ones the first of the list.
    VolumeDesc twin = kLevel;
    twin.origin += glm::vec3(1);
    Field field = makeField(setupOf({twin, kLevel}));
    updateWith(field, [&](const VolumeDesc& v) { return v.origin == twin.origin ? 1.0f : 2.0f; });
    EXPECT_NEAR(at(field, {0, 0.5f, 0}), 1.0f, 0.01f);
}

// A window that has just leapt away: who knows the light answers, and black is only what nobody knows.
TEST_P(BackendVolumeBlend, aVolumeOfNewProbesLeavesTheAnswerToOthers) {
    for (const FieldRules rules : {FieldRules::measured, FieldRules::paper})
        for (const LeakGuard guard : {LeakGuard::moments, LeakGuard::none}) {
            FieldSetup setup = setupOf({kHero, kLevel});
            setup.rules = rules;
            setup.guard = guard;
            Field field = lit(setup);
            const glm::vec3 inside = inWorld(kHero, {2, 2, 2});
            EXPECT_NEAR(at(field, inside), lightOf(kHero), 0.02f * lightOf(kHero));
            ASSERT_TRUE(field.scroll(0, {40, 0, 0}));
            ASSERT_TRUE(field.scroll(0, {-40, 0, 0}));  // where it was, and all new
            EXPECT_NEAR(at(field, inside), lightOf(kLevel), 0.02f) << "the level knows";
            EXPECT_NEAR(at(field, inWorld(kHero, {3.6f, 2, 2})), lightOf(kLevel), 0.02f) << "in the last cell too";
            // Far outside the level, in the middle of nothing but new probes: the nearest that knows.
            ASSERT_TRUE(field.scroll(0, {40, 0, 0}));
            const VolumeDesc away = field.control().place(0);
            EXPECT_NEAR(at(field, inWorld(away, {2, 2, 2})), lightOf(kLevel), 0.02f);
            updateWith(field, lightOf);
            EXPECT_NEAR(at(field, inWorld(away, {2, 2, 2})), lightOf(kHero), 0.02f * lightOf(kHero));
        }
}

TEST_P(BackendVolumeBlend, outsideItFadesWhereItIsAskedTo) {
    const std::vector<VolumeDesc> volumes{kHero, kLevel};
    const glm::vec3 outside(0.25f, 2, 4);
    for (const std::size_t count : {1u, 2u}) {
        FieldSetup setup = setupOf({volumes.end() - std::ptrdiff_t(count), volumes.end()});
        const Field nearest = lit(setup);
        setup.outside = OutsideLight::fades;
        setup.outsideRadiance = outside;
        const Field fading = lit(setup);
        // Inside and half a cell beyond nothing changes, to the bit; a cell and a half beyond, all is outside.
        for (const float y : {0.5f, 2.9f, 3.0f, 3.45f}) {
            const FieldQuery query{{0.2f, y, 0.3f}, kUp, kUp};
            EXPECT_EQ(fading.irradiance(query), nearest.irradiance(query)) << y;
        }
        for (const float y : {3.7f, 4.0f, 4.4f}) {
            const glm::vec3 e = fading.irradiance({{0.2f, y, 0.3f}, kUp, kUp});
            const float covered = 4.5f - y;
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(e[c] / kPi, covered * lightOf(kLevel) + (1 - covered) * outside[c], 0.01f) << y;
            EXPECT_NEAR(fading.control().coverage({0.2f, y, 0.3f}), covered, 1e-5f);
        }
        for (const glm::vec3 far : {glm::vec3(0.2f, 4.6f, 0.3f), glm::vec3(500, -20, 3), glm::vec3(-1e6f, 1e6f, 0)}) {
            const glm::vec3 e = fading.irradiance({far, kUp, kUp});
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(e[c], kPi * outside[c], 1e-4f) << far.x;
            EXPECT_NEAR(at(nearest, far), lightOf(kLevel), 0.01f) << far.x;
            EXPECT_EQ(fading.control().coverage(far), 0.0f);
        }
    }
}

// A camera that walks through its window's leaps (Figure 13): with its place known, a point's light changes by what the
// camera moved, without by all that the volumes differ.
TEST_P(BackendVolumeBlend, lightChangesAsTheCameraMoves) {
    const VolumeDesc window = tracking({.origin = glm::vec3(-1.5f), .spacing = glm::vec3(0.5f), .counts = {7, 7, 7}});
    const float inner = lightOf(window), outer = lightOf(kLevel), step = 0.05f;
    float with = 0, without = 0;
    int leaps = 0;
    Field field = lit(setupOf({window, kLevel}));
    std::vector<FieldQuery> points;
    for (int i = 0; i < 40; ++i) points.push_back({glm::vec3(-3.0f + 0.15f * float(i), 0.1f, 0.2f), kUp, kUp});
    std::vector<glm::vec3> lastWith, lastWithout;
    const auto largest = [](const std::vector<glm::vec3>& now, std::vector<glm::vec3>& last) {
        float most = 0;
        for (std::size_t i = 0; i < last.size(); ++i) most = std::max(most, std::abs(now[i].x - last[i].x) / kPi);
        last = now;
        return most;
    };
    for (int frame = 0; frame < 40; ++frame) {
        const VolumeDesc before = field.control().place(0);
        ASSERT_TRUE(field.followCamera({-1.0f + step * float(frame), 0, 0}));
        leaps += field.control().place(0) == before ? 0 : 1;
        updateWith(field, lightOf);
        with = std::max(with, largest(ask(field, points), lastWith));
        changeSettings(field, [](FieldSettings& s) { s.camera.reset(); });
        without = std::max(without, largest(ask(field, points), lastWithout));
    }
    EXPECT_GE(leaps, 3);
    EXPECT_LT(with, 1.1f * (inner - outer) * step / window.spacing.x);
    EXPECT_GT(without, 0.9f * (inner - outer));
}

TEST_P(BackendVolumeBlend, answersAreTheCpus) {
    FieldSetup setup = setupOf({kLevel, tracking(kHero), kBalcony});
    setup.camera = inWorld(kHero, {2.2f, 1.7f, 2.4f});
    setup.outside = OutsideLight::fades;
    setup.outsideRadiance = {0.5f, 1, 2};
    Field field = makeField(setup), reference = made(kCpu.makeField(context, setup));
    ASSERT_TRUE(field.update(randomData(setup, 20)));
    ASSERT_TRUE(reference.update(randomData(setup, 20)));
    const std::vector<FieldQuery> queries = randomPoints(1500, 6);
    const auto got = ask(field, queries), want = ask(reference, queries);
    double sum = 0, differs = 0;
    for (std::size_t i = 0; i < got.size(); ++i) {
        sum += want[i].x;
        differs += std::abs(got[i].x - want[i].x);
        // Alone as in a batch.
        if (i % 100 == 0) {
            EXPECT_EQ(field.irradiance(queries[i]), got[i]) << i;
        }
    }
    EXPECT_LT(differs, 1e-3 * sum);
}

TEST_P(BackendVolumeBlend, followingHasADeadBandAndRefusesWhatCannotBe) {
    const VolumeDesc window = tracking({.origin = glm::vec3(-1), .spacing = glm::vec3(0.5f), .counts = {5, 5, 5}});
    Field field = lit(setupOf({kLevel, window}));
    // Trembles on the seam of two cells: one leap at most.
    int leaps = 0;
    for (int i = 0; i < 20; ++i) {
        const VolumeDesc before = field.control().place(1);
        ASSERT_TRUE(field.followCamera({0.25f + (i % 2 == 0 ? 0.1f : -0.1f), 0, 0}));
        leaps += field.control().place(1) == before ? 0 : 1;
    }
    EXPECT_LE(leaps, 1);
    ASSERT_TRUE(field.followCamera({3, 0, -7}));
    const VolumeDesc there = field.control().place(1);
    EXPECT_EQ(there.origin, glm::vec3(2, -1, -8));
    EXPECT_EQ(field.control().place(0), kLevel) << "tracks no camera";
    EXPECT_EQ(field.control().settings().camera, glm::vec3(3, 0, -7));
    const float bad = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(field.followCamera({0, bad, 0}).error().code, ErrorCode::invalidArgument);
    EXPECT_EQ(field.followCamera({0, 1e9f, 0}).error().code, ErrorCode::invalidArgument) << "too far to count cells";
    EXPECT_EQ(field.control().place(1), there);
    EXPECT_EQ(field.control().settings().camera, glm::vec3(3, 0, -7));
}

}  // namespace
}  // namespace probegi::test

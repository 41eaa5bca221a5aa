// FieldRules::paper: a query is what sections 2.2 and 4.1 of the DDGI paper say and nothing else, on every backend. The
// formulas are evaluated here a second time, in doubles, from what the probes store.
#include <algorithm>
#include <array>
#include <cmath>

#include "backend/every_backend.h"
#include "field/layout.h"
#include "support/field_setup.h"
#include "support/probes.h"

namespace probegi::test {
namespace {

constexpr double kPi = 3.14159265358979;

FieldSetup paperDesc() {
    FieldSetup desc = smallDesc();
    desc.rules = FieldRules::paper;
    desc.visibilityExponent = 50;
    return desc;
}

glm::dvec3 twice(glm::vec3 v) {
    return {v.x, v.y, v.z};
}

/// max(variance / (variance + (d - mean)^2), 0)^3 with a floor, for a probe that looks from `probe` at `point`.
double visibility(const Field& field, int index, glm::dvec3 probe, glm::dvec3 point) {
    const glm::dvec3 way = point - probe;
    const double distance = glm::length(way);
    const glm::vec2 moments = probeDistanceMoments(field, index, glm::vec3(way / distance));
    const double mean = moments.x, variance = std::abs(double(moments.y) - mean * mean);
    if (distance <= mean) return 1;
    const double bound = variance / (variance + (distance - mean) * (distance - mean));
    return std::max(bound * bound * bound, 0.05);
}

/// Section 2.2: the eight probes around the point itself, each by trilinear weight, facing and visibility.
glm::dvec3 paperIrradiance(const Field& field, const FieldQuery& query) {
    const VolumeDesc& grid = field.desc().volumes[0];
    const glm::dvec3 last = twice(grid.origin) + twice(grid.spacing) * glm::dvec3(grid.counts - 1);
    const glm::dvec3 position = glm::clamp(twice(query.position), twice(grid.origin), last);
    const double minSpacing = std::min({grid.spacing.x, grid.spacing.y, grid.spacing.z});
    const glm::dvec3 biased = position + (0.2 * twice(query.normal) + 0.8 * twice(query.toViewer)) *
                                             (0.75 * minSpacing * double(field.control().settings().selfShadowBias));
    const glm::dvec3 local = (position - twice(grid.origin)) / twice(grid.spacing);
    const glm::dvec3 base = glm::clamp(glm::floor(local), glm::dvec3(0), glm::dvec3(grid.counts - 2));
    glm::dvec3 sum(0);
    double weights = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 offset(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
        const glm::ivec3 cell(base + offset);
        const int probe = cell.x + grid.counts.x * (cell.y + grid.counts.y * cell.z);
        const glm::dvec3 place = twice(probePosition(grid, probe));
        double trilinear = 1;
        for (int axis = 0; axis < 3; ++axis) {
            const double alpha = local[axis] - base[axis];
            trilinear *= std::max(0.001, offset[axis] > 0 ? alpha : 1 - alpha);
        }
        // A probe has no side within a thousandth of the spacing: points outside the grid are moved onto probes.
        const double away = glm::length(place - position) + 0.001 * minSpacing;
        const double wrap = (glm::dot(place - position, twice(query.normal)) / away + 1) / 2;
        const double facing = wrap * wrap + 0.2;
        const double seen =
            field.control().settings().guard == LeakGuard::none ? 1 : visibility(field, probe, place, biased);
        double weight = facing * seen;
        if (weight < 0.2) weight = weight * weight * weight / 0.04;
        weight *= trilinear;
        const glm::dvec3 mean = twice(probeIrradiance(field, probe, query.normal)) / kPi;
        sum += weight * glm::sqrt(mean);
        weights += weight;
    }
    sum /= weights;
    return sum * sum * kPi;
}

class PaperRules : public EveryBackend {};
PROBEGI_ON_EVERY_BACKEND(PaperRules);

TEST_P(PaperRules, answersAreTheFormulas) {
    for (const LeakGuard guard : {LeakGuard::none, LeakGuard::moments}) {
        FieldSetup desc = paperDesc();
        desc.guard = guard;
        Field field = makeField(desc);
        for (std::uint32_t frame = 0; frame < 2; ++frame) ASSERT_TRUE(field.update(randomData(desc, 70 + frame)));
        const auto queries = randomQueries(1000);
        const auto answers = ask(field, queries);
        int far = 0;
        for (std::size_t i = 0; i < queries.size(); ++i) {
            const glm::dvec3 truth = paperIrradiance(field, queries[i]);
            for (int c = 0; c < 3; ++c) {
                ASSERT_NEAR(answers[i][c] / truth[c], 1.0, 2e-2) << i;
                far += std::abs(answers[i][c] / truth[c] - 1.0) > 1e-3 ? 1 : 0;
            }
        }
        // Filters of GPUs have 8 bits of fraction.
        EXPECT_LE(far, 1000 * 3 / 20);
        EXPECT_EQ(field.fallbackQueries(), 0u);
    }
}

// No rule for probes in walls, no wider search: the weights' floors decide.
TEST_P(PaperRules, probesInWallsAnswer) {
    const FieldSetup desc = paperDesc();
    Field field = makeField(desc);
    std::vector<RayDatum> data = constantData(desc, glm::vec3(1.0f), 1.0f);
    for (std::size_t i = 0; i < data.size(); ++i)
        if (i % std::size_t(desc.raysPerProbe) % 2 == 0) data[i].distance = -0.1f;  // half of all rays see backfaces
    for (int frame = 0; frame < 3; ++frame) ASSERT_TRUE(field.update(data));
    for (const glm::vec3& e : ask(field, randomQueries(200))) EXPECT_GT(e.x, 0.5f);
    EXPECT_EQ(field.fallbackQueries(), 0u);

    FieldSetup measured = desc;
    measured.rules = FieldRules::measured;
    Field other = makeField(measured);
    for (int frame = 0; frame < 3; ++frame) ASSERT_TRUE(other.update(data));
    for (const glm::vec3& e : ask(other, randomQueries(200))) EXPECT_EQ(e, glm::vec3(0.0f));
}

TEST_P(PaperRules, aConstantFieldIsConstant) {
    Field field = makeField(paperDesc());
    ASSERT_TRUE(field.update(constantData(field.desc(), {1, 32, 0}, 0.4f)));
    for (const glm::vec3& e : ask(field, randomQueries(500))) {
        EXPECT_NEAR(e.x, kPi, 1e-3);
        EXPECT_NEAR(e.y, 32 * kPi, 3e-2);
        EXPECT_EQ(e.z, 0.0f);
    }
}

}  // namespace
}  // namespace probegi::test

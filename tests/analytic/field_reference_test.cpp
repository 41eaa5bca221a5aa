#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include "analytic/field_scene.h"
#include "probegi/io.h"
#include "probegi/reference.h"
#include "support/scenes.h"

namespace probegi {
namespace {

constexpr glm::vec3 kAxes[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};

double luminance(glm::vec3 e) {
    return 0.2126 * e.x + 0.7152 * e.y + 0.0722 * e.z;
}

// Field over reference at up to `limit` probes in the open: luminance of E summed over the six axis directions. Dark
// probes, where a ratio means nothing, are left out.
std::vector<double> probeRatios(const test::FieldScene& s, std::size_t limit, int samples) {
    const VolumeDesc& grid = s.field.desc().volumes[0];
    std::vector<int> probes;
    for (int i = 0; i < probeCount(grid); ++i) {
        const glm::vec3 p = probePosition(grid, i);
        const bool inScene =
            glm::all(glm::greaterThan(p, s.pose.bounds.lower)) && glm::all(glm::lessThan(p, s.pose.bounds.upper));
        if (inScene && s.field.probeBackfaceShare(i) < 0.05f) probes.push_back(i);
    }
    const std::size_t step = std::max<std::size_t>(1, probes.size() / limit);
    std::vector<FieldQuery> queries;
    std::vector<double> fieldLight;
    for (std::size_t k = 0; k < probes.size(); k += step) {
        double sum = 0;
        for (const glm::vec3 n : kAxes) {
            queries.push_back({probePosition(grid, probes[k]), n, n});
            sum += luminance(s.field.probeIrradiance(probes[k], n));
        }
        fieldLight.push_back(sum);
    }
    const PathTracer reference = std::move(*PathTracer::create(s.context, s.scene, s.pose, *s.tracer, s.lighting));
    const auto truth = *reference.irradiance(queries, samples);
    std::vector<double> trueLight(fieldLight.size());
    for (std::size_t i = 0; i < truth.size(); ++i) trueLight[i / 6] += luminance(truth[i].mean);
    const double brightest = *std::max_element(trueLight.begin(), trueLight.end());
    std::vector<double> ratios;
    for (std::size_t k = 0; k < fieldLight.size(); ++k)
        if (trueLight[k] > 0.01 * brightest) ratios.push_back(fieldLight[k] / trueLight[k]);
    std::sort(ratios.begin(), ratios.end());
    return ratios;
}

void expectMedianNearOne(const test::FieldScene& s, std::size_t limit, int samples, double bound) {
    const std::vector<double> ratios = probeRatios(s, limit, samples);
    ASSERT_GE(ratios.size(), 20u);
    const double median = ratios[ratios.size() / 2];
    testing::Test::RecordProperty("median", std::to_string(median));
    EXPECT_NEAR(median, 1.0, bound);
}

TEST(FieldReference, cornellProbesHoldWhatThePathTracerFinds) {
    test::FieldScene s("cornell", {}, {.targetProbes = 1000});
    ASSERT_TRUE(s.field.converge(*s.tracer, s.lighting, 0.005f, 96));
    expectMedianNearOne(s, 160, 600, 0.025);  // measured 0.982, 195 probes
}

TEST(FieldReference, sponzaProbesHoldWhatThePathTracerFinds) {
    auto loaded = loadScene(test::scenesFolder() / "sponza" / "sponza.glb");
    ASSERT_TRUE(loaded) << loaded.error().message;
    loaded->scene.sky.radiance = {0.6f, 0.8f, 1.2f};
    const VolumeDesc grid = *placeVolume(poseAt(loaded->scene).bounds, {.targetProbes = 1500});
    test::FieldScene s(std::move(loaded->scene), grid);
    ASSERT_TRUE(s.field.converge(*s.tracer, s.lighting, 0.01f, 48));
    expectMedianNearOne(s, 320, 300, 0.045);  // measured 0.965, 71 probes: the grid is coarse
}

}  // namespace
}  // namespace probegi

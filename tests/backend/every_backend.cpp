#include "backend/every_backend.h"

#include <cmath>

#include "field/layout.h"
#include "kernels/probe/octahedral_texel.h"
#include "kernels/random.h"
#include "support/field_setup.h"
#include "support/probes.h"

namespace probegi::test {

FieldSetup smallDesc() {
    FieldSetup d;
    d.volumes[0] = {{-1, -1, -1}, {0.5f, 1.0f, 0.7f}, {6, 4, 5}};
    d.raysPerProbe = 64;
    return d;
}

std::vector<RayDatum> constantData(const FieldDesc& desc, glm::vec3 radiance, float distance) {
    return std::vector<RayDatum>(std::size_t(probeCount(desc)) * std::size_t(desc.raysPerProbe), {radiance, distance});
}

std::vector<FixedRayDatum> randomFixedData(const FieldDesc& desc, std::uint32_t seed, float scale) {
    std::vector<FixedRayDatum> data;
    std::uint32_t state = seed;
    for (int i = 0; i < probeCount(desc) * desc.fixedRays; ++i) {
        const float light = std::exp(4 * kernels::nextRandom(state) - 2);
        data.push_back({scale * light, 0.3f * scale * light, 3.0f * kernels::nextRandom(state)});
    }
    return data;
}

std::vector<RayDatum> randomData(const FieldDesc& desc, std::uint32_t seed) {
    std::vector<RayDatum> data = constantData(desc, glm::vec3(0.0f), 0.0f);
    std::uint32_t state = seed;
    for (std::size_t i = 0; i < data.size(); ++i) {
        data[i].distance = 3.0f * kernels::nextRandom(state);
        for (int c = 0; c < 3; ++c) data[i].radiance[c] = std::exp(4 * kernels::nextRandom(state) - 2);
        if (i % 7 == 0) data[i].distance = -data[i].distance;
    }
    return data;
}

std::vector<FieldQuery> randomQueries(int count, std::uint32_t seed) {
    std::uint32_t state = seed;
    const auto r = [&] { return 2 * kernels::nextRandom(state) - 1; };
    const auto vector = [&] {
        const float x = r(), y = r(), z = r();
        return glm::vec3(x, y, z);
    };
    std::vector<FieldQuery> queries;
    for (int i = 0; i < count; ++i) {
        const glm::vec3 position = 4.0f * vector(), n = glm::normalize(vector() + 1e-3f);
        queries.push_back({position, n, glm::normalize(n + 0.9f * vector())});
    }
    return queries;
}

glm::vec3 texelDirection(int texel, int size) {
    return kernels::octTexelDirection(texel % size, texel / size, size);
}

float storedIrradiance(const Field& field, int probe, int texel, int channel) {
    const glm::vec3 e = probeIrradiance(field, probe, texelDirection(texel, field.desc().irradianceTexels));
    return std::pow(e[channel] / kernels::kPi, 0.2f);
}

namespace {

/// Distance of two stored halves in steps of the larger.
double halfSteps(float a, float b) {
    const double larger = std::max({std::abs(a), std::abs(b), 6.2e-5f});
    return std::abs(double(a) - b) / std::exp2(std::floor(std::log2(larger)) - 10);
}

void compareIrradiance(const Field& a, const Field& b, int probe, AtlasDifference& difference, int& differing) {
    const int size = a.desc().irradianceTexels;
    for (int texel = 0; texel < size * size; ++texel) {
        const glm::vec3 n = texelDirection(texel, size);
        const glm::vec3 ea = probeIrradiance(a, probe, n), eb = probeIrradiance(b, probe, n);
        for (int c = 0; c < 3; ++c) {
            const double steps = halfSteps(std::pow(ea[c] / kernels::kPi, 0.2f), std::pow(eb[c] / kernels::kPi, 0.2f));
            // A comparison with not-a-number must not pass.
            difference.worstIrradiance = steps <= difference.worstIrradiance ? difference.worstIrradiance : steps;
            differing += steps <= 0.5 ? 0 : 1;
        }
    }
}

void compareVisibility(const Field& a, const Field& b, int probe, AtlasDifference& difference, int& differing) {
    const int size = a.desc().visibilityTexels;
    const float farthest = visibilityRange(a.desc().volumes[0]);
    const glm::vec2 scale = 65535.0f / glm::vec2(farthest, farthest * farthest);
    for (int texel = 0; texel < size * size; ++texel) {
        const glm::vec3 d = texelDirection(texel, size);
        const glm::vec2 steps = glm::abs(probeDistanceMoments(a, probe, d) - probeDistanceMoments(b, probe, d)) * scale;
        for (int c = 0; c < 2; ++c) {
            difference.worstVisibility =
                steps[c] <= difference.worstVisibility ? difference.worstVisibility : double(steps[c]);
            differing += steps[c] <= 0.5f ? 0 : 1;
        }
    }
}

}  // namespace

AtlasDifference compareAtlases(const Field& a, const Field& b) {
    AtlasDifference difference;
    const int probes = probeCount(a.desc());
    int irradiance = 0, visibility = 0;
    for (int probe = 0; probe < probes; ++probe) {
        compareIrradiance(a, b, probe, difference, irradiance);
        compareVisibility(a, b, probe, difference, visibility);
        const double share = std::abs(double(probeBackfaceShare(a, probe)) - probeBackfaceShare(b, probe));
        difference.worstBackfaceShare = share <= difference.worstBackfaceShare ? difference.worstBackfaceShare : share;
    }
    const FieldLayout layout(a.desc());
    difference.differingIrradiance = irradiance / (3.0 * double(layout.irradianceTexels) * probes);
    difference.differingVisibility = visibility / (2.0 * double(layout.visibilityTexels) * probes);
    return difference;
}

void expectSameAtlases(const Field& field, const Field& reference) {
    const AtlasDifference difference = compareAtlases(field, reference);
    // A texel is read back through a bilinear footprint and a fifth root, which cost a few thousandths of a step.
    EXPECT_LE(difference.worstIrradiance, 1.05);
    EXPECT_LE(difference.worstVisibility, 1.05);
    EXPECT_LE(difference.differingIrradiance, 0.01);
    EXPECT_LE(difference.differingVisibility, 0.05);
    EXPECT_LE(difference.worstBackfaceShare, 1e-6);
    testing::Test::RecordProperty("differingIrradiance", std::to_string(difference.differingIrradiance));
    testing::Test::RecordProperty("differingVisibility", std::to_string(difference.differingVisibility));
}

}  // namespace probegi::test

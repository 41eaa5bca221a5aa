// Rays to atlases: against eq. 1 as printed, and every backend against the CPU's.
#include <cmath>
#include <limits>

#include "backend/every_backend.h"
#include "field/layout.h"
#include "support/field_setup.h"
#include "support/probes.h"

namespace probegi::test {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr double kPi = 3.14159265358979;

class BackendBlend : public EveryBackend {};
PROBEGI_ON_EVERY_BACKEND(BackendBlend);

FieldSetup descWith(BackfaceRule rule) {
    FieldSetup desc;
    desc.volumes = {{{0, 0, 0}, {1, 1.5f, 2}, {3, 3, 2}}};
    desc.raysPerProbe = 100;
    desc.backfaceRule = rule;
    return desc;
}

// Eq. 1 as printed, one texel at a time.
glm::dvec3 directMean(const Field& field, std::span<const glm::vec3> rays, std::span<const RayDatum> data, int texel) {
    const glm::vec3 n = texelDirection(texel, field.desc().irradianceTexels);
    glm::dvec3 sum(0.0);
    double weights = 0;
    for (std::size_t ray = 0; ray < rays.size(); ++ray) {
        const bool backface = data[ray].distance < 0;
        if (backface && field.control().settings().backfaceRule == BackfaceRule::excluded) continue;
        const double w = std::max(0.0, double(glm::dot(n, rays[ray])));
        if (!backface) sum += w * glm::dvec3(data[ray].radiance);
        weights += w;
    }
    return sum / weights;
}

glm::dvec2 directMoments(const Field& field, std::span<const glm::vec3> rays, std::span<const RayDatum> data,
                         int texel) {
    const glm::vec3 n = texelDirection(texel, field.desc().visibilityTexels);
    const double farthest = visibilityRange(field.desc().volumes[0]);
    glm::dvec2 sum(0.0);
    double weights = 0;
    for (std::size_t ray = 0; ray < rays.size(); ++ray) {
        const double w = std::pow(std::max(0.0, double(glm::dot(n, rays[ray]))),
                                  double(field.control().settings().visibilityExponent));
        const double t = data[ray].distance;
        const double d = std::min(t < 0 ? -0.2 * t : t, farthest);
        sum += w * glm::dvec2(d, d * d);
        weights += w;
    }
    return sum / weights;
}

TEST_P(BackendBlend, equalsTheDirectSum) {
    for (const BackfaceRule rule : {BackfaceRule::zeroSample, BackfaceRule::excluded}) {
        Field field = makeField(descWith(rule));
        const FieldLayout layout(field.desc());
        const std::vector<glm::vec3> rays(field.control().rayDirections().begin(),
                                          field.control().rayDirections().end());
        const auto data = randomData(field.desc(), 9);
        ASSERT_TRUE(field.update(data));
        for (int probe = 0; probe < int(layout.probes); ++probe) {
            const auto own = std::span(data).subspan(std::size_t(probe) * layout.rays, layout.rays);
            for (int texel = 0; texel < 64; ++texel) {
                const glm::dvec3 mean = directMean(field, rays, own, texel);
                for (int c = 0; c < 3; ++c)  // one step of a half float: 2^-10
                    EXPECT_NEAR(storedIrradiance(field, probe, texel, c) / std::pow(mean[c], 0.2), 1.0,
                                1.0 / 1024 + 1e-5);
            }
            const float farthest = visibilityRange(field.desc().volumes[0]);
            const glm::dvec2 step = glm::dvec2(farthest, farthest * farthest) / 65535.0;
            for (int texel = 0; texel < 256; ++texel) {
                const glm::dvec2 truth = directMoments(field, rays, own, texel);
                const glm::vec2 got = probeDistanceMoments(field, probe, texelDirection(texel, 16));
                for (int c = 0; c < 2; ++c) EXPECT_NEAR(got[c], truth[c], 1.2 * step[c]);
            }
        }
    }
}

// Several updates, so that hysteresis, its thresholds and the dither of every frame count.
TEST_P(BackendBlend, sameRaysInSameAtlasesOut) {
    for (const FieldRules rules : {FieldRules::measured, FieldRules::paper})
        for (const BackfaceRule rule : {BackfaceRule::zeroSample, BackfaceRule::excluded}) {
            FieldSetup desc = descWith(rule);
            desc.rules = rules;
            Field field = makeField(desc), reference = made(kCpu.makeField(context, desc));
            for (std::uint32_t frame = 0; frame < 4; ++frame) {
                const auto data = randomData(field.desc(), 20 + frame);
                ASSERT_TRUE(field.update(data));
                ASSERT_TRUE(reference.update(data));
                for (std::size_t ray = 0; ray < 100; ++ray)
                    ASSERT_EQ(field.control().rayDirections()[ray], reference.control().rayDirections()[ray]);
            }
            expectSameAtlases(field, reference);
        }
}

// With fixed rays: their light jumps, drifts and stays, so that windows shrink and grow.
TEST_P(BackendBlend, sameAtlasesWithFixedRays) {
    for (const int fixedRays : {32, 7}) {
        FieldSetup desc = descWith(BackfaceRule::zeroSample);
        desc.fixedRays = fixedRays;
        Field field = makeField(desc), reference = made(kCpu.makeField(context, desc));
        for (std::uint32_t frame = 0; frame < 8; ++frame) {
            const auto data = randomData(desc, 60 + frame);
            const auto fixedData = randomFixedData(desc, 3, frame < 4 ? 1.0f : 0.5f + 0.01f * float(frame));
            ASSERT_TRUE(field.update(data, fixedData));
            ASSERT_TRUE(reference.update(data, fixedData));
        }
        expectSameAtlases(field, reference);
    }
}

TEST_P(BackendBlend, sameAtlasesForAllMapSizes) {
    for (const int size : {4, 6, 32}) {
        FieldSetup desc = descWith(BackfaceRule::zeroSample);
        desc.irradianceTexels = size;
        desc.visibilityTexels = 2 * size;
        desc.raysPerProbe = 37;
        Field field = makeField(desc), reference = made(kCpu.makeField(context, desc));
        for (std::uint32_t frame = 0; frame < 2; ++frame) {
            ASSERT_TRUE(field.update(randomData(desc, 30 + frame)));
            ASSERT_TRUE(reference.update(randomData(desc, 30 + frame)));
        }
        expectSameAtlases(field, reference);
    }
}

// More rays than a pass keeps at hand at a time, and a number that fills no last piece.
TEST_P(BackendBlend, sameAtlasesForManyRays) {
    FieldSetup desc = descWith(BackfaceRule::excluded);
    desc.raysPerProbe = 701;
    Field field = makeField(desc), reference = made(kCpu.makeField(context, desc));
    ASSERT_TRUE(field.update(randomData(desc, 50)));
    ASSERT_TRUE(reference.update(randomData(desc, 50)));
    expectSameAtlases(field, reference);
}

// What is no light and no distance counts as black and as a miss.
TEST_P(BackendBlend, badRadianceAndDistanceNeverEnterTheAtlas) {
    Field good = makeField(descWith(BackfaceRule::zeroSample)), bad = makeField(descWith(BackfaceRule::zeroSample));
    for (std::uint32_t frame = 0; frame < 2; ++frame) {
        auto clean = randomData(good.desc(), 40 + frame);
        auto poisoned = clean;
        for (std::size_t i = 0; i < clean.size(); i += 11) {
            clean[i] = {glm::vec3(0.0f), 1e30f};
            const float light[] = {kNan, -kNan, kInfinity, -kInfinity, -1.0f, -1e30f, 1e30f, 3e38f};
            const float far[] = {kNan, -kNan, kInfinity, 1e27f, 3e38f};
            poisoned[i] = {glm::vec3(light[i / 11 % 8], light[i / 88 % 8], light[(i / 11 + 3) % 8]), far[i / 11 % 5]};
        }
        ASSERT_TRUE(good.update(clean));
        ASSERT_TRUE(bad.update(poisoned));
    }
    const AtlasDifference difference = compareAtlases(good, bad);
    EXPECT_EQ(difference.worstIrradiance, 0.0);
    EXPECT_EQ(difference.worstVisibility, 0.0);
    EXPECT_EQ(difference.worstBackfaceShare, 0.0);
}

// The sign of not-a-number says nothing: 0 / 0 has either.
TEST_P(BackendBlend, notANumberIsNoBackface) {
    Field field = makeField(descWith(BackfaceRule::zeroSample));
    ASSERT_TRUE(field.update(constantData(field.desc(), glm::vec3(2.0f), -kNan)));
    EXPECT_EQ(probeBackfaceShare(field, 7), 0.0f);
    EXPECT_NEAR(probeIrradiance(field, 7, {0, 1, 0}).y, 2 * kPi, 0.02 * kPi);
}

// The largest radiance that is let in fits into the format, and so does the smallest.
TEST_P(BackendBlend, extremesOfBrightnessAreStored) {
    for (const float radiance : {1e-9f, 1e-3f, 1e3f, 1e12f}) {
        Field field = makeField(descWith(BackfaceRule::zeroSample));
        ASSERT_TRUE(field.update(constantData(field.desc(), glm::vec3(radiance), 1.0f)));
        EXPECT_NEAR(probeIrradiance(field, 3, {0.6f, 0, 0.8f}).x / (kPi * radiance), 1.0, 0.006);
    }
}

TEST_P(BackendBlend, allRaysOnBackfacesAreDarkUnderBothRules) {
    for (const BackfaceRule rule : {BackfaceRule::zeroSample, BackfaceRule::excluded}) {
        Field field = makeField(descWith(rule));
        ASSERT_TRUE(field.update(constantData(field.desc(), glm::vec3(5.0f), -0.5f)));
        for (int probe = 0; probe < probeCount(field.desc()); ++probe) {
            EXPECT_EQ(probeIrradiance(field, probe, {0, 1, 0}), glm::vec3(0.0f));
            EXPECT_EQ(probeBackfaceShare(field, probe), 1.0f);
        }
    }
}

// Closed form: light from one narrow direction w reaches texel n with max(0, n.w) / sum, so that ratios of texels are
// ratios of cosines.
TEST_P(BackendBlend, oneBrightDirectionGivesAClampedCosine) {
    Field field = makeField(descWith(BackfaceRule::zeroSample));
    const std::size_t bright = 42, rays = 100;
    const glm::vec3 direction = field.control().rayDirections()[bright];
    auto data = constantData(field.desc(), glm::vec3(0.0f), 1.0f);
    for (std::size_t i = bright; i < data.size(); i += rays) data[i].radiance = glm::vec3(50.0f);
    ASSERT_TRUE(field.update(data));
    for (int texel = 0; texel < 64; ++texel) {
        const glm::vec3 n = texelDirection(texel, 8);
        // The weights of a uniform set sum to N / 4.
        const double expected = kPi * 50 * std::max(0.0f, glm::dot(n, direction)) / (double(rays) / 4);
        EXPECT_NEAR(probeIrradiance(field, 3, n).x, expected, 0.02 * expected + 1e-4);
    }
}

TEST_P(BackendBlend, hysteresisKeepsItsShareOfTheOldValue) {
    FieldSetup desc = descWith(BackfaceRule::zeroSample);
    desc.rules = FieldRules::paper;
    desc.significantChange = desc.newDistribution = 0;
    desc.hysteresis = 0.75f;
    desc.visibilityHysteresis = 0.5f;
    Field field = makeField(desc);
    ASSERT_TRUE(field.update(constantData(desc, glm::vec3(1.0f), 1.0f)));
    ASSERT_TRUE(field.update(constantData(desc, glm::vec3(32.0f), 2.0f)));  // encoded: 1 and 2
    EXPECT_NEAR(storedIrradiance(field, 7, 20, 0), 0.75f * 1 + 0.25f * 2, 2e-3f);
    EXPECT_NEAR(probeDistanceMoments(field, 5, {0, 0, 1}).x, 1.5f, 1e-3f);
    EXPECT_NEAR(probeDistanceMoments(field, 5, {0, 0, 1}).y, 2.5f, 1e-3f);
}

// Few rays and a narrow lobe leave texels between the rays. What the nearest ray of one update says of them counts for
// next to nothing; by the paper's rules for as much as a ray that hits the texel.
TEST_P(BackendBlend, distancesOfRaysThatPassATexelByHardlyCount) {
    for (const FieldRules rules : {FieldRules::measured, FieldRules::paper}) {
        FieldSetup desc = descWith(BackfaceRule::zeroSample);
        desc.rules = rules;
        desc.raysPerProbe = 16;
        desc.fixedRays = 0;
        desc.visibilityExponent = 50;
        desc.visibilityHysteresis = 0.8f;
        Field field = makeField(desc);
        for (int i = 0; i < 40; ++i) ASSERT_TRUE(field.update(constantData(desc, glm::vec3(1.0f), 1.0f)));
        const std::vector<glm::vec3> rays(field.control().rayDirections().begin(),
                                          field.control().rayDirections().end());
        ASSERT_TRUE(field.update(constantData(desc, glm::vec3(1.0f), 2.0f)));
        int near = 0, far = 0;
        for (int texel = 0; texel < 256; ++texel) {
            const glm::vec3 n = texelDirection(texel, 16);
            float cosine = -1;
            for (const glm::vec3& ray : rays) cosine = std::max(cosine, glm::dot(n, ray));
            const float moved = probeDistanceMoments(field, 4, n).x - 1;
            if (rules == FieldRules::paper) {
                EXPECT_NEAR(moved, 0.2f, 2e-3f);
            } else if (cosine < 0.93f) {
                EXPECT_LT(moved, 0.05f) << cosine;
                ++far;
            } else if (cosine > 0.995f) {
                EXPECT_GT(moved, 0.5f) << cosine;
                ++near;
            }
        }
        if (rules == FieldRules::measured) {
            EXPECT_TRUE(near > 5 && far > 10) << near << " and " << far;
        }
    }
}

}  // namespace
}  // namespace probegi::test

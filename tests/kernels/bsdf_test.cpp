#include "kernels/shade/bsdf.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "reference/random_stream.h"
#include "reference/running_stats.h"

namespace probegi {
namespace {

using namespace kernels;

constexpr double kTau = 6.283185307179586;

vec3 direction(double cosTheta, double phi) {
    const double s = std::sqrt(1 - cosTheta * cosTheta);
    return {float(s * std::cos(phi)), float(s * std::sin(phi)), float(cosTheta)};
}

/// View directions from normal to grazing.
const std::vector<vec3> kViews = {direction(1, 0), direction(0.9, 1), direction(0.5, 2), direction(0.1, 3)};

/// Integral of `value` over the hemisphere, by quadrature in cosine and angle.
template <class F>
double integrate(const F& value, int steps = 400) {
    double sum = 0;
    for (int j = 0; j < steps; ++j)
        for (int i = 0; i < 2 * steps; ++i)
            sum += double(value(direction((j + 0.5) / steps, (i + 0.5) / (2 * steps) * kTau)));
    return sum * kTau / (2.0 * steps * steps);
}

TEST(DiffuseOnly, isLambertOfTheBaseColour) {
    const Bsdf b = makeBsdf(vec3(0.8f, 0.5f, 0.1f), 1.0f, 0.2f, true);
    for (const vec3& wo : kViews) {
        EXPECT_NEAR(integrate([&](vec3 wi) { return evalBsdf(b, wo, wi).x; }), 0.8, 1e-4);
        Random random(1, 1);
        const vec3 wi = sampleBsdf(b, wo, random.nextPair(), random.next());
        const vec3 weight = evalBsdf(b, wo, wi) / pdfBsdf(b, wo, wi);
        EXPECT_NEAR(weight.x, 0.8f, 1e-6f);
        EXPECT_NEAR(weight.z, 0.1f, 1e-6f);
    }
}

TEST(Bsdf, isReciprocal) {
    for (const float roughness : {0.2f, 0.5f, 1.0f})
        for (const float metallic : {0.0f, 0.5f, 1.0f}) {
            const Bsdf b = makeBsdf(vec3(0.9f, 0.6f, 0.2f), metallic, roughness, false);
            for (const vec3& x : kViews)
                for (const vec3& y : kViews) {
                    const vec3 there = evalBsdf(b, x, y) / y.z, back = evalBsdf(b, y, x) / x.z;
                    for (int c = 0; c < 3; ++c) EXPECT_NEAR(there[c], back[c], 1e-4f * (1 + std::abs(there[c])));
                }
        }
}

TEST(Bsdf, nothingBelowTheSurface) {
    const Bsdf b = makeBsdf(vec3(1.0f), 0.5f, 0.5f, false);
    EXPECT_EQ(evalBsdf(b, vec3(0, 0, 1), direction(-0.5, 0)), vec3(0.0f));
    EXPECT_EQ(pdfBsdf(b, vec3(0, 0, 1), direction(-0.5, 0)), 0.0f);
}

/// White furnace of the coat alone: with a reflectance of 1 it reflects at most what arrives, and nearly all of it if
/// it is smooth. (Rough coats lose light that bounces between facets, which glTF's model leaves out.)
TEST(GgxCoat, losesButNeverMakesEnergy) {
    for (const float roughness : {0.25f, 0.5f, 0.75f, 1.0f}) {
        const Bsdf b = makeBsdf(vec3(1.0f), 1.0f, roughness, false);
        for (const vec3& wo : kViews) {
            const double energy = integrate([&](vec3 wi) { return evalBsdf(b, wo, wi).x; });
            EXPECT_LE(energy, 1.002) << roughness << ' ' << wo.z;
            EXPECT_GE(energy, roughness < 0.3f ? 0.85 : 0.3) << roughness << ' ' << wo.z;
        }
    }
}

/// D is a distribution of facets: its projected area is 1 (Heitz 2014, eq. 9).
TEST(GgxCoat, projectedFacetAreaIsOne) {
    for (const float alpha : {0.2f, 0.5f, 1.0f})
        EXPECT_NEAR(integrate([&](vec3 h) { return ggxDistribution(h, alpha) * h.z; }, 800), 1.0, 0.005) << alpha;
}

class Sampling : public testing::TestWithParam<std::tuple<float, float>> {
protected:
    Bsdf bsdf() const {
        return makeBsdf(vec3(0.7f, 0.5f, 0.3f), std::get<0>(GetParam()), std::get<1>(GetParam()), false);
    }
};

/// In bins of equal solid angle, the share of samples is the integral of the density, by chi-square; the share below
/// the surface is what the density's integral lacks to 1.
TEST_P(Sampling, densityIsThatOfTheSamples) {
    constexpr int kRows = 5, kColumns = 8, kSamples = 20000, kFine = 24;
    for (const vec3& wo : kViews) {
        std::vector<double> expected(kRows * kColumns, 0.0), counted(kRows * kColumns, 0.0);
        const Bsdf b = bsdf();
        for (int row = 0; row < kRows * kFine; ++row)
            for (int column = 0; column < kColumns * kFine; ++column) {
                const vec3 wi = direction((row + 0.5) / (kRows * kFine), (column + 0.5) / (kColumns * kFine) * kTau);
                expected[std::size_t(row / kFine * kColumns + column / kFine)] +=
                    double(pdfBsdf(b, wo, wi)) * kTau / (kRows * kColumns * kFine * kFine) * kSamples;
            }
        Random random(7, 9);
        double below = 0, above = 0;
        for (int i = 0; i < kSamples; ++i) {
            const vec3 wi = sampleBsdf(b, wo, random.nextPair(), random.next());
            if (!(wi.z > 0)) {
                ++below;
                continue;
            }
            const int row = std::min(int(wi.z * kRows), kRows - 1);
            const double phi = std::atan2(double(wi.y), double(wi.x));
            const int column = std::min(int((phi < 0 ? phi + kTau : phi) / kTau * kColumns), kColumns - 1);
            ++counted[std::size_t(row * kColumns + column)];
        }
        double chiSquare = 0;
        int bins = 0;
        for (std::size_t i = 0; i < expected.size(); ++i) {
            above += expected[i];
            if (expected[i] < 10) continue;
            chiSquare += std::pow(counted[i] - expected[i], 2) / expected[i];
            ++bins;
        }
        EXPECT_LT(chiSquare, bins + 4 * std::sqrt(2.0 * bins) + 4) << wo.z;
        EXPECT_NEAR(above + below, kSamples, 4 * std::sqrt(double(kSamples)) * 0.5 + 1) << wo.z;
    }
}

/// The mean weight of samples is the albedo by quadrature.
TEST_P(Sampling, weightsAverageToTheAlbedo) {
    const Bsdf b = bsdf();
    for (const vec3& wo : kViews) {
        Random random(3, 5);
        RunningStats stats;
        for (int i = 0; i < 20000; ++i) {
            const vec3 wi = sampleBsdf(b, wo, random.nextPair(), random.next());
            const float pdf = pdfBsdf(b, wo, wi);
            stats.add(pdf > 0 ? glm::dvec3(evalBsdf(b, wo, wi) / pdf) : glm::dvec3(0.0));
        }
        const double truth = integrate([&](vec3 wi) { return evalBsdf(b, wo, wi).y; }, 300);
        EXPECT_NEAR(stats.mean.y, truth, 4 * stats.standardError().y + 2e-3 * truth) << wo.z;
    }
}

INSTANTIATE_TEST_SUITE_P(materials, Sampling,
                         testing::Combine(testing::Values(0.0f, 0.5f, 1.0f), testing::Values(0.4f, 0.7f, 1.0f)));

/// glTF 2.0, appendix B.3.5.
TEST(Bsdf, metalsHaveTheirColourInTheCoat) {
    const Bsdf b = makeBsdf(vec3(0.8f), 0.25f, 0.5f, false);
    EXPECT_FLOAT_EQ(b.diffuse.y, 0.75f * 0.8f);
    EXPECT_FLOAT_EQ(b.f0.y, 0.75f * 0.04f + 0.25f * 0.8f);
    EXPECT_FLOAT_EQ(b.alpha, 0.25f);
}

/// By energy, but if a material has both lobes, each gets at least a tenth of the samples.
TEST(Bsdf, lobesAreChosenByEnergy) {
    const auto probability = [](float base, float metallic, bool diffuseOnly) {
        return diffuseProbability(makeBsdf(vec3(base), metallic, 0.5f, diffuseOnly), vec3(0, 0, 1));
    };
    EXPECT_FLOAT_EQ(probability(1, 0, false), 0.9f);
    EXPECT_NEAR(probability(0.05f, 0, false), 0.05 * 0.96 / (0.05 * 0.96 + 0.04), 1e-6);
    EXPECT_FLOAT_EQ(probability(1e-4f, 0, false), 0.1f);
    EXPECT_EQ(probability(1, 1, false), 0.0f);
    EXPECT_EQ(probability(0.3f, 0, true), 1.0f);
}

/// The smoothest material possible: a mirror with finite values.
TEST(Bsdf, ofRoughnessZeroIsAMirror) {
    const Bsdf b = makeBsdf(vec3(1.0f), 1.0f, 0.0f, false);
    Random random(1, 1);
    for (const vec3& wo : kViews) {
        const vec3 wi = sampleBsdf(b, wo, random.nextPair(), random.next());
        const float pdf = pdfBsdf(b, wo, wi);
        ASSERT_TRUE(std::isfinite(pdf));
        EXPECT_NEAR(glm::length(wi - vec3(-wo.x, -wo.y, wo.z)), 0, 0.02);
        EXPECT_NEAR((evalBsdf(b, wo, wi) / pdf).x, 1.0f, 0.02f);
    }
}

}  // namespace
}  // namespace probegi

// The closed forms against quadrature over the BSDF itself, which the path tracer uses.
#include "kernels/shade/environment_brdf.h"

#include <gtest/gtest.h>

#include <cmath>

namespace probegi::kernels {
namespace {

constexpr int kSteps = 160;

struct Means {
    double energy = 0;   ///< of the lobe with F = 1
    double schlick = 0;  ///< its share with Schlick's term
};

// Over the lobe, by its visible normals: the weight of a direction is then G2 / G1 (Heitz 2018, eq. 19).
Means integrate(float cosO, float roughness) {
    const float alpha = std::max(roughness * roughness, kMinAlpha);
    const vec3 wo(std::sqrt(1 - cosO * cosO), 0, cosO);
    Means means;
    for (int j = 0; j < kSteps; ++j)
        for (int i = 0; i < kSteps; ++i) {
            const vec3 h = sampleGgxNormal(wo, alpha, vec2(float(i) + 0.5f, float(j) + 0.5f) / float(kSteps));
            const float product = dot(wo, h);
            const vec3 wi = h * (2 * product) - wo;
            if (!(wi.z > 0)) continue;
            const double own = ggxLambda(wo.z, alpha), other = ggxLambda(wi.z, alpha);
            const double weight = (1 + own) / (1 + own + other) / (double(kSteps) * kSteps);
            means.energy += weight;
            means.schlick += weight * std::pow(std::max(1.0 - double(product), 0.0), 5.0);
        }
    return means;
}

template <class Visit>
void forEachView(const Visit& visit) {
    for (const float roughness : {0.0f, 0.08f, 0.17f, 0.26f, 0.37f, 0.48f, 0.59f, 0.7f, 0.83f, 0.94f, 1.0f})
        for (const float cosO : {0.012f, 0.03f, 0.07f, 0.12f, 0.2f, 0.33f, 0.47f, 0.61f, 0.77f, 0.9f, 1.0f})
            visit(cosO, roughness, std::max(roughness * roughness, kMinAlpha));
}

TEST(EnvironmentBrdf, energyOfTheLobeIsTheQuadratures) {
    forEachView([](float cosO, float roughness, float alpha) {
        EXPECT_NEAR(lobeEnergy(cosO, alpha), integrate(cosO, roughness).energy, 0.014) << cosO << ' ' << roughness;
    });
}

TEST(EnvironmentBrdf, fresnelOfTheLobeIsTheQuadratures) {
    forEachView([](float cosO, float roughness, float alpha) {
        EXPECT_NEAR(lobeEnergy(cosO, alpha) * lobeSchlick(cosO, alpha), integrate(cosO, roughness).schlick, 0.02)
            << cosO << ' ' << roughness;
    });
}

// Both lobes of real materials by sampling evalLobes() itself.
TEST(EnvironmentBrdf, albedosAreThoseOfTheLobes) {
    for (const float metallic : {0.0f, 0.5f, 1.0f})
        for (const float cosO : {0.1f, 0.35f, 0.6f, 0.95f}) {
            const Bsdf b = makeBsdf({0.8f, 0.4f, 0.1f}, metallic, 0.8f, false);
            const vec3 wo(std::sqrt(1 - cosO * cosO), 0, cosO);
            vec3 diffuse(0.0f), specular(0.0f);
            for (int j = 0; j < kSteps; ++j)
                for (int i = 0; i < kSteps; ++i) {
                    const vec3 wi = sampleCosineHemisphere(vec2(float(i) + 0.5f, float(j) + 0.5f) / float(kSteps));
                    vec3 d, s;
                    evalLobes(b, wo, wi, d, s);
                    diffuse += d / (pdfCosineHemisphere(wi.z) * float(kSteps * kSteps));
                    specular += s / (pdfCosineHemisphere(wi.z) * float(kSteps * kSteps));
                }
            const LobeAlbedo albedo = lobeAlbedo(b, cosO);
            for (int c = 0; c < 3; ++c) {
                EXPECT_NEAR(albedo.diffuse[c], diffuse[c], 2e-3f) << metallic << ' ' << cosO;
                EXPECT_NEAR(albedo.specular[c], specular[c], 0.02f) << metallic << ' ' << cosO;
            }
        }
}

TEST(EnvironmentBrdf, mirrorsReflectAllAndMetalsNothingDiffuse) {
    const Bsdf mirror = makeBsdf(vec3(1.0f), 1.0f, 0.0f, false);
    for (const float cosO : {0.1f, 0.5f, 1.0f}) {
        EXPECT_NEAR(lobeAlbedo(mirror, cosO).specular.x, 1.0f, 0.013f);
        EXPECT_EQ(lobeAlbedo(mirror, cosO).diffuse, vec3(0.0f));
    }
}

// Of a lobe. (Both together may: glTF's diffuse lobe goes by the half vector, and a white dielectric sends up to 1.9
// times what arrives at grazing views, in the path tracer as well.)
TEST(EnvironmentBrdf, aLobeSendsNoMoreThanArrives) {
    forEachView([](float cosO, float roughness, float) {
        const LobeAlbedo metal = lobeAlbedo(makeBsdf(vec3(1.0f), 1.0f, roughness, false), cosO);
        EXPECT_LE(metal.specular.x, 1.0f) << cosO << ' ' << roughness;
        EXPECT_GE(metal.specular.x, 0.0f);
        EXPECT_LE(lobeAlbedo(makeBsdf(vec3(1.0f), 0.0f, roughness, false), cosO).diffuse.x, 1.0f);
    });
}

TEST(EnvironmentBrdf, diffuseOnlyIsLambert) {
    const LobeAlbedo albedo = lobeAlbedo(makeBsdf({0.8f, 0.4f, 0.1f}, 1.0f, 0.3f, true), 0.3f);
    EXPECT_EQ(albedo.diffuse, vec3(0.8f, 0.4f, 0.1f));
    EXPECT_EQ(albedo.specular, vec3(0.0f));
}

}  // namespace
}  // namespace probegi::kernels

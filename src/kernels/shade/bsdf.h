// The metallic-roughness material of glTF 2.0, appendix B: Lambert below a GGX coat with Schlick's Fresnel term. All
// directions are in the local frame of the shading normal (+Z) and point away from the surface.
#ifndef PROBEGI_KERNELS_BSDF_H
#define PROBEGI_KERNELS_BSDF_H

#include "kernels/language.h"
#include "kernels/sampling.h"
#include "kernels/screen/colour.h"

KERNELS_BEGIN

// Below this, the lobe is indistinguishable from a delta and float cannot hold its density.
KERNEL_CONST float kMinAlpha = 1e-3f;

struct Bsdf {
    vec3 diffuse;      // c_diff of B.3.5
    vec3 f0;           // reflectance at normal incidence
    float alpha;       // roughness^2
    float specular;    // 1; 0 removes the coat
    float minDiffuse;  // minimum probability of sampling the cosine lobe
};

// Appendix B.3.5. With `diffuseOnly` the material is Lambert with the base colour as its albedo, metal or not.
KERNEL_FN Bsdf makeBsdf(vec3 baseColor, float metallic, float roughness, bool diffuseOnly) {
    Bsdf b;
    b.diffuse = diffuseOnly ? baseColor : baseColor * (1.0f - metallic);
    b.f0 = mix(vec3(0.04f), baseColor, metallic);
    b.alpha = max(roughness * roughness, kMinAlpha);
    b.specular = diffuseOnly ? 0.0f : 1.0f;
    b.minDiffuse = diffuseOnly ? 1.0f : 0.0f;
    return b;
}

// Schlick 1994, eq. 15, as in appendix B.3.4.
KERNEL_FN vec3 fresnelSchlick(vec3 f0, float cosTheta) {
    const float m = clamp(1.0f - cosTheta, 0.0f, 1.0f);
    const float m2 = m * m;
    return f0 + (vec3(1.0f) - f0) * (m2 * m2 * m);
}

// Appendix B.3.2: D of Trowbridge and Reitz. In the local frame sin^2 is h.x^2 + h.y^2, which keeps its digits where
// 1 - h.z^2 would lose them.
KERNEL_FN float ggxDistribution(vec3 h, float alpha) {
    const float a2 = alpha * alpha;
    const float d = h.x * h.x + h.y * h.y + a2 * h.z * h.z;
    return a2 / (kPi * d * d);
}

// Lambda of Smith's masking function for GGX: Heitz 2014, "Understanding the Masking-Shadowing Function in
// Microfacet-Based BRDFs", eq. 72.
KERNEL_FN float ggxLambda(float cosTheta, float alpha) {
    const float c2 = cosTheta * cosTheta;
    const float tan2 = max(1.0f - c2, 0.0f) / max(c2, 1e-12f);
    return 0.5f * (sqrt(1.0f + alpha * alpha * tan2) - 1.0f);
}

// Height-correlated Smith term over 4 (n.v) (n.l): Heitz 2014, eq. 99.
KERNEL_FN float ggxVisibility(float cosO, float cosI, float alpha) {
    const float g2 = 1.0f / (1.0f + ggxLambda(cosO, alpha) + ggxLambda(cosI, alpha));
    return g2 / (4.0f * cosO * cosI);
}

// The two lobes separately, each times the cosine of wi, for white-furnace tests.
KERNEL_FN void evalLobes(Bsdf b, vec3 wo, vec3 wi, OUT(vec3) diffuse, OUT(vec3) specular) {
    diffuse = vec3(0.0f);
    specular = vec3(0.0f);
    if (!(wo.z > 0.0f) || !(wi.z > 0.0f)) return;
    diffuse = b.diffuse * (wi.z / kPi);
    if (b.specular <= 0.0f) return;
    const vec3 h = normalize(wo + wi);
    const vec3 f = fresnelSchlick(b.f0, dot(wo, h));
    diffuse = diffuse * (vec3(1.0f) - f);
    specular = f * (ggxDistribution(h, b.alpha) * ggxVisibility(wo.z, wi.z, b.alpha) * wi.z);
}

// BSDF times the cosine of wi; 0 below the surface.
KERNEL_FN vec3 evalBsdf(Bsdf b, vec3 wo, vec3 wi) {
    vec3 diffuse;
    vec3 specular;
    evalLobes(b, wo, wi, diffuse, specular);
    return diffuse + specular;
}

// Probability of sampling the cosine lobe, by the estimated energy of each lobe seen from wo.
KERNEL_FN float diffuseProbability(Bsdf b, vec3 wo) {
    if (b.specular <= 0.0f) return 1.0f;
    const vec3 f = fresnelSchlick(b.f0, wo.z);
    const float diffuse = luminance(b.diffuse * (vec3(1.0f) - f));
    const float p = diffuse > 0.0f ? clamp(diffuse / (diffuse + luminance(f)), 0.1f, 0.9f) : 0.0f;
    return max(p, b.minDiffuse);
}

// Density of wi by reflecting wo at a visible normal: Heitz 2018, "Sampling the GGX Distribution of Visible Normals",
// eq. 3 and 17.
KERNEL_FN float pdfGgx(vec3 wo, vec3 wi, float alpha) {
    const vec3 h = normalize(wo + wi);
    return ggxDistribution(h, alpha) / (4.0f * wo.z * (1.0f + ggxLambda(wo.z, alpha)));
}

// A normal that is visible from wo: Dupuy and Benyoub 2023, "Sampling Visible GGX Normals with Spherical Caps",
// section 3. Stretched to roughness 1, the reflections of wo are uniform over a cap of the sphere around +Z.
KERNEL_FN vec3 sampleGgxNormal(vec3 wo, float alpha, vec2 u) {
    const vec3 stretched = normalize(vec3(alpha * wo.x, alpha * wo.y, wo.z));
    const float z = 1.0f - u.y * (1.0f + stretched.z);
    const float r = sqrt(clamp(1.0f - z * z, 0.0f, 1.0f));
    const float phi = 2.0f * kPi * u.x;
    const vec3 h = vec3(r * cos(phi), r * sin(phi), z) + stretched;
    return normalize(vec3(alpha * h.x, alpha * h.y, max(h.z, 1e-9f)));
}

// Density of wi in sampleBsdf; 0 below the surface.
KERNEL_FN float pdfBsdf(Bsdf b, vec3 wo, vec3 wi) {
    if (!(wo.z > 0.0f) || !(wi.z > 0.0f)) return 0.0f;
    const float p = diffuseProbability(b, wo);
    const float diffuse = p * pdfCosineHemisphere(wi.z);
    return p < 1.0f ? diffuse + (1.0f - p) * pdfGgx(wo, wi, b.alpha) : diffuse;
}

// A direction wi; wi.z <= 0 means that wi points into the surface and the path ends. `lobe` is a third random number.
KERNEL_FN vec3 sampleBsdf(Bsdf b, vec3 wo, vec2 u, float lobe) {
    if (lobe < diffuseProbability(b, wo)) return sampleCosineHemisphere(u);
    const vec3 h = sampleGgxNormal(wo, b.alpha, u);
    return h * (2.0f * dot(wo, h)) - wo;
}

KERNELS_END

#endif

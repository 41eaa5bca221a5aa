#include "lane.h"

#include "kernels/shade/bsdf.h"

// Roughness and angles avoid the poles of the formulas, which amplify the rounding of a direction by 1 / alpha^2 and
// 1 / cosine, and sampled normals avoid the horizon: there both sides are right and differ.
Bsdf takeMaterial(INOUT(Lane) lane) {
    const vec3 baseColor = takeVector(lane, 0.0f, 1.0f);
    const float metallic = takeUnit(lane);
    const float roughness = takeBetween(lane, 0.25f, 1.0f);
    return makeBsdf(baseColor, metallic, roughness, takeIndex(lane, 4) == 0);
}

vec3 takeAbove(INOUT(Lane) lane) {
    const vec3 v = takeVector(lane, -1.0f, 1.0f);
    return normalize(vec3(v.x, v.y, abs(v.z) + 0.1f));
}

void evaluate(INOUT(Lane) lane) {
    const Bsdf b = takeMaterial(lane);
    const vec3 wo = takeAbove(lane);
    const vec3 wi = takeAbove(lane);
    const float turn = takeUnit(lane);
    const vec2 u = vec2(turn, takeBetween(lane, 0.0f, 0.9f));

    giveVec3(lane, b.diffuse, 1e-6f);
    giveVec3(lane, b.f0, 1e-6f);
    giveVec3(lane, fresnelSchlick(b.f0, wo.z), 1e-6f);
    give(lane, ggxDistribution(normalize(wo + wi), b.alpha), 2e-4f);
    give(lane, ggxLambda(wo.z, b.alpha), 1e-5f);
    give(lane, ggxVisibility(wo.z, wi.z, b.alpha), 1e-4f);
    vec3 diffuse;
    vec3 specular;
    evalLobes(b, wo, wi, diffuse, specular);
    giveVec3(lane, diffuse, 1e-5f);
    giveVec3(lane, specular, 2e-4f);
    giveVec3(lane, evalBsdf(b, wo, wi), 2e-4f);
    giveVec3(lane, evalBsdf(b, wo, vec3(0.0f, 0.0f, -1.0f)), 0.0f);
    give(lane, diffuseProbability(b, wo), 1e-5f);
    give(lane, pdfGgx(wo, wi, b.alpha), 2e-4f);
    give(lane, pdfBsdf(b, wo, wi), 2e-4f);
    giveVec3(lane, sampleGgxNormal(wo, b.alpha, u), 5e-5f);
    give(lane, sampleBsdf(b, wo, u, 2.0f).z, 1e-4f);
    give(lane, sampleBsdf(b, wo, u, 0.0f).x, 1e-4f);
}

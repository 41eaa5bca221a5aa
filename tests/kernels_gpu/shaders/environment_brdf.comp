#include "lane.h"

#include "kernels/shade/environment_brdf.h"

void evaluate(INOUT(Lane) lane) {
    const vec3 baseColor = takeVector(lane, 0.0f, 1.0f);
    const float metallic = takeUnit(lane);
    const float roughness = takeUnit(lane);
    const Bsdf b = makeBsdf(baseColor, metallic, roughness, takeIndex(lane, 4) == 0);
    const float cosO = takeBetween(lane, 0.01f, 1.0f);
    give(lane, lobeEnergy(cosO, b.alpha), 1e-5f);
    give(lane, lobeSchlick(cosO, b.alpha), 1e-5f);
    give(lane, cosineSchlick(cosO), 1e-6f);
    const LobeAlbedo albedo = lobeAlbedo(b, cosO);
    giveVec3(lane, albedo.diffuse, 1e-6f);
    giveVec3(lane, albedo.specular, 1e-5f);
}

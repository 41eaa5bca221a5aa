#include "lane.h"

#include "kernels/screen/pixel_layers.h"

void evaluate(INOUT(Lane) lane) {
    PixelLayers sums = emptyLayers();
    const vec3 direct = takeVector(lane, 0.0f, 10.0f);
    const vec3 irradiance = takeVector(lane, 0.0f, 10.0f);
    const vec3 albedo = takeVector(lane, 0.0f, 1.0f);
    const vec3 normal = takeDirection(lane);
    addSurface(sums, direct, irradiance, albedo, normal, takeBetween(lane, 0.0f, 100.0f));
    addSky(sums, takeVector(lane, 0.0f, 10.0f));
    const vec3 glossy = takeVector(lane, 0.0f, 10.0f);
    addGlossySurface(sums, direct, irradiance, albedo, glossy, albedo, normal, 1.0f);
    addContactLayers(sums, glossy, albedo.x);
    const PixelLayers means = meanLayers(sums, 3);
    giveVec3(lane, means.color, 1e-5f);
    giveVec3(lane, means.direct, 1e-6f);
    giveVec3(lane, means.indirect, 1e-5f);
    giveVec3(lane, means.irradiance, 1e-6f);
    giveVec3(lane, means.albedo, 1e-6f);
    giveVec3(lane, means.normal, 1e-6f);
    giveVec3(lane, means.glossy, 1e-5f);
    give(lane, means.depth, 1e-6f);
    giveVec3(lane, means.contact, 1e-5f);
    give(lane, means.openness, 1e-6f);
}

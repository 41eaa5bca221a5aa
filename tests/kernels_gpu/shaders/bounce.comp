#include "lane.h"

#include "kernels/shade/bounce.h"

void evaluate(INOUT(Lane) lane) {
    const vec3 albedo = takeVector(lane, 0.0f, 1.0f);
    const vec3 irradiance = takeVector(lane, 0.0f, 50.0f);
    giveVec3(lane, bounceRadiance(albedo, irradiance), 1e-6f);
    giveVec3(lane, bounceRadiance(vec3(1.0f), irradiance), 1e-6f);
}

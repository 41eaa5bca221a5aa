#include "lane.h"

#include "lookup_access.h"
#include "some_cage.h"

#include "kernels/lookup/irradiance.h"

void evaluate(INOUT(Lane) lane) {
    const Volume v = takeVolume(lane);
    const Cage cage = takeCage(lane, v);
    const int rules = takeIndex(lane, 2);
    const int guard = takeIndex(lane, 2);
    const float walls = takeIndex(lane, 2) == 0 ? 0.27f : 1.0f;
    const vec3 point = toWorldDirection(v, cage.position - v.origin) + v.origin;
    const vec3 normal = toWorldDirection(v, cage.normal);
    giveVec3(lane, irradianceIn(accessTo(rules, guard, walls), v, point, normal, vec3(0.0f)), 5e-3f);
    const VolumeAnswer neighbours = neighboursAnswer(accessTo(kRulesMeasured, guard, walls), v, cage, normal);
    giveVec3(lane, neighbours.irradiance, 1e-3f);
    give(lane, neighbours.weight, 1e-3f);
    const VolumeAnswer answer = answerIn(accessTo(rules, guard, walls), v, point, normal, vec3(0.0f));
    give(lane, answer.weight, 5e-3f);
    giveBits(lane, enoughWeight(0.0004f, rules) ? 1u : 0u);
}

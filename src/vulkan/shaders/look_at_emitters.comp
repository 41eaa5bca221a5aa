// The probes' emitter samples, in the steps of src/field/probe_emitters.cpp: choose a point on an emitter, trace a ray
// to it, take what it emits. Neighbouring threads take the same sample of neighbouring probes.
// variants: tracers
#include "emitter_lights.glsl"
#include "rays.glsl"
#include "scene_set.glsl"
#include "tasks.glsl"
#include "volume.glsl"

#include "kernels/blend/probe_blend.h"

layout(push_constant, scalar) uniform Push {
    TracePush push;
};

// Index of the first triangle whose range of numbers reaches `choice`.
int chosenEmitter(SceneEmitters emitters, uint choice) {
    int low = 0;
    int high = PROBEGI_SCENE.emitterCount - 1;
    while (low < high) {
        const int middle = (low + high) / 2;
        if (emitters.at[middle].upTo < choice)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

// Radiance that arrives from the point; 0 if something else is in between.
vec3 arriving(vec3 probe, EmitterAim aim, int material) {
    if (!(aim.cosine > 0.0)) return vec3(0.0);
    const float offset = rayOffset(probe + aim.direction * aim.distance, PROBEGI_SCENE.magnitude);
    const float tolerance = emitterTolerance(aim, offset);
    const Ray ray = Ray(probe, 0.0, aim.direction, aim.distance + tolerance);
    const Hit hit = closestHit(ray);
    if (hit.primitive < 0 || !(abs(hit.distance - aim.distance) <= tolerance)) return vec3(0.0);
    const Surface surface = surfaceAt(ray, hit);
    if (surface.backface || surface.material != material) return vec3(0.0);
    return vec3(safeRadiance(surface.emission.x), safeRadiance(surface.emission.y), safeRadiance(surface.emission.z));
}

EmitterLight look(ProbeTask task, uint index) {
    SceneEmitters emitters = SceneEmitters(PROBEGI_SCENE.emitters);
    const uint number = uint(probeNumber(probegiField.volumes[task.volume], int(task.slot)));
    const uint seed = emitterSeed(push.emitterSeed, number);
    const uint choice = emitterChoice(seed, index, uint(push.looks));
    const int chosen = chosenEmitter(emitters, choice);
    const GpuEmitter emitter = emitters.at[chosen];
    const uint below = chosen == 0 ? 0u : emitters.at[chosen - 1].upTo;
    const vec3 origin = task.origin;
    const EmitterAim aim = aimAtEmitter(origin, emitter.corner, emitter.edge1, emitter.edge2,
                                        emitterBarycentric(seed, index, choice, below, emitter.upTo));
    const float factor = emitterLightFactor(push.rays, push.looks, emitterPerArea(emitter.material), aim);
    return EmitterLight(aim.direction, factor * arriving(origin, aim, emitter.material));
}

void main() {
    const uint index = globalIndex();
    Tasks list = Tasks(push.tasks);
    if (index >= list.counts.tasks * uint(push.looks)) return;
    const uint task = index % list.counts.tasks;
    const uint number = index / list.counts.tasks;
    useSceneOnly();
    EmitterLights(push.emitterLights).at[task * uint(push.looks) + number] = look(list.at[task], number);
}

// Primary rays of a picture: what each sample shows, its own emission, or the sky.
// variants: tracers
#include "picture.glsl"
#include "scene_set.glsl"

layout(push_constant, scalar) uniform Push {
    PicturePush push;
};

Ray primaryRay(uint index) {
    const int pixel = int(index) / push.planes;
    const int plane = push.firstPlane + int(index) % push.planes;
    const vec3 direction = subSampleDirection(push.camera, pixel % push.width, push.firstRow + pixel / push.width,
                                              plane, push.samplesPerAxis);
    return Ray(push.camera.origin, 0.0, direction, kNoHitDistance);
}

void main() {
    const uint index = globalIndex();
    if (index >= push.sampleCount) return;
    useLighting(push.lighting);
    const Ray ray = primaryRay(index);
    const Hit hit = closestHit(ray);
    ScreenSample s;
    s.viewDirection = ray.direction;
    s.irradiance = vec3(0.0);
    if (hit.primitive < 0) {
        s.kind = kSampleSky;
        s.direct = skyRadianceAt(ray.direction);
        s.position = vec3(0.0);
        s.geometricNormal = vec3(0.0, 1.0, 0.0);
        s.shadingNormal = vec3(0.0, 1.0, 0.0);
        s.albedo = vec3(0.0);
        s.metallic = 0.0;
        s.roughness = 1.0;
        s.distance = 0.0;
    } else {
        const Surface surface = surfaceAt(ray, hit, pinholeSpread(push.camera, push.samplesPerAxis));
        s.kind = surface.backface ? kSampleBackface : kSampleSurface;
        s.direct = surface.emission;
        s.position = surface.position;
        s.geometricNormal = surface.geometricNormal;
        s.shadingNormal = surface.shadingNormal;
        s.albedo = surface.albedo;
        s.metallic = surface.metallic;
        s.roughness = surface.roughness;
        s.distance = hit.distance;
    }
    Samples(push.samples).at[index] = s;
}

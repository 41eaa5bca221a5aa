// Glossy rays, one for each block of 2 x 2 pixels, and what they hit.
// variants: tracers
#include "picture_glossy.glsl"
#include "scene_set.glsl"

layout(push_constant, scalar) uniform Push {
    PicturePush push;
};

// The pixel of a block whose ray it is; -1: none.
int pixelWithRay(int column, int row) {
    for (int attempt = 0; attempt < 4; ++attempt) {
        const int candidate = glossyCandidate(push.firstPlane, attempt);
        const int x = 2 * column + candidate % 2;
        const int y = 2 * row + candidate / 2;
        if (x >= push.width || y >= push.rows) continue;
        const int pixel = y * push.width + x;
        const ScreenSample s = Samples(push.samples).at[pixel];
        if (s.kind == kSampleSurface && glossyRayShare(s.roughness) > 0.0) return pixel;
    }
    return -1;
}

ScreenSample blackSky() {
    ScreenSample s;
    s.position = vec3(0.0);
    s.kind = kSampleSky;
    s.viewDirection = vec3(0.0, 0.0, -1.0);
    s.distance = 0.0;
    s.geometricNormal = vec3(0.0, 1.0, 0.0);
    s.metallic = 0.0;
    s.shadingNormal = vec3(0.0, 1.0, 0.0);
    s.roughness = 1.0;
    s.albedo = vec3(0.0);
    s.direct = vec3(0.0);
    s.irradiance = vec3(0.0);
    return s;
}

void clearLobes(int column, int row) {
    for (int i = 0; i < 4; ++i) {
        const int x = 2 * column + i % 2;
        const int y = 2 * row + i / 2;
        if (x < push.width && y < push.rows) glossyLobes(push).at[y * push.width + x] = vec3(0.0);
    }
}

void main() {
    const uint index = globalIndex();
    const ivec2 size = glossySize(push);
    if (index >= glossyCount(push)) return;
    const int column = int(index) % size.x;
    const int row = int(index) / size.x;
    useLighting(push.lighting);
    clearLobes(column, row);
    GlossySample block;
    block.radiance = vec3(0.0);
    block.blurred = vec3(0.0);
    block.reach = 1.0;  // of the sky
    block.radius = 0.0;
    block.pixel = pixelWithRay(column, row);
    ScreenSample s = blackSky();
    if (block.pixel >= 0) {
        const ScreenSample from = Samples(push.samples).at[block.pixel];
        s.viewDirection = glossyDirection(from.shadingNormal, from.geometricNormal, from.viewDirection, from.roughness,
                                          glossyPattern(column, row, push.firstPlane));
        const Ray ray = Ray(offsetOrigin(from.position, from.geometricNormal, PROBEGI_SCENE.magnitude), 0.0,
                            s.viewDirection, kNoHitDistance);
        const Hit hit = closestHit(ray);
        if (hit.primitive < 0) {
            s.direct = skyRadianceAt(ray.direction);
        } else {
            // Of a block: the texture's detail that one ray can show.
            const Surface surface = surfaceAt(ray, hit, 2.0 * pinholeSpread(push.camera, 1));
            s.kind = surface.backface ? kSampleBackface : kSampleSurface;
            s.direct = surface.emission;
            s.position = surface.position;
            s.geometricNormal = surface.geometricNormal;
            s.shadingNormal = surface.shadingNormal;
            s.albedo = surface.albedo;
            s.metallic = surface.metallic;
            s.roughness = surface.roughness;
            s.distance = hit.distance;
            block.reach = glossyReach(hit.distance, from.distance);
        }
    }
    glossyHits(push).at[index] = s;
    glossySamples(push).at[index] = block;
}

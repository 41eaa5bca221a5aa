// The wall of a ball with the scene's material 0 on both sides. Its block contains the ball (BallSceneTracer::block).
#ifndef PROBEGI_TESTS_TRACER_BALL_GLSL
#define PROBEGI_TESTS_TRACER_BALL_GLSL

#include "ball.h"

Ball sceneBall() {
    const uint numbers[4] = sceneConstants.tracer.numbers;
    return Ball(uintBitsToFloat(uvec3(numbers[0], numbers[1], numbers[2])), uintBitsToFloat(numbers[3]));
}

float wallDistance(Ray ray) {
    return ballDistance(sceneBall(), ray.origin, ray.direction, ray.near, ray.far);
}

Hit closestHit(Ray ray) {
    const float distance = wallDistance(ray);
    if (distance < 0.0) return Hit(kNoHitDistance, -1, -1, -1, vec2(0.0));
    return Hit(distance, 0, 0, -1, vec2(0.0));
}

bool occluded(Ray ray) {
    return wallDistance(ray) >= 0.0;
}

Surface surfaceAt(Ray ray, Hit hit, float spread) {
    const GpuMaterial material = sceneMaterial(0u);
    const Ball ball = sceneBall();
    const vec3 outwards = ballNormal(ball, ray.origin + ray.direction * hit.distance);
    Surface surface;
    surface.position = ball.centre + outwards * ball.radius;
    surface.geometricNormal = dot(outwards, ray.direction) > 0.0 ? -outwards : outwards;
    surface.shadingNormal = surface.geometricNormal;
    surface.albedo = material.baseColor;
    surface.emission = material.emission;
    surface.metallic = material.metallic;
    surface.roughness = material.roughness;
    surface.material = 0;
    surface.back = false;
    surface.backface = false;
    return surface;
}

#endif

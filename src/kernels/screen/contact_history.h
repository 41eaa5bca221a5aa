// Contact light of the picture before, where a surface was seen then (SDFDDGI paper, section 3.5: temporal denoising).
#ifndef PROBEGI_KERNELS_CONTACT_HISTORY_H
#define PROBEGI_KERNELS_CONTACT_HISTORY_H

#include "kernels/screen/contact_blur.h"
#include "kernels/screen/pinhole.h"

KERNELS_BEGIN

// Of a pixel.
struct ContactRecord {
    vec4 light;     // as ContactFound::difference, with all that was kept before
    vec3 position;  // of the surface there
    vec3 normal;    // geometric; 0: nothing is known
    float count;    // pictures in `light`
};

// Most pictures that one is the mean of: then old light fades.
KERNEL_CONST float kContactLongest = 16.0f;

// Where a camera saw a point: pixels, those of a pixel's middle at + 0.5; z is the distance along its axis, not more
// than 0 behind it.
KERNEL_FN vec3 pinholePixel(IN(PinholeCamera) camera, vec3 point) {
    // The image plane's axes are orthogonal, and so is the axis that the corner has besides.
    const vec3 axis = normalize(cross(camera.pixelRight, camera.pixelDown));
    const vec3 away = point - camera.origin;
    const float depth = dot(away, axis);
    const vec3 onPlane = away * (dot(camera.corner, axis) / max(depth, 1e-12f)) - camera.corner;
    return vec3(dot(onPlane, camera.pixelRight) / dot(camera.pixelRight, camera.pixelRight),
                dot(onPlane, camera.pixelDown) / dot(camera.pixelDown, camera.pixelDown), depth);
}

// How far a record is of the same surface: 0 across edges of depth and normal, and where nothing is known.
KERNEL_FN float recordWeight(IN(ContactRecord) record, vec3 position, vec3 normal, float distance, float pixelAngle) {
    if (record.count <= 0.0f) return 0.0f;
    const vec3 apart = record.position - position;
    const float pixel = pixelAngle * distance;
    const float off = dot(normal, apart) / (2.0f * pixel);
    const float turned = (1.0f - dot(normal, record.normal)) / 0.125f;
    // Moved along with the surface, which positions in the world do not show: not of the same place either.
    const float aside = dot(apart, apart) / (16.0f * pixel * pixel);
    return max(1.0f - off * off, 0.0f) * max(1.0f - turned, 0.0f) * max(1.0f - aside, 0.0f);
}

// What the records around a place on the old screen say together.
struct ContactPast {
    vec4 light;
    float count;
    float weight;
};

KERNEL_FN ContactPast noPast() {
    ContactPast past;
    past.light = vec4(0.0f);
    past.count = past.weight = 0.0f;
    return past;
}

KERNEL_FN void addRecord(INOUT(ContactPast) past, IN(ContactRecord) record, float weight) {
    past.light += weight * record.light;
    past.count += weight * record.count;
    past.weight += weight;
}

// Light and its count with what is new: the mean of both, the old within what the neighbours are now, from `lower` to
// `upper`, and as far again on both sides.
KERNEL_FN vec4 keptContact(IN(ContactPast) past, vec4 light, vec4 lower, vec4 upper, OUT(float) count) {
    count = 1.0f;
    if (past.weight < 0.01f) return light;
    const vec4 range = upper - lower;
    const vec4 old = min(max(past.light * (1.0f / past.weight), lower - range), upper + range);
    const float before = min(past.count / past.weight, kContactLongest - 1.0f) * min(past.weight, 1.0f);
    count = before + 1.0f;
    return light + (old - light) * (before / count);
}

KERNELS_END

#endif

// Directions and points from uniform random numbers. `u` is uniform in [0, 1)^2; local frames have +Z as their axis.
#ifndef PROBEGI_KERNELS_SAMPLING_H
#define PROBEGI_KERNELS_SAMPLING_H

#include "kernels/language.h"

KERNELS_BEGIN

// An orthonormal frame around a unit normal: columns tangent, bitangent, normal. Duff et al. 2017, "Building an
// Orthonormal Basis, Revisited", section 2: no branch and no loss of precision near either pole.
KERNEL_FN mat3 orthonormalBasis(vec3 n) {
    const float s = n.z >= 0.0f ? 1.0f : -1.0f;
    const float a = -1.0f / (s + n.z);
    const float b = n.x * n.y * a;
    return mat3(vec3(1.0f + s * n.x * n.x * a, s * b, -s * n.x), vec3(b, s + n.y * n.y * a, -n.y), n);
}

KERNEL_FN vec3 toWorld(mat3 frame, vec3 local) {
    return frame[0] * local.x + frame[1] * local.y + frame[2] * local.z;
}

KERNEL_FN vec3 toLocal(mat3 frame, vec3 world) {
    return vec3(dot(frame[0], world), dot(frame[1], world), dot(frame[2], world));
}

// Uniform on the unit disk, continuous: Shirley and Chiu 1997, "A Low Distortion Map Between Disk and Square".
KERNEL_FN vec2 sampleDisk(vec2 u) {
    const float a = 2.0f * u.x - 1.0f;
    const float b = 2.0f * u.y - 1.0f;
    if (a == 0.0f && b == 0.0f) return vec2(0.0f, 0.0f);
    const bool xIsLonger = abs(a) > abs(b);
    const float radius = xIsLonger ? a : b;
    const float phi = xIsLonger ? 0.25f * kPi * (b / a) : kPi * (0.5f - 0.25f * (a / b));
    return vec2(radius * cos(phi), radius * sin(phi));
}

// Density cos / pi over solid angle (Malley's method: a uniform disk lifted onto the hemisphere).
KERNEL_FN vec3 sampleCosineHemisphere(vec2 u) {
    const vec2 d = sampleDisk(u);
    return vec3(d.x, d.y, sqrt(max(0.0f, 1.0f - d.x * d.x - d.y * d.y)));
}

KERNEL_FN float pdfCosineHemisphere(float cosTheta) {
    return max(cosTheta, 0.0f) * (1.0f / kPi);
}

// Density 1 / (4 pi) over solid angle.
KERNEL_FN vec3 sampleSphere(vec2 u) {
    const float z = 1.0f - 2.0f * u.x;
    const float r = sqrt(max(0.0f, 1.0f - z * z));
    const float phi = 2.0f * kPi * u.y;
    return vec3(r * cos(phi), r * sin(phi), z);
}

// A uniform point on a triangle, as weights of the second and third corner: the unit square folded along its diagonal.
KERNEL_FN vec2 sampleTriangle(vec2 u) {
    return u.x + u.y > 1.0f ? vec2(1.0f - u.x, 1.0f - u.y) : u;
}

// Veach 1997, "Robust Monte Carlo Methods for Light Transport Simulation", section 9.2.4: the power heuristic with
// exponent 2, one sample each. `pdf` is the density of the strategy that generated the sample.
KERNEL_FN float powerHeuristic(float pdf, float other) {
    if (!(pdf > 0.0f)) return 0.0f;
    const float ratio = other / pdf;
    return 1.0f / (1.0f + ratio * ratio);
}

KERNELS_END

#endif

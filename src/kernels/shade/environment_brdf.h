// What a surface reflects of light that comes from everywhere alike: the albedos of the lobes of bsdf.h for one
// direction of view, in closed form. Light that varies is then taken apart: its mean over the lobe, times the lobe's
// albedo.
#ifndef PROBEGI_KERNELS_ENVIRONMENT_BRDF_H
#define PROBEGI_KERNELS_ENVIRONMENT_BRDF_H

#include "kernels/shade/bsdf.h"

KERNELS_BEGIN

// Albedo of the GGX lobe with F = 1: what its masking leaves of the light. Least squares over our own lobe, integrated
// numerically (cosines from 0.01, all roughnesses): within 0.013.
KERNEL_FN float lobeEnergy(float cosO, float alpha) {
    const float x = cosO / (cosO + alpha);
    const float constant = 1.09635f + alpha * (-0.643087f + alpha * (1.13943f - 0.622728f * alpha));
    const float linear = -0.99429f + alpha * (4.30934f + alpha * (-10.1471f + 3.98039f * alpha));
    const float square = 1.47763f + alpha * (-8.54038f + alpha * (13.7908f - 0.914887f * alpha));
    const float cube = -0.568277f + alpha * (5.16804f + alpha * (-4.64379f - 5.56672f * alpha));
    return clamp(constant + x * (linear + x * (square + x * cube)), 0.0f, 1.0f);
}

// Mean of Schlick's (1 - h.v)^5 over the same lobe; of its fifth root, since that is smooth. Times lobeEnergy() within
// 0.02.
KERNEL_FN float lobeSchlick(float cosO, float alpha) {
    const float u = sqrt(cosO);
    const float r = sqrt(alpha);
    const float constant = 0.998905f + r * (-0.158898f + r * (-2.51196f + r * (4.06808f - 1.69191f * r)));
    const float linear = 0.061027f + r * (1.47383f + r * (-2.05179f - 1.2107f * r));
    const float square = -1.25873f + r * (0.367385f + 4.44672f * r);
    const float cube = 0.00770772f - 2.67184f * r;
    const float root = clamp(constant + u * (linear + u * (square + u * (cube + 0.46807f * u))), 0.0f, 1.0f);
    const float root2 = root * root;
    return root2 * root2 * root;
}

// The same over the cosine lobe, within 1e-4.
KERNEL_FN float cosineSchlick(float cosO) {
    return 0.0280604f + cosO * (-0.0775643f + cosO * (0.0752032f - 0.0256881f * cosO));
}

// Shares of uniform light that the two lobes of evalLobes() send towards a viewer.
struct LobeAlbedo {
    vec3 diffuse;
    vec3 specular;
};

// `cosO`: between the shading normal and the direction to the viewer, > 0.
KERNEL_FN LobeAlbedo lobeAlbedo(Bsdf b, float cosO) {
    LobeAlbedo albedo;
    albedo.diffuse = b.diffuse;
    albedo.specular = vec3(0.0f);
    if (b.specular <= 0.0f) return albedo;
    const float cosine = clamp(cosO, 0.01f, 1.0f);
    const float through = 1.0f - cosineSchlick(cosine);
    albedo.diffuse = b.diffuse * (vec3(1.0f) - b.f0) * through;
    const float energy = lobeEnergy(cosine, b.alpha);
    albedo.specular = energy * (b.f0 + (vec3(1.0f) - b.f0) * lobeSchlick(cosine, b.alpha));
    return albedo;
}

KERNELS_END

#endif

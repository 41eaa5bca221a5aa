// Colours of a box's faces: a few texels each, so that a wall of many colours need not be one. In texture memory's
// order: faces -X, +X, -Y, +Y, -Z, +Z of the box's frame, rows of kSdfFaceSide texels along the face's first axis (the
// next after its normal's: Y of X, Z of Y, X of Z), rows one after another along its second.
#ifndef PROBEGI_KERNELS_SDF_FACE_TEXELS_H
#define PROBEGI_KERNELS_SDF_FACE_TEXELS_H

#include "kernels/sdf/primitive.h"

KERNELS_BEGIN

KERNEL_CONST int kSdfFaceSide = 6;
KERNEL_CONST int kSdfFaceTexels = 216;  // of all six faces

// A colour in one word: square roots in 8 bits a channel, red lowest, since eyes and light's bounces see ratios.
KERNEL_FN uint sdfPackChannel(float linear) {
    return uint(sqrt(clamp(linear, 0.0f, 1.0f)) * 255.0f + 0.5f);
}
KERNEL_FN uint sdfPackColour(vec3 linear) {
    return sdfPackChannel(linear.x) | (sdfPackChannel(linear.y) << 8u) | (sdfPackChannel(linear.z) << 16u);
}
KERNEL_FN vec3 sdfUnpackColour(uint word) {
    const vec3 root =
        vec3(float(word & 255u), float((word >> 8u) & 255u), float((word >> 16u) & 255u)) * (1.0f / 255.0f);
    return root * root;
}

// Where a point of a box's surface lies among its texels: number of the lowest of four, and how far it is to the next
// along the two axes of the face. The others are `first` + 1, + kSdfFaceSide and + both.
struct SdfFacePoint {
    int first;
    float u;  // 0..1
    float v;
};

// Texel and share along one axis of a face, from -1..1 across it. Beyond the outermost texels' middles they are all.
KERNEL_FN float sdfAlongFace(float place) {
    return clamp((place * 0.5f + 0.5f) * float(kSdfFaceSide) - 0.5f, 0.0f, float(kSdfFaceSide - 1));
}

// Of a point near the surface, in the box's frame.
KERNEL_FN SdfFacePoint sdfFacePoint(vec3 halfSize, vec3 p) {
    const vec3 normal = sdfFaceNormal(sdfBeyondFaces(halfSize, p), p);
    const vec3 place = p / halfSize;
    int face;
    float alongU;
    float alongV;
    if (normal.x != 0.0f) {
        face = normal.x < 0.0f ? 0 : 1;
        alongU = sdfAlongFace(place.y);
        alongV = sdfAlongFace(place.z);
    } else if (normal.y != 0.0f) {
        face = normal.y < 0.0f ? 2 : 3;
        alongU = sdfAlongFace(place.z);
        alongV = sdfAlongFace(place.x);
    } else {
        face = normal.z < 0.0f ? 4 : 5;
        alongU = sdfAlongFace(place.x);
        alongV = sdfAlongFace(place.y);
    }
    const int u = min(int(alongU), kSdfFaceSide - 2);
    const int v = min(int(alongV), kSdfFaceSide - 2);
    SdfFacePoint at;
    at.first = (face * kSdfFaceSide + v) * kSdfFaceSide + u;
    at.u = alongU - float(u);
    at.v = alongV - float(v);
    return at;
}

// Of a point near the surface, in the world.
KERNEL_FN SdfFacePoint sdfFacePointAt(SdfSolid solid, vec3 point) {
    return sdfFacePoint(solid.halfSize, sdfToLocal(solid, point - solid.centre));
}

// Between the four texels around a point, in the order of SdfFacePoint.
KERNEL_FN vec3 sdfFaceColour(SdfFacePoint at, uint first, uint alongU, uint alongV, uint both) {
    return mix(mix(sdfUnpackColour(first), sdfUnpackColour(alongU), at.u),
               mix(sdfUnpackColour(alongV), sdfUnpackColour(both), at.u), at.v);
}

KERNELS_END

#endif

// Primary rays of a perspective camera: through an image plane at distance 1. Pixel (0, 0) is the top left one; x and y
// may be fractional, a pixel's centre is at + 0.5.
#ifndef PROBEGI_KERNELS_PINHOLE_H
#define PROBEGI_KERNELS_PINHOLE_H

#include "kernels/language.h"

KERNELS_BEGIN

struct PinholeCamera {
    vec3 origin;
    vec3 corner;      // from the origin to the image's top left corner
    vec3 pixelRight;  // from one pixel to the next
    vec3 pixelDown;
};

// `forward` and `up` are unit and orthogonal, `yfov` is vertical, radians.
KERNEL_FN PinholeCamera makePinhole(vec3 origin, vec3 forward, vec3 up, float yfov, int width, int height) {
    const float pixel = 2.0f * tan(0.5f * yfov) / float(height);
    PinholeCamera camera;
    camera.origin = origin;
    camera.pixelRight = cross(forward, up) * pixel;
    camera.pixelDown = up * -pixel;
    camera.corner = forward - camera.pixelRight * (0.5f * float(width)) - camera.pixelDown * (0.5f * float(height));
    return camera;
}

KERNEL_FN vec3 pinholeDirection(PinholeCamera camera, float x, float y) {
    return normalize(camera.corner + camera.pixelRight * x + camera.pixelDown * y);
}

// The same through the middle of a cell of pixel (x, y): pixels have samplesPerAxis^2 cells, numbered row by row.
KERNEL_FN vec3 subSampleDirection(PinholeCamera camera, int x, int y, int cell, int samplesPerAxis) {
    const float side = 1.0f / float(samplesPerAxis);
    return pinholeDirection(camera, float(x) + (float(cell % samplesPerAxis) + 0.5f) * side,
                            float(y) + (float(cell / samplesPerAxis) + 0.5f) * side);
}

// Angle in radians covered by one of `samplesPerAxis` rays across a pixel, at the picture's centre.
KERNEL_FN float pinholeSpread(PinholeCamera camera, int samplesPerAxis) {
    return length(camera.pixelRight) / float(samplesPerAxis);
}

KERNELS_END

#endif

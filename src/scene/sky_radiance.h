#pragma once

#include "kernels/light/sky.h"
#include "probegi/scene.h"

namespace probegi {

/// Radiance of the sky in the unit direction `direction`. Bilinear in the image, wrapping around horizontally.
inline glm::vec3 skyRadiance(const Sky& sky, glm::vec3 direction) {
    if (!sky.textured()) return sky.radiance;
    const HdrImage& image = sky.image;
    const kernels::SkyTexels t = kernels::skyTexels(kernels::skyUv(direction), image.width, image.height);
    return sky.radiance * kernels::blendSky(t, image.at(t.left, t.upper), image.at(t.right, t.upper),
                                            image.at(t.left, t.lower), image.at(t.right, t.lower));
}

}  // namespace probegi

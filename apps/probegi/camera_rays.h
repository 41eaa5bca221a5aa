#pragma once

#include <vector>

#include "probegi/scene.h"
#include "probegi/tracer.h"

namespace probegi::tool {

/// Rays through the middles of a picture's pixels, row by row from the top.
std::vector<Ray> primaryRays(const PlacedCamera& camera, int width, int height);

/// How bright a surface is in pictures that show things and not light, 0.4..1: by the angle at which a ray meets it.
float shadeOf(const Surface& surface, const Ray& ray);

/// Colours of numbered things: hues that stay apart however many there are.
glm::vec3 colourOf(std::size_t number);

}  // namespace probegi::tool

#pragma once

#include <cmath>
#include <glm/geometric.hpp>

#include "probegi/render.h"

namespace probegi {

/// Rays through an image plane at distance 1. Pixel (0, 0) is the top left one; x and y may be fractional, a pixel's
/// centre is at + 0.5.
class Pinhole {
public:
    Pinhole(const PlacedCamera& camera, int width, int height)
        : m_origin(camera.position), m_pixelRight(glm::cross(camera.forward, camera.up)), m_pixelDown(-camera.up) {
        const float pixel = 2.0f * std::tan(0.5f * camera.yfov) / float(height);
        m_pixelRight *= pixel;
        m_pixelDown *= pixel;
        m_corner = camera.forward - 0.5f * float(width) * m_pixelRight - 0.5f * float(height) * m_pixelDown;
    }

    Ray ray(float x, float y) const {
        return {m_origin, 0.0f, glm::normalize(m_corner + x * m_pixelRight + y * m_pixelDown)};
    }

private:
    glm::vec3 m_origin, m_pixelRight, m_pixelDown, m_corner;
};

}  // namespace probegi

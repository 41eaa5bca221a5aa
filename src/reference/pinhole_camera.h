#pragma once

#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "probegi/render.h"
#include "probegi/tracer.h"

namespace probegi {

/// Rays through the pixels of a pinhole camera, uniform over each pixel.
class PinholeCamera {
public:
    explicit PinholeCamera(const PictureDesc& desc)
        : m_camera(desc.camera), m_width(desc.width), m_height(desc.height) {
        m_up = std::tan(0.5f * desc.camera.yfov) * desc.camera.up;
        const glm::vec3 right = glm::cross(desc.camera.forward, desc.camera.up);
        m_right = std::tan(0.5f * desc.camera.yfov) * float(desc.width) / float(desc.height) * right;
    }
    Ray ray(std::size_t pixel, glm::vec2 jitter) const {
        const float x = (float(pixel % std::size_t(m_width)) + jitter.x) / float(m_width) * 2 - 1;
        const float y = 1 - (float(pixel / std::size_t(m_width)) + jitter.y) / float(m_height) * 2;
        return {m_camera.position, 0.0f, glm::normalize(m_camera.forward + x * m_right + y * m_up)};
    }

private:
    PlacedCamera m_camera;
    int m_width;
    int m_height;
    glm::vec3 m_right, m_up;
};

}  // namespace probegi

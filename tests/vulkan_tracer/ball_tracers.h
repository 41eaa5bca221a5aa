#pragma once

#include "vulkan/tracers/scene_tracer.h"
#include "vulkan_tracer/ball.h"

namespace probegi::test {

/// A ball in the middle of the bounds, as wide as their narrowest side.
inline kernels::Ball ballIn(const Bounds& bounds) {
    const glm::vec3 size = bounds.size();
    return {bounds.centre(), 0.5f * std::min({size.x, size.y, size.z})};
}

/// The GPU tracer of the ball in the scene's bounds: would be a row in src/vulkan/tracers/scene_tracers.cpp.
const vulkan::SceneTracerType& ballSceneTracer();

/// The CPU tracer.
class BallTracer final : public Tracer {
public:
    BallTracer(kernels::Ball ball, const Material& material) : m_ball(ball), m_material(material) {}

    Result<void> closestHits(std::span<const Ray> rays, std::span<Hit> hits) const override {
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const float distance = wallDistance(rays[i]);
            hits[i] = distance < 0 ? Hit{} : Hit{.distance = distance, .primitive = 0, .geometry = 0};
        }
        return {};
    }
    Result<void> occluded(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const override {
        for (std::size_t i = 0; i < rays.size(); ++i) blocked[i] = wallDistance(rays[i]) >= 0 ? 1 : 0;
        return {};
    }
    Result<void> surfaces(std::span<const Ray> rays, std::span<const Hit> hits, std::span<Surface> out) const override {
        for (std::size_t i = 0; i < rays.size(); ++i)
            if (hits[i].valid()) out[i] = surface(rays[i], hits[i]);
        return {};
    }
    Bounds bounds() const override { return {m_ball.centre - m_ball.radius, m_ball.centre + m_ball.radius}; }

private:
    float wallDistance(const Ray& ray) const {
        return kernels::ballDistance(m_ball, ray.origin, ray.direction, ray.near, ray.far);
    }
    Surface surface(const Ray& ray, const Hit& hit) const {
        const glm::vec3 outwards = kernels::ballNormal(m_ball, ray.origin + ray.direction * hit.distance);
        Surface s;
        s.position = m_ball.centre + outwards * m_ball.radius;
        s.geometricNormal = s.shadingNormal = glm::dot(outwards, ray.direction) > 0 ? -outwards : outwards;
        s.albedo = glm::vec3(m_material.baseColor);
        s.emission = m_material.emission;
        s.metallic = m_material.metallic;
        s.roughness = m_material.roughness;
        s.material = 0;
        return s;
    }

    kernels::Ball m_ball;
    Material m_material;
};

}  // namespace probegi::test

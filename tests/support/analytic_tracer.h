#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "probegi/tracer.h"

namespace probegi::test {

/// Spheres and parallelograms by their equations: an oracle that shares nothing with the triangle tracers.
class AnalyticTracer : public Tracer {
public:
    std::vector<Material> materials;

    /// Front: the outside, or the inside where `inward`.
    void addSphere(glm::vec3 centre, float radius, bool inward, int material) {
        m_spheres.push_back({centre, radius, inward, material});
        grow(centre - radius), grow(centre + radius);
    }
    /// Front: the side of cross(edge1, edge2).
    void addQuad(glm::vec3 corner, glm::vec3 edge1, glm::vec3 edge2, int material) {
        m_quads.push_back({corner, edge1, edge2, material});
        grow(corner), grow(corner + edge1), grow(corner + edge2), grow(corner + edge1 + edge2);
    }

    Result<void> closestHits(std::span<const Ray> rays, std::span<Hit> hits) const override {
        for (std::size_t i = 0; i < rays.size(); ++i) hits[i] = closest(rays[i]);
        return {};
    }
    Result<void> occluded(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const override {
        for (std::size_t i = 0; i < rays.size(); ++i) blocked[i] = closest(rays[i]).valid() ? 1 : 0;
        return {};
    }
    Result<void> surfaces(std::span<const Ray> rays, std::span<const Hit> hits, std::span<Surface> out) const override {
        for (std::size_t i = 0; i < rays.size(); ++i)
            if (hits[i].valid()) out[i] = surface(rays[i], hits[i]);
        return {};
    }
    Bounds bounds() const override { return m_bounds; }

private:
    struct Sphere {
        glm::vec3 centre;
        float radius;
        bool inward;
        int material;
    };
    struct Quad {
        glm::vec3 corner, edge1, edge2;
        int material;
    };

    void grow(glm::vec3 p) {
        if (m_empty) m_bounds = {p, p};
        m_empty = false;
        m_bounds.lower = glm::min(m_bounds.lower, p);
        m_bounds.upper = glm::max(m_bounds.upper, p);
    }

    static void keepNearest(Hit& best, const Ray& ray, double t, int geometry, std::size_t index) {
        if (t > double(ray.near) && t < double(ray.far) && t < double(best.distance)) {
            best.distance = float(t);
            best.geometry = geometry;
            best.primitive = std::int32_t(index);
        }
    }

    Hit closest(const Ray& ray) const {
        Hit best;
        for (std::size_t i = 0; i < m_spheres.size(); ++i) {
            const glm::dvec3 o = glm::dvec3(ray.origin) - glm::dvec3(m_spheres[i].centre);
            const double r = double(m_spheres[i].radius), b = glm::dot(o, glm::dvec3(ray.direction));
            const double discriminant = b * b - glm::dot(o, o) + r * r;
            if (discriminant < 0) continue;
            keepNearest(best, ray, -b - std::sqrt(discriminant), 0, i);
            keepNearest(best, ray, -b + std::sqrt(discriminant), 0, i);
        }
        for (std::size_t i = 0; i < m_quads.size(); ++i) {
            const Quad& q = m_quads[i];
            const glm::dvec3 n = glm::cross(glm::dvec3(q.edge1), glm::dvec3(q.edge2));
            const double facing = glm::dot(n, glm::dvec3(ray.direction));
            if (facing == 0) continue;
            const double t = glm::dot(n, glm::dvec3(q.corner) - glm::dvec3(ray.origin)) / facing;
            const glm::dvec3 p = glm::dvec3(ray.origin) + t * glm::dvec3(ray.direction) - glm::dvec3(q.corner);
            const double u = glm::dot(glm::cross(p, glm::dvec3(q.edge2)), n) / glm::dot(n, n);
            const double v = glm::dot(glm::cross(glm::dvec3(q.edge1), p), n) / glm::dot(n, n);
            if (u >= 0 && u <= 1 && v >= 0 && v <= 1) keepNearest(best, ray, t, 1, i);
        }
        return best;
    }

    Surface surface(const Ray& ray, const Hit& hit) const {
        Surface s;
        s.position = ray.origin + ray.direction * hit.distance;
        glm::vec3 front;
        if (hit.geometry == 0) {
            const Sphere& sphere = m_spheres[std::size_t(hit.primitive)];
            const glm::vec3 outward = glm::normalize(s.position - sphere.centre);
            s.position = sphere.centre + outward * sphere.radius;
            front = sphere.inward ? -outward : outward;
            s.material = sphere.material;
        } else {
            const Quad& quad = m_quads[std::size_t(hit.primitive)];
            front = glm::normalize(glm::cross(quad.edge1, quad.edge2));
            s.material = quad.material;
        }
        const Material& m = materials[std::size_t(s.material)];
        const bool fromBehind = glm::dot(front, ray.direction) > 0;
        s.geometricNormal = s.shadingNormal = fromBehind ? -front : front;
        s.back = fromBehind;
        s.backface = fromBehind && !m.doubleSided;
        if (s.backface) return s;
        s.albedo = glm::vec3(m.baseColor);
        s.emission = m.emission;
        s.metallic = m.metallic;
        s.roughness = m.roughness;
        return s;
    }

    std::vector<Sphere> m_spheres;
    std::vector<Quad> m_quads;
    Bounds m_bounds;
    bool m_empty = true;
};

}  // namespace probegi::test

#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <random>
#include <vector>

#include "bvh/scene_bvh.h"

namespace probegi::test {

inline glm::vec3 randomIn(std::mt19937& random, float extent) {
    std::uniform_real_distribution<float> uniform(-extent, extent);
    const float x = uniform(random), y = uniform(random), z = uniform(random);
    return {x, y, z};
}

inline glm::vec3 randomUnit(std::mt19937& random) {
    for (;;) {
        const glm::vec3 v = randomIn(random, 1.0f);
        if (glm::length(v) > 0.1f && glm::length(v) < 1.0f) return glm::normalize(v);
    }
}

inline void addTriangle(SceneTriangles& soup, glm::vec3 a, glm::vec3 b, glm::vec3 c) {
    for (const glm::vec3& corner : {a, b, c}) {
        soup.indices.push_back(std::uint32_t(soup.positions.size()));
        soup.positions.push_back(corner);
    }
}

inline SceneTriangles randomSoup(std::mt19937& random, int count, float size = 0.25f) {
    SceneTriangles soup;
    for (int i = 0; i < count; ++i) {
        const glm::vec3 centre = randomIn(random, 1.0f);
        const glm::vec3 a = randomIn(random, size), b = randomIn(random, size), c = randomIn(random, size);
        addTriangle(soup, centre + a, centre + b, centre + c);
    }
    return soup;
}

inline TriangleBvh buildOpaque(const SceneTriangles& soup) {
    return buildTriangleBvh(makeContext(), soup.soup(), {}).value();
}

inline TracedWorld worldOf(const TriangleBvh& bvh) {
    TracedWorld world;
    world.worldRoot = world.arrays.append(bvh);
    world.alphaPasses = [](int, int, glm::vec2) { return true; };
    return world;
}

/// Distance to the nearest triangle by definition, in double precision (Moeller and Trumbore 1997, equation 6); 1e30 if
/// there is none. `margin`: the least barycentric weight of all triangles that were hit or nearly hit.
inline double nearestDistance(const SceneTriangles& soup, const Ray& ray, double& margin) {
    double nearest = 1e30;
    const glm::dvec3 d(ray.direction);
    for (std::size_t i = 0; i < soup.indices.size(); i += 3) {
        const glm::dvec3 a(soup.positions[soup.indices[i]]);
        const glm::dvec3 e1 = glm::dvec3(soup.positions[soup.indices[i + 1]]) - a;
        const glm::dvec3 e2 = glm::dvec3(soup.positions[soup.indices[i + 2]]) - a;
        const glm::dvec3 p = glm::cross(d, e2), s = glm::dvec3(ray.origin) - a, q = glm::cross(s, e1);
        const double determinant = glm::dot(e1, p);
        if (determinant == 0.0) continue;
        const double u = glm::dot(s, p) / determinant, v = glm::dot(d, q) / determinant;
        const double t = glm::dot(e2, q) / determinant, inside = std::min({u, v, 1.0 - u - v});
        if (t < double(ray.near) || t > double(ray.far)) continue;
        margin = std::min(margin, std::abs(inside));
        if (inside >= 0.0) nearest = std::min(nearest, t);
    }
    return nearest;
}

}  // namespace probegi::test

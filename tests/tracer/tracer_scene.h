#pragma once

#include <gmock/gmock.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <memory>
#include <random>
#include <vector>

#include "probegi/tracer.h"
#include "support/tracers.h"

namespace probegi::test {

inline Context makeContext(int threads = 1) {
    return Context::create({.threads = threads, .log = {}, .progress = {}}).value();
}

/// A scene under construction and its pose.
struct TestScene {
    Scene scene;
    ScenePose pose;

    TestScene() { scene.materials.emplace_back(); }
    int addMaterial(Material material) {
        scene.materials.push_back(std::move(material));
        return int(scene.materials.size()) - 1;
    }
    int addImage(int width, int height, std::vector<std::uint8_t> rgba) {
        scene.images.push_back({width, height, std::move(rgba), "test"});
        return int(scene.images.size()) - 1;
    }
    int addMesh(Primitive primitive) {
        scene.meshes.push_back({"test", {std::move(primitive)}});
        return int(scene.meshes.size()) - 1;
    }
    void place(int mesh, const glm::mat4& toWorld = glm::mat4(1.0f)) { pose.instances.push_back({mesh, -1, toWorld}); }
    void add(Primitive primitive, const glm::mat4& toWorld = glm::mat4(1.0f)) {
        place(addMesh(std::move(primitive)), toWorld);
    }
};

/// A scene's tracer, from the maker under test.
inline std::unique_ptr<Tracer> trace(const TracerMaker& maker, const TestScene& s, int threads = 1) {
    const Result<void> valid = validate(s.scene);
    EXPECT_TRUE(valid) << valid.error().message;
    auto tracer = maker.make(makeContext(threads), s.scene, s.pose);
    if (!tracer) throw std::runtime_error(tracer.error().message);  // fails the test
    return std::move(*tracer);
}

/// All results for one ray.
struct Shot {
    Hit hit;
    Surface surface;
    bool blocked = false;
};

inline Shot shoot(const Tracer& tracer, const Ray& ray) {
    Shot shot;
    std::uint8_t blocked = 2;
    tracer.closestHits({&ray, 1}, {&shot.hit, 1}).value();
    tracer.surfaces({&ray, 1}, {&shot.hit, 1}, {&shot.surface, 1}).value();
    tracer.occluded({&ray, 1}, {&blocked, 1}).value();
    EXPECT_LT(blocked, 2);
    shot.blocked = blocked == 1;
    return shot;
}

inline Ray rayAlong(glm::vec3 origin, glm::vec3 direction) {
    return {origin, 0.0f, glm::normalize(direction), 1e30f};
}

/// x and z in -1..1 at y = 0, front up. u runs along +x, v along +z.
inline Primitive quad(int material = 0) {
    Primitive p;
    p.positions = {{-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}};
    p.uv0 = {{0, 0}, {0, 1}, {1, 1}, {1, 0}};
    p.indices = {0, 1, 2, 0, 2, 3};
    p.material = material;
    return p;
}

/// The cube -1..1 with its fronts inside, each face a grid whose inner vertices are moved within the face and whose
/// corners and edges are shared exactly with the neighbours.
inline Primitive innerBox(int cells, std::mt19937& random, int material = 0) {
    std::uniform_real_distribution<float> jitter(-0.35f, 0.35f);
    Primitive p;
    p.material = material;
    for (int face = 0; face < 6; ++face) {
        const int axis = face / 2;
        const float side = face % 2 == 0 ? -1.0f : 1.0f;
        const auto base = std::uint32_t(p.positions.size());
        for (int j = 0; j <= cells; ++j) {
            for (int i = 0; i <= cells; ++i) {
                const bool inner = i > 0 && i < cells && j > 0 && j < cells;
                glm::vec3 position;
                position[axis] = side;
                position[(axis + 1) % 3] = 2.0f * (float(i) + (inner ? jitter(random) : 0.0f)) / float(cells) - 1.0f;
                position[(axis + 2) % 3] = 2.0f * (float(j) + (inner ? jitter(random) : 0.0f)) / float(cells) - 1.0f;
                p.positions.push_back(position);
            }
        }
        for (int j = 0; j < cells; ++j) {
            for (int i = 0; i < cells; ++i) {
                const std::uint32_t a = base + std::uint32_t(j * (cells + 1) + i);
                const std::uint32_t b = a + 1, c = a + std::uint32_t(cells) + 1, d = c + 1;
                if (side < 0.0f)
                    p.indices.insert(p.indices.end(), {a, b, d, a, d, c});
                else
                    p.indices.insert(p.indices.end(), {a, d, b, a, c, d});
            }
        }
    }
    return p;
}

inline glm::vec3 randomDirection(std::mt19937& random) {
    std::normal_distribution<float> normal;
    for (;;) {
        const glm::vec3 v(normal(random), normal(random), normal(random));
        if (glm::length(v) > 1e-3f) return glm::normalize(v);
    }
}

inline glm::vec3 randomPoint(std::mt19937& random, float extent) {
    std::uniform_real_distribution<float> uniform(-extent, extent);
    const float x = uniform(random), y = uniform(random), z = uniform(random);
    return {x, y, z};
}

inline void expectNear(glm::vec3 actual, glm::vec3 expected, float tolerance) {
    EXPECT_LE(glm::distance(actual, expected), tolerance)
        << "(" << actual.x << ", " << actual.y << ", " << actual.z << ") instead of (" << expected.x << ", "
        << expected.y << ", " << expected.z << ")";
}

}  // namespace probegi::test

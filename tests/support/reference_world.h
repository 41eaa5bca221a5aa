#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "geometry/lighting.h"
#include "probegi/reference.h"
#include "reference/transport.h"

namespace probegi::test {

/// Adds a material and returns its index.
inline int addMaterial(Scene& scene, glm::vec3 albedo, glm::vec3 emission = glm::vec3(0.0f), bool doubleSided = false) {
    Material m;
    m.baseColor = glm::vec4(albedo, 1.0f);
    m.emission = emission;
    m.doubleSided = doubleSided;
    scene.materials.push_back(m);
    return int(scene.materials.size()) - 1;
}

/// Adds a parallelogram of two triangles as a mesh and node of its own; its front is the side of cross(edge1, edge2).
inline void addQuad(Scene& scene, glm::vec3 corner, glm::vec3 edge1, glm::vec3 edge2, int material) {
    Primitive p;
    p.positions = {corner, corner + edge1, corner + edge1 + edge2, corner + edge2};
    p.uv0 = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    p.indices = {0, 1, 2, 0, 2, 3};
    p.material = material;
    scene.meshes.push_back({"quad", {p}});
    Node node;
    node.mesh = int(scene.meshes.size()) - 1;
    scene.addNode(node);
}

/// A closed box seen from inside.
inline void addRoom(Scene& scene, glm::vec3 lower, glm::vec3 upper, int material) {
    const glm::vec3 s = upper - lower, x(s.x, 0, 0), y(0, s.y, 0), z(0, 0, s.z);
    addQuad(scene, lower, z, x, material);      // floor, +Y
    addQuad(scene, lower + y, x, z, material);  // ceiling, -Y
    addQuad(scene, lower, x, y, material);      // back, +Z
    addQuad(scene, lower + z, y, x, material);  // front, -Z
    addQuad(scene, lower, y, z, material);      // left, +X
    addQuad(scene, lower + x, z, y, material);  // right, -X
}

/// Everything that a reference needs, made from a scene by the Embree tracer or one of the test's own.
struct ReferenceWorld {
    explicit ReferenceWorld(Scene s, int threads = 1, std::unique_ptr<Tracer> own = nullptr)
        : scene(std::move(s)), context(*Context::create({.threads = threads, .log = {}, .progress = {}})) {
        if (const auto valid = validate(scene); !valid) ADD_FAILURE() << valid.error().message;
        pose = poseAt(scene);
        lighting = {pose.lights, scene.sky};
        tracer = own ? std::move(own) : std::move(*makeEmbreeTracer(context, scene, pose));
    }
    ReferenceWorld(const ReferenceWorld&) = delete;
    ReferenceWorld& operator=(const ReferenceWorld&) = delete;

    PathTracer pathTracer() const { return std::move(*PathTracer::create(context, scene, pose, *tracer, lighting)); }
    Transport transport() const {
        return {tracer.get(), lighting.lights, EmitterSampler(scene, pose), SkyLight(lighting.sky),
                sceneMagnitude(tracer->bounds())};
    }

    Scene scene;
    Context context;
    ScenePose pose;
    Lighting lighting;
    std::unique_ptr<Tracer> tracer;
};

/// Each channel within `sigmas` of its own standard errors; rounding of the sums is allowed for.
inline void expectNear(const ReferenceIrradiance& e, glm::vec3 truth, float sigmas = 3.0f) {
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(e.mean[c], truth[c], sigmas * e.standardError[c] + 2e-5f * std::abs(truth[c])) << "channel " << c;
}

/// The estimate is also sharp enough to mean something.
inline void expectSharp(const ReferenceIrradiance& e, float relative) {
    for (int c = 0; c < 3; ++c) EXPECT_LE(e.standardError[c], relative * e.mean[c]) << "channel " << c;
}

}  // namespace probegi::test

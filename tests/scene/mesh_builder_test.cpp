#include "scene/builtin/mesh_builder.h"

#include <gtest/gtest.h>

#include <array>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "scene/builtin/atrium_parts.h"
#include "scene/builtin/box_solid.h"
#include "scene/builtin/noise.h"
#include "scene/mesh_checks.h"

namespace probegi::builtin {
namespace {

constexpr double kPi = glm::pi<double>();

/// Volume of the mesh that `add` builds; fails unless it is closed, with unit normals on the front side.
template <class Add>
double closedVolume(const Add& add, const char* what = "") {
    SCOPED_TRACE(what);
    MeshBuilder builder(0);
    add(builder);
    const Scene scene = test::sceneOf(builder.take());
    EXPECT_TRUE(validate(scene));
    const Primitive& p = scene.meshes[0].primitives[0];
    std::size_t against = 0;
    for (std::size_t i = 0; i < p.indices.size(); i += 3) {
        const glm::vec3 a = p.positions[p.indices[i]], b = p.positions[p.indices[i + 1]],
                        c = p.positions[p.indices[i + 2]];
        const glm::vec3 face = glm::cross(b - a, c - a);
        for (std::size_t k = 0; k < 3; ++k) {
            EXPECT_NEAR(glm::length(p.normals[p.indices[i + k]]), 1, 1e-4f);
            if (glm::dot(face, p.normals[p.indices[i + k]]) < 0) ++against;
        }
    }
    EXPECT_EQ(against, 0u) << "normals point into the solid";
    const test::WeldedMesh mesh = test::weld(scene, scene.meshes[0]);
    EXPECT_EQ(test::openEdges(mesh), 0u);
    return test::signedVolume(mesh);
}

TEST(MeshBuilder, BoxesAreClosed) {
    EXPECT_NEAR(closedVolume([](MeshBuilder& m) { m.box({1, 2, 3}, {3, 5, 7}); }), 24, 1e-5);
}

TEST(MeshBuilder, BevelsTakeTheEdgesAway) {
    // Bevel b = 0.1 of a unit cube: each edge loses b^2 / 2 along 1 - 2 b, each corner 5/6 of a cube of side b.
    const double volume = closedVolume([](MeshBuilder& m) { m.bevelledBox({0, 0, 0}, {1, 1, 1}, 0.1f); });
    EXPECT_NEAR(volume, 1 - 12 * 0.8 * 0.005 - 8 * 5.0 / 6 * 0.001, 1e-5);
}

TEST(MeshBuilder, PrismsAreClosed) {
    const std::array<glm::vec2, 3> outline{{{1, 0}, {-1, 0}, {0, 2}}};
    EXPECT_NEAR(closedVolume([&](MeshBuilder& m) { addPrism(m, outline, -1, 2); }), 6, 1e-5);
}

TEST(MeshBuilder, ALathedConeHasTheVolumeOfItsPolygons) {
    const std::array<glm::vec2, 4> profile{{{0, 0}, {1, 0}, {1, 0}, {0, 3}}};
    const double base = 0.5 * 64 * std::sin(2 * kPi / 64);
    EXPECT_NEAR(closedVolume([&](MeshBuilder& m) { addLathe(m, profile, 64); }), base, 1e-4);
}

TEST(MeshBuilder, AnArcadeIsAWallLessItsArches) {
    Arcade a;
    a.bays = 3;
    const double polygon = 0.5 * a.segments * std::sin(kPi / a.segments) * a.radius * a.radius;
    const double wall = 3 * a.bayWidth * (a.top - a.springing);
    EXPECT_NEAR(closedVolume([&](MeshBuilder& m) { addArcade(m, a); }), a.depth * (wall - 3 * polygon), 1e-3);
}

TEST(MeshBuilder, AGeodesicSphereNearsTheSphere) {
    const double volume = closedVolume([](MeshBuilder& m) { addGeodesicSphere(m, 4, [](glm::vec3) { return 1.0f; }); });
    EXPECT_NEAR(volume, 4 * kPi / 3, 0.01);
}

TEST(MeshBuilder, TransformsMoveNormalsToo) {
    MeshBuilder m(0);
    m.setTransform(glm::rotate(glm::mat4(1), glm::half_pi<float>(), glm::vec3(0, 0, 1)));
    m.quad({0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0});
    const Primitive p = m.take();
    for (const glm::vec3& n : p.normals) EXPECT_NEAR(n.x, -1, 1e-6f);
}

TEST(MeshBuilder, TheAtriumsPiecesAreClosed) {
    EXPECT_GT(closedVolume([](MeshBuilder& m) { addColumn(m, {}); }, "addColumn"), 0.4);
    EXPECT_GT(closedVolume([](MeshBuilder& m) { addBalustrade(m, 2.5f, 0.95f, 9); }, "addBalustrade"), 0.05);
    EXPECT_GT(closedVolume([](MeshBuilder& m) { addPot(m, 0.3f, 0.6f); }, "addPot"), 0.05);
    EXPECT_GT(closedVolume([](MeshBuilder& m) { addFountain(m); }, "addFountain"), 0.3);
    EXPECT_GT(closedVolume([](MeshBuilder& m) { addWater(m); }, "addWater"), 0.3);
    EXPECT_GT(closedVolume([](MeshBuilder& m) { addUrn(m); }, "addUrn"), 0.1);
}

test::WeldedMesh weldSolid(const BoxSolid& solid) {
    Scene scene;
    scene.materials.resize(8);
    scene.meshes.push_back(solid.build("solid"));
    return test::weld(scene, scene.meshes[0]);
}

TEST(BoxSolid, OverlapsCountOnce) {
    BoxSolid solid;
    solid.fill({0, 0, 0}, {2, 1, 1}, 0);
    solid.fill({1, 0, 0}, {3, 1, 1}, 0);
    const test::WeldedMesh mesh = weldSolid(solid);
    EXPECT_EQ(test::openEdges(mesh), 0u);
    EXPECT_NEAR(test::signedVolume(mesh), 3, 1e-6);
}

TEST(BoxSolid, RandomOrdersOfFillAndCarveStayClosed) {
    for (int seed = 0; seed < 20; ++seed) {
        BoxSolid solid;
        solid.fill(glm::vec3(-1), glm::vec3(6), 0);
        for (int i = 0; i < 12; ++i) {
            const auto random = [&](int k) { return std::floor(5 * hash01(i, k, seed)); };
            const glm::vec3 lower(random(0), random(1), random(2));
            const glm::vec3 upper = lower + 1.0f + glm::vec3(random(3), random(4), random(5)) * 0.5f;
            i % 3 == 0 ? solid.fill(lower, upper, i % 4) : solid.carve(lower, upper, Paint::all(i % 2));
        }
        const test::WeldedMesh mesh = weldSolid(solid);
        EXPECT_EQ(test::openEdges(mesh), 0u) << seed;
        EXPECT_GT(test::signedVolume(mesh), 0) << seed;
    }
}

TEST(BoxSolid, RoomsShowTheirPaintAndLaterWallsTheirOwn) {
    BoxSolid solid;
    solid.fill(glm::vec3(0), glm::vec3(4), 0);
    solid.carve(glm::vec3(1), glm::vec3(3), Paint::room(1, 2, 3));
    solid.fill({1, 1, 1}, {1.5f, 2, 1.5f}, 4);
    const Mesh mesh = solid.build("room");
    std::array<float, 5> area{};
    for (const Primitive& p : mesh.primitives) {
        for (std::size_t i = 0; i < p.indices.size(); i += 3) {
            const glm::vec3 a = p.positions[p.indices[i]], b = p.positions[p.indices[i + 1]],
                            c = p.positions[p.indices[i + 2]];
            area[std::size_t(p.material)] += 0.5f * glm::length(glm::cross(b - a, c - a));
        }
    }
    EXPECT_NEAR(area[0], 6 * 16, 1e-3f);            // outside
    EXPECT_NEAR(area[1], 4 * 4 - 2 * 0.5f, 1e-3f);  // walls, less the faces of the block against two of them
    EXPECT_NEAR(area[2], 4 - 0.25f, 1e-3f);         // floor less the block's foot
    EXPECT_NEAR(area[3], 4, 1e-3f);                 // ceiling
    EXPECT_NEAR(area[4], 0.25f + 2 * 0.5f, 1e-3f);  // the block's top and its two free sides
}

}  // namespace
}  // namespace probegi::builtin

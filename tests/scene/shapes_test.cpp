#include "probegi/shapes.h"

#include <gtest/gtest.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "scene/mesh_checks.h"

namespace probegi::test {
namespace {

/// Volume enclosed by closed, outward faces: a sum over triangles of their volume to the origin.
float volume(const Primitive& p) {
    float sum = 0;
    for (std::size_t i = 0; i < p.indices.size(); i += 3)
        sum += glm::dot(p.positions[p.indices[i]],
                        glm::cross(p.positions[p.indices[i + 1]], p.positions[p.indices[i + 2]]));
    return sum / 6;
}

/// Expects every triangle's normals to be unit and on the front side by its winding.
void expectFlatNormals(const Primitive& p) {
    ASSERT_EQ(p.normals.size(), p.positions.size());
    for (std::size_t i = 0; i < p.indices.size(); i += 3) {
        const glm::vec3 a = p.positions[p.indices[i]];
        const glm::vec3 winding =
            glm::normalize(glm::cross(p.positions[p.indices[i + 1]] - a, p.positions[p.indices[i + 2]] - a));
        for (std::size_t k = 0; k < 3; ++k) EXPECT_LT(glm::distance(p.normals[p.indices[i + k]], winding), 1e-5f);
    }
}

TEST(Shapes, AQuadFacesRightCrossUp) {
    Primitive p;
    addQuad(p, {1, 2, 3}, {4, 0, 0}, {0, 0, -2});
    expectFlatNormals(p);
    EXPECT_EQ(p.normals.front(), glm::vec3(0, 1, 0));
    EXPECT_EQ(p.positions[0], glm::vec3(1, 2, 3));
    EXPECT_EQ(p.positions[2], glm::vec3(5, 2, 1));
    EXPECT_FLOAT_EQ(std::abs(p.uv0[2].x - p.uv0[0].x), 4) << "uvs are metres";
}

TEST(Shapes, ABoxFacesOutwardsAndARoomInwards) {
    Primitive box, room;
    addBox(box, {-1, 2, 0}, {1, 3, 5});
    addRoom(room, {-1, 2, 0}, {1, 3, 5});
    EXPECT_NEAR(volume(box), 10, 1e-4f);
    EXPECT_NEAR(volume(room), -10, 1e-4f);
    for (const Primitive& p : {box, room}) {
        EXPECT_EQ(p.indices.size(), 36u);
        expectFlatNormals(p);
    }
}

TEST(Shapes, ShapesAddUpInOnePrimitive) {
    Primitive p;
    p.material = 1;
    addBox(p, glm::vec3(0), glm::vec3(1));
    addRoom(p, glm::vec3(-2), glm::vec3(2));
    addQuad(p, glm::vec3(0), {1, 0, 0}, {0, 1, 0});
    EXPECT_EQ(p.material, 1);
    EXPECT_EQ(p.indices.size(), 36u + 36u + 6u);
    EXPECT_NEAR(volume(p), 1 - 64, 1e-3f);
    expectFlatNormals(p);
}

TEST(Shapes, AnObjectIsWhereItsCoordinatesSay) {
    Scene scene;
    scene.materials.resize(1);
    Primitive box;
    addBox(box, {1, 2, 3}, {4, 5, 6});
    EXPECT_EQ(addObject(scene, box, "first"), 0);
    EXPECT_EQ(addObject(scene, box), 1);
    ASSERT_TRUE(validate(scene));
    EXPECT_EQ(scene.nodes[0].name, "first");
    const ScenePose pose = poseAt(scene);
    ASSERT_EQ(pose.instances.size(), 2u);
    EXPECT_EQ(pose.instances[1].mesh, 1);
    EXPECT_EQ(pose.bounds.lower, glm::vec3(1, 2, 3));
    EXPECT_EQ(pose.bounds.upper, glm::vec3(4, 5, 6));
}

}  // namespace
}  // namespace probegi::test

// The records that packScene writes.
#include "vulkan/scene/scene_data.h"

#include "tracer/tracer_scene.h"

namespace probegi::test {

namespace {

Material textured(int image) {
    Material material;
    material.baseColorTexture.image = image;
    return material;
}

vulkan::SceneData pack(const TestScene& s) {
    return vulkan::packScene(SceneGeometry::gather(s.scene, s.pose), EmitterGeometry(s.scene, s.pose).placed(),
                             s.scene);
}

}  // namespace

TEST(PackScene, StoresAnImageOnceAndUnusedOnesNotAtAll) {
    TestScene s;
    const int unused = s.addImage(1, 1, {1, 2, 3, 4});
    const int shared = s.addImage(2, 1, {10, 20, 30, 40, 50, 60, 70, 80});
    s.addMaterial(textured(unused));
    s.add(quad(s.addMaterial(textured(shared))));
    s.add(quad(s.addMaterial(textured(shared))));
    Material shifted = textured(shared);
    shifted.baseColorTexture.uvTransform[2][0] = 0.5f;
    s.add(quad(s.addMaterial(shifted)));
    const vulkan::SceneData data = pack(s);
    EXPECT_THAT(data.texels, testing::ElementsAre(0x281e140au, 0x50463c32u));
    EXPECT_EQ(data.textures.size(), 2u) << "one for each way of looking at it";
    EXPECT_EQ(data.materials[1].baseColorTexture, -1);
    EXPECT_EQ(data.materials[2].baseColorTexture, data.materials[3].baseColorTexture);
    EXPECT_EQ(data.textures[std::size_t(data.materials[4].baseColorTexture)].rowU, glm::vec3(1, 0, 0.5f));
}

TEST(PackScene, LeavesOutMapsThatShowNothing) {
    TestScene s;
    Material material;
    material.normalTexture.image = material.emissiveTexture.image = s.addImage(1, 1, {1, 2, 3, 4});
    material.normalScale = 0.0f;
    s.add(quad(s.addMaterial(material)));
    EXPECT_TRUE(pack(s).texels.empty());
}

TEST(PackScene, GroupsHaveTwoMeshesEach) {
    TestScene s;
    const int hole = s.addImage(1, 2, {0, 0, 0, 255, 0, 0, 0, 0});
    Material masked = textured(hole);
    masked.alphaMode = AlphaMode::mask;
    s.add(quad());
    const int leaf = s.addMesh(quad(s.addMaterial(masked)));
    const glm::mat4 mirrored = glm::translate(glm::scale(glm::mat4(1.0f), {-2, 1, 1}), {3, 4, 5});
    s.place(leaf);
    s.place(leaf, mirrored);
    const vulkan::SceneData data = pack(s);
    ASSERT_EQ(data.meshes.size(), 4u);
    EXPECT_EQ(data.meshes[0].triangleCount, 2u);
    EXPECT_EQ(data.meshes[1].triangleCount, 0u);
    EXPECT_EQ(data.meshes[2].triangleCount, 0u);
    EXPECT_EQ(data.meshes[3].triangleCount, 2u);
    EXPECT_EQ(data.meshes[3].firstVertex, 4u);
    EXPECT_EQ(data.meshes[3].firstTriangle, 2u);
    ASSERT_EQ(data.instances.size(), 2u);
    EXPECT_EQ(data.instances[1].group, 1);
    const glm::vec3 there = data.instances[1].toWorld * glm::vec4(1, 2, 3, 1);
    expectNear(there, glm::vec3(mirrored * glm::vec4(1, 2, 3, 1)), 1e-6f);
    expectNear(data.instances[1].toObject * glm::vec4(there, 1), {1, 2, 3}, 1e-6f);
}

TEST(PackScene, EmittersAndTheirMaterialsFollowTheSet) {
    TestScene s;
    Material lamp;
    lamp.emission = {3, 3, 3};
    s.add(quad());
    s.add(quad(s.addMaterial(lamp)), glm::translate(glm::mat4(1.0f), {0, 5, 0}));
    const vulkan::SceneData data = pack(s);
    ASSERT_EQ(data.emitters.size(), 2u);
    EXPECT_EQ(data.emitters[0].corner, glm::vec3(-1, 5, -1));
    EXPECT_EQ(data.emitters[0].edge1, glm::vec3(0, 0, 2));
    EXPECT_EQ(data.emitters[0].edge2, glm::vec3(2, 0, 2));
    EXPECT_EQ(data.emitters[1].upTo, 0xffffffffu);
    EXPECT_EQ(data.emitters[1].material, 1);
    EXPECT_EQ(data.materials[0].emittedLuminance, 0.0f);
    EXPECT_NEAR(data.materials[1].emittedLuminance, 3.0f, 1e-5f);
}

TEST(PackAddress, KeepsBothHalves) {
    EXPECT_EQ(vulkan::packAddress(0x123456789abcdef0u), glm::uvec2(0x9abcdef0u, 0x12345678u));
}

}  // namespace probegi::test

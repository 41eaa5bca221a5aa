#include "backend/rich_scene.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace probegi::test {

namespace {

/// An image of size x size texels from a function of the texel.
template <class Texel>
int addImage(Scene& scene, int size, const Texel& texel) {
    TextureImage image{size, size, {}, "made"};
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const glm::ivec4 rgba = texel(x, y);
            for (int c = 0; c < 4; ++c) image.rgba.push_back(std::uint8_t(rgba[c]));
        }
    scene.images.push_back(std::move(image));
    return int(scene.images.size()) - 1;
}

int addMaterial(Scene& scene, Material material) {
    scene.materials.push_back(std::move(material));
    return int(scene.materials.size()) - 1;
}

/// A parallelogram; its front is the side of cross(edge1, edge2).
int addQuadMesh(Scene& scene, glm::vec3 corner, glm::vec3 edge1, glm::vec3 edge2, int material, float repeats = 1) {
    Primitive p;
    p.positions = {corner, corner + edge1, corner + edge1 + edge2, corner + edge2};
    p.uv0 = {{0, 0}, {repeats, 0}, {repeats, repeats}, {0, repeats}};
    p.indices = {0, 1, 2, 0, 2, 3};
    p.material = material;
    scene.meshes.push_back({"quad", {p}});
    return int(scene.meshes.size()) - 1;
}

void addQuad(Scene& scene, glm::vec3 corner, glm::vec3 edge1, glm::vec3 edge2, int material, float repeats = 1) {
    scene.addNode({.mesh = addQuadMesh(scene, corner, edge1, edge2, material, repeats)});
}

/// A unit cube with its fronts outside.
int addCubeMesh(Scene& scene, int material) {
    Primitive p;
    p.material = material;
    for (int axis = 0; axis < 3; ++axis)
        for (const float side : {-0.5f, 0.5f}) {
            glm::vec3 n(0), u(0), v(0);
            n[axis] = side;
            u[(axis + 1) % 3] = side;  // the sign keeps u x v on the outside
            v[(axis + 2) % 3] = 0.5f;
            const auto base = std::uint32_t(p.positions.size());
            for (const glm::vec3& corner : {n - u - v, n + u - v, n + u + v, n - u + v}) p.positions.push_back(corner);
            for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) p.indices.push_back(base + i);
        }
    scene.meshes.push_back({"cube", {p}});
    return int(scene.meshes.size()) - 1;
}

void addLights(Scene& scene) {
    scene.lights.push_back({.type = LightType::directional, .intensity = {4, 3.6f, 3}});
    scene.lights.push_back({.type = LightType::point, .intensity = {6, 5, 4}, .range = 6});
    scene.lights.push_back(
        {.type = LightType::spot, .intensity = {9, 12, 20}, .innerConeAngle = 0.3f, .outerConeAngle = 0.6f});
    scene.addNode({.rotation = glm::angleAxis(-1.0f, glm::normalize(glm::vec3(1, 0.4f, 0))), .light = 0});
    scene.addNode({.translation = {-1.2f, 1.6f, 0.4f}, .light = 1});
    scene.addNode(
        {.translation = {1.4f, 2.2f, 1.0f}, .rotation = glm::angleAxis(-1.3f, glm::vec3(1, 0, 0)), .light = 2});
}

void addHall(Scene& scene, int matt, int tiles, int bricks) {
    const glm::vec3 x(4, 0, 0), y(0, 2.5f, 0), z(0, 0, 3), low(-2, 0, -1.5f);
    addQuad(scene, low, z, x, tiles, 3);       // floor, +Y
    addQuad(scene, low, x, y, bricks, 2);      // back wall, +Z
    addQuad(scene, low, y, z, matt);           // left wall, +X
    addQuad(scene, low + x, z, y, bricks, 1);  // right wall, -X
    // Half a roof over a hall that is open to the front.
    addQuad(scene, low + y, 0.5f * x, z, matt);  // faces down
}

}  // namespace

Scene richScene() {
    Scene scene;
    const int checker = addImage(scene, 8, [](int i, int j) {
        return (i + j) % 2 ? glm::ivec4(230, 210, 180, 255) : glm::ivec4(90, 60, 140, 255);
    });
    const int holes =
        addImage(scene, 8, [](int i, int j) { return glm::ivec4(200, 190, 90, (i / 2 + j / 2) % 2 * 255); });
    const int bumps = addImage(
        scene, 8, [](int i, int j) { return glm::ivec4(128 + 50 * (i % 3 - 1), 128 + 40 * (j % 3 - 1), 230, 255); });
    const int glow = addImage(scene, 4, [](int i, int j) { return glm::ivec4(40 + 60 * i, 40 + 60 * j, 120, 255); });

    const int matt = addMaterial(scene, {.baseColor = {0.7f, 0.7f, 0.65f, 1}});
    Material material{.baseColor = {0.9f, 0.9f, 0.9f, 1}};
    material.baseColorTexture = {.image = checker};
    const int tiles = addMaterial(scene, material);
    material.baseColorTexture = {.image = checker, .wrapU = Wrap::mirroredRepeat, .nearest = true};
    material.normalTexture = {.image = bumps};
    material.metallic = 0.2f;
    material.roughness = 0.4f;
    const int bricks = addMaterial(scene, material);
    Material fence{.baseColor = {1, 1, 1, 1}, .doubleSided = true};
    fence.baseColorTexture = {.image = holes, .nearest = true};
    fence.alphaMode = AlphaMode::mask;
    const int mask = addMaterial(scene, fence);
    Material lamp{.baseColor = {0.3f, 0.3f, 0.3f, 1}, .emission = {3, 2.5f, 2}};
    lamp.emissiveTexture = {.image = glow};
    const int lit = addMaterial(scene, lamp);

    addHall(scene, matt, tiles, bricks);
    addQuad(scene, {-0.4f, 0, 0.3f}, {0.9f, 0, 0}, {0, 1.1f, 0}, mask);
    addQuad(scene, {0.6f, 1.8f, -1}, {0.6f, 0, 0}, {0, 0, 0.6f}, lit);  // faces down
    addQuad(scene, {1.2f, 0, 0.2f}, {0, 0, 0.9f}, {0, 1.2f, 0}, matt);  // its back is to the hall's middle
    // A little above the floor: in one plane with it, either face would be the right answer to a ray.
    const int cube = addCubeMesh(scene, matt);
    scene.addNode({.translation = {-1.1f, 0.46f, -0.6f}, .scale = glm::vec3(0.9f), .mesh = cube});
    scene.addNode({.translation = {0.5f, 0.31f, -0.7f},
                   .rotation = glm::angleAxis(0.5f, glm::vec3(0, 1, 0)),
                   .scale = {-0.5f, 0.6f, 0.5f},
                   .mesh = cube});
    addLights(scene);
    scene.sky.radiance = {0.8f, 0.9f, 1.0f};
    scene.sky.image = HdrImage(16, 8);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 16; ++x)
            scene.sky.image.at(x, y) = glm::vec3(0.3f, 0.5f, 0.9f) * (0.2f + 0.1f * float(8 - y) + 0.02f * float(x));
    return scene;
}

PlacedCamera richCamera() {
    return lookAt({0.5f, 1.4f, 3.6f}, {0, 0.9f, 0}, 1.0f);
}

}  // namespace probegi::test

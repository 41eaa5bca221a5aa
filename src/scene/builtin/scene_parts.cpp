#include "scene/builtin/scene_parts.h"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>

namespace probegi::builtin {

namespace {

template <class T>
int append(std::vector<T>& list, T value) {
    list.push_back(std::move(value));
    return int(list.size()) - 1;
}

/// Points the node's -Z axis along `forward`.
glm::quat facing(glm::vec3 forward) {
    const PlacedCamera c = lookAt(glm::vec3(0), forward);
    const glm::vec3 right = glm::cross(c.forward, c.up);
    return glm::normalize(glm::quat_cast(glm::mat3(right, c.up, -c.forward)));
}

}  // namespace

int addMaterial(Scene& scene, std::string name, glm::vec3 albedo, float roughness) {
    Material m;
    m.name = std::move(name);
    m.baseColor = glm::vec4(albedo, 1);
    m.roughness = roughness;
    return append(scene.materials, std::move(m));
}

int addTextured(Scene& scene, std::string name, TextureImage image, float metres, float roughness) {
    const int material = addMaterial(scene, std::move(name), glm::vec3(1), roughness);
    TextureRef& ref = scene.materials[std::size_t(material)].baseColorTexture;
    ref.image = append(scene.images, std::move(image));
    ref.uvTransform = glm::mat3(1 / metres, 0, 0, 0, 1 / metres, 0, 0, 0, 1);
    return material;
}

void addNormalMap(Scene& scene, int material, TextureImage normals, float scale) {
    Material& m = scene.materials[std::size_t(material)];
    m.normalTexture = m.baseColorTexture;
    m.normalTexture.image = append(scene.images, std::move(normals));
    m.normalScale = scale;
}

int addEmitter(Scene& scene, std::string name, glm::vec3 radiance) {
    const int material = addMaterial(scene, std::move(name), glm::vec3(0.5f));
    scene.materials[std::size_t(material)].emission = radiance;
    return material;
}

int addMesh(Scene& scene, Mesh mesh) {
    return append(scene.meshes, std::move(mesh));
}

int addMesh(Scene& scene, std::string name, std::vector<MeshBuilder> parts) {
    Mesh mesh;
    mesh.name = std::move(name);
    for (MeshBuilder& part : parts) {
        if (!part.empty()) mesh.primitives.push_back(part.take());
    }
    return addMesh(scene, std::move(mesh));
}

int place(Scene& scene, int mesh, glm::vec3 position, float yaw, float scale) {
    Node node;
    node.name = scene.meshes[std::size_t(mesh)].name;
    node.mesh = mesh;
    node.translation = position;
    node.rotation = glm::angleAxis(yaw, glm::vec3(0, 1, 0));
    node.scale = glm::vec3(scale);
    return scene.addNode(std::move(node));
}

int addSun(Scene& scene, glm::vec3 direction, glm::vec3 lux) {
    Light light;
    light.name = "sun";
    light.type = LightType::directional;
    light.intensity = lux;
    Node node;
    node.name = light.name;
    node.rotation = facing(direction);
    node.light = append(scene.lights, std::move(light));
    return scene.addNode(std::move(node));
}

int addPointLight(Scene& scene, std::string name, glm::vec3 position, glm::vec3 intensity) {
    Light light;
    light.name = name;
    light.intensity = intensity;
    Node node;
    node.name = std::move(name);
    node.translation = position;
    node.light = append(scene.lights, std::move(light));
    return scene.addNode(std::move(node));
}

int addCamera(Scene& scene, std::string name, glm::vec3 from, glm::vec3 at, float yfovDegrees) {
    Camera camera;
    camera.name = name;
    camera.yfov = glm::radians(yfovDegrees);
    Node node;
    node.name = std::move(name);
    node.translation = from;
    node.rotation = facing(at - from);
    node.camera = append(scene.cameras, std::move(camera));
    return scene.addNode(std::move(node));
}

void addMotion(Scene& scene, int node, std::vector<float> times, const std::vector<glm::vec3>& places) {
    AnimationChannel channel{node, AnimationPath::translation, Interpolation::linear, std::move(times), {}};
    for (const glm::vec3& place : places) channel.values.emplace_back(place, 0.0f);
    scene.animations.push_back(std::move(channel));
}

void addRotation(Scene& scene, int node, glm::vec3 axis, std::vector<float> times, const std::vector<float>& degrees) {
    AnimationChannel channel{node, AnimationPath::rotation, Interpolation::linear, std::move(times), {}};
    for (const float turn : degrees) {
        const glm::quat q = glm::angleAxis(glm::radians(turn), axis);
        channel.values.emplace_back(q.x, q.y, q.z, q.w);
    }
    scene.animations.push_back(std::move(channel));
}

}  // namespace probegi::builtin

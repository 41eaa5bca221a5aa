#include "probegi/shapes.h"

#include <utility>

#include "scene/builtin/mesh_builder.h"

namespace probegi {

void addQuad(Primitive& out, glm::vec3 corner, glm::vec3 right, glm::vec3 up) {
    builtin::MeshBuilder builder(std::move(out));
    builder.quad(corner, corner + right, corner + right + up, corner + up);
    out = builder.take();
}

void addBox(Primitive& out, glm::vec3 lower, glm::vec3 upper) {
    builtin::MeshBuilder builder(std::move(out));
    builder.box(lower, upper);
    out = builder.take();
}

void addRoom(Primitive& out, glm::vec3 lower, glm::vec3 upper) {
    const std::size_t vertices = out.normals.size(), indices = out.indices.size();
    addBox(out, lower, upper);
    for (std::size_t i = vertices; i < out.normals.size(); ++i) out.normals[i] = -out.normals[i];
    for (std::size_t i = indices; i < out.indices.size(); i += 3) std::swap(out.indices[i + 1], out.indices[i + 2]);
}

int addObject(Scene& scene, Primitive primitive, std::string name) {
    Node node;
    node.name = name;
    node.mesh = int(scene.meshes.size());
    scene.meshes.push_back({std::move(name), {std::move(primitive)}});
    return scene.addNode(std::move(node));
}

}  // namespace probegi

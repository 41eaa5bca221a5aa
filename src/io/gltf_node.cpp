#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "io/gltf_import.h"

namespace probegi::io {

namespace {

/// The roots of the scene shown: the default one, else the first; without any scene, every node without a parent.
std::vector<int> rootNodes(const Import& import) {
    const tinygltf::Model& model = import.model;
    if (!model.scenes.empty()) {
        const int shown = model.defaultScene < 0 ? 0 : model.defaultScene;
        return model.scenes[checkedIndex("the file", "scene", shown, model.scenes.size())].nodes;
    }
    std::vector<bool> child(model.nodes.size(), false);
    for (const tinygltf::Node& node : model.nodes) {
        for (const int c : node.children) child[checkedIndex("a node", "child node", c, child.size())] = true;
    }
    std::vector<int> roots;
    for (std::size_t i = 0; i < child.size(); ++i) {
        if (!child[i]) roots.push_back(int(i));
    }
    if (roots.empty() && !child.empty())
        refuseMalformed("every node is the child of another; the hierarchy is a cycle");
    return roots;
}

std::optional<glm::mat4> matrixOf(const std::string& user, const std::vector<double>& values) {
    if (values.empty()) return {};
    if (values.size() != 16) refuseMalformed("{}: its matrix has {} numbers, not 16", user, values.size());
    glm::mat4 matrix(1.0f);
    for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = finiteFloat(user, "matrix", values[std::size_t(i)]);
    return matrix;
}

/// `count` numbers, or the fallback if the file has none.
glm::vec4 vectorOf(const std::string& user, const char* member, const std::vector<double>& values, int count,
                   glm::vec4 fallback) {
    if (values.empty()) return fallback;
    if (values.size() != std::size_t(count)) refuseMalformed("{}: {} of {} numbers", user, member, values.size());
    glm::vec4 v(0.0f);
    for (int i = 0; i < count; ++i) v[i] = finiteFloat(user, member, values[std::size_t(i)]);
    return v;
}

void importTransform(Import& import, const std::string& user, const tinygltf::Node& n, Node& node) {
    node.matrix = matrixOf(user, n.matrix);
    if (node.matrix) return;
    node.translation = vectorOf(user, "translation", n.translation, 3, glm::vec4(0.0f));
    node.scale = vectorOf(user, "scale", n.scale, 3, glm::vec4(1.0f));
    glm::vec4 q = vectorOf(user, "rotation", n.rotation, 4, glm::vec4(0, 0, 0, 1));
    const float length = glm::length(q);
    if (!(length > 1e-6f) || !std::isfinite(length)) {
        import.warn(fmt::format("{}: its rotation is not a quaternion and is left out", user));
        q = {0, 0, 0, 1};
    } else if (std::abs(length - 1.0f) > 1e-6f) {
        q /= length;  // files store few digits
    }
    node.rotation = glm::quat(q.w, q.x, q.y, q.z);
}

/// The light of KHR_lights_punctual.
int lightOf(Import& import, const std::string& user, const tinygltf::Node& n) {
    const auto* extension = findExtension(n.extensions, "KHR_lights_punctual");
    if (!extension || !extension->Get("light").IsInt()) return -1;
    return import.lights[checkedIndex(user, "light", extension->Get("light").Get<int>(), import.lights.size())];
}

/// Scene mesh of a model mesh, numbered in order of first use.
int meshOf(Import& import, const std::string& user, const tinygltf::Node& n) {
    if (n.mesh < 0) return -1;
    int& slot = import.meshes[checkedIndex(user, "mesh", n.mesh, import.meshes.size())];
    if (slot < 0) {
        slot = int(import.scene().meshes.size());
        import.scene().meshes.emplace_back();
    }
    return slot;
}

/// The node's camera, or -1. A camera used by several nodes is copied for each: the first copy keeps its name, the
/// others are named after their node.
int cameraOf(Import& import, const std::string& user, const tinygltf::Node& n) {
    if (n.camera < 0) return -1;
    const std::size_t model = checkedIndex(user, "camera", n.camera, import.cameras.size());
    const int slot = import.cameras[model];
    if (slot < 0) return -1;
    std::vector<Camera>& cameras = import.scene().cameras;
    if (import.placedCameras[model]) {
        import.geometry.charge(sizeof(Camera) + cameras[std::size_t(slot)].name.size() + n.name.size());
        Camera again = cameras[std::size_t(slot)];
        if (!n.name.empty()) again.name = n.name;
        cameras.push_back(std::move(again));
        return int(cameras.size()) - 1;
    }
    import.placedCameras[model] = true;
    std::string& name = cameras[std::size_t(slot)].name;
    if (name.empty()) name = n.name;
    return slot;
}

Node importNode(Import& import, const std::string& user, const tinygltf::Node& n, int parent) {
    Node node;
    node.name = n.name;
    node.parent = parent;
    importTransform(import, user, n, node);
    node.mesh = meshOf(import, user, n);
    node.light = lightOf(import, user, n);
    node.camera = cameraOf(import, user, n);
    if (n.skin >= 0) import.warn("skins are not supported; skinned meshes keep their rest pose");
    return node;
}

}  // namespace

void importNodes(Import& import) {
    const auto& nodes = import.model.nodes;
    import.nodes.assign(nodes.size(), -1);
    import.meshes.assign(import.model.meshes.size(), -1);
    import.placedCameras.assign(import.cameras.size(), false);
    struct Visit {
        int node;
        int parent;
    };
    std::vector<Visit> stack;
    const auto push = [&](const std::vector<int>& list, int parent) {
        for (auto i = list.rbegin(); i != list.rend(); ++i) stack.push_back({*i, parent});
    };
    push(rootNodes(import), -1);
    while (!stack.empty()) {
        const Visit visit = stack.back();
        stack.pop_back();
        const std::size_t index = checkedIndex("the hierarchy", "node", visit.node, nodes.size());
        const std::string user = title("node", index, nodes[index].name);
        if (import.nodes[index] >= 0) refuseMalformed("{} has two parents or is part of a cycle", user);
        import.nodes[index] = import.scene().addNode(importNode(import, user, nodes[index], visit.parent));
        push(nodes[index].children, import.nodes[index]);
    }
}

}  // namespace probegi::io

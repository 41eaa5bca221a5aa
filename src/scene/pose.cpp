#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <limits>

#include "scene/animation.h"

namespace probegi {

namespace {

struct Transform {
    glm::vec3 translation;
    glm::quat rotation;
    glm::vec3 scale;
};

glm::mat4 toMatrix(const Transform& t) {
    const glm::mat3 r = glm::mat3_cast(glm::normalize(t.rotation));
    return {glm::vec4(r[0] * t.scale.x, 0), glm::vec4(r[1] * t.scale.y, 0), glm::vec4(r[2] * t.scale.z, 0),
            glm::vec4(t.translation, 1)};
}

void apply(const AnimationChannel& channel, float seconds, Transform& t) {
    const glm::vec4 v = sampleChannel(channel, seconds);
    switch (channel.path) {
        case AnimationPath::translation:
            t.translation = glm::vec3(v);
            break;
        case AnimationPath::rotation:
            t.rotation = glm::quat(v.w, v.x, v.y, v.z);
            break;
        case AnimationPath::scale:
            t.scale = glm::vec3(v);
            break;
    }
}

std::vector<glm::mat4> worldMatrices(const Scene& scene, float seconds) {
    std::vector<Transform> local;
    local.reserve(scene.nodes.size());
    for (const Node& n : scene.nodes) local.push_back({n.translation, n.rotation, n.scale});
    for (const AnimationChannel& channel : scene.animations) apply(channel, seconds, local[std::size_t(channel.node)]);

    std::vector<glm::mat4> world(scene.nodes.size());
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        const Node& node = scene.nodes[i];
        const glm::mat4 m = node.matrix ? *node.matrix : toMatrix(local[i]);
        world[i] = node.parent < 0 ? m : world[std::size_t(node.parent)] * m;
    }
    return world;
}

/// Unit vector along v, or `fallback` if v is zero after scaling.
glm::vec3 directionOr(glm::vec3 v, glm::vec3 fallback) {
    const float length = glm::length(v);
    return length > 1e-20f && std::isfinite(length) ? v / length : fallback;
}

PlacedLight placeLight(const Light& light, const glm::mat4& world) {
    PlacedLight placed;
    placed.type = light.type;
    placed.position = glm::vec3(world[3]);
    placed.direction = directionOr(-glm::vec3(world[2]), {0, 0, -1});
    placed.intensity = light.intensity;
    placed.range = light.range;
    placed.cosInner = std::cos(light.innerConeAngle);
    placed.cosOuter = std::max(std::cos(light.outerConeAngle), 0.0f);
    return placed;
}

PlacedCamera placeCamera(const Camera& camera, const glm::mat4& world) {
    const glm::vec3 position(world[3]);
    const glm::vec3 forward = directionOr(-glm::vec3(world[2]), {0, 0, -1});
    PlacedCamera placed = lookAt(position, position + forward, camera.yfov);
    placed.name = camera.name;
    placed.forward = forward;
    // A sheared node's Y axis may not be orthogonal to its Z axis.
    const glm::vec3 up(world[1]);
    placed.up = directionOr(up - glm::dot(up, forward) * forward, placed.up);
    return placed;
}

/// A transform to a point or a line draws nothing and has no normals: files hide objects by scaling to zero.
bool collapsed(const glm::mat4& m) {
    const glm::vec3 x(m[0]), y(m[1]), z(m[2]);
    return glm::cross(x, y) == glm::vec3(0) && glm::cross(y, z) == glm::vec3(0) && glm::cross(z, x) == glm::vec3(0);
}

Bounds boundsOf(const Scene& scene, const std::vector<Instance>& instances) {
    constexpr float kMax = std::numeric_limits<float>::max();
    Bounds b{glm::vec3(kMax), glm::vec3(-kMax)};
    bool any = false;
    for (const Instance& instance : instances) {
        for (const Primitive& p : scene.meshes[std::size_t(instance.mesh)].primitives) {
            // By index, to ignore vertices that no triangle uses.
            for (const std::uint32_t index : p.indices) {
                const glm::vec3 v(instance.toWorld * glm::vec4(p.positions[index], 1));
                b.lower = glm::min(b.lower, v);
                b.upper = glm::max(b.upper, v);
            }
            any = any || !p.indices.empty();
        }
    }
    return any ? b : Bounds{};
}

}  // namespace

ScenePose poseAt(const Scene& scene, float seconds) {
    const std::vector<glm::mat4> world = worldMatrices(scene, seconds);
    ScenePose pose;
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        const Node& node = scene.nodes[i];
        if (node.mesh >= 0 && !collapsed(world[i])) pose.instances.push_back({node.mesh, int(i), world[i]});
        if (node.light >= 0) pose.lights.push_back(placeLight(scene.lights[std::size_t(node.light)], world[i]));
        if (node.camera >= 0) pose.cameras.push_back(placeCamera(scene.cameras[std::size_t(node.camera)], world[i]));
    }
    pose.bounds = boundsOf(scene, pose.instances);
    return pose;
}

void moveChildren(const Scene& scene, std::vector<bool>& moves) {
    for (std::size_t i = 0; i < moves.size(); ++i)  // parents come first
        if (scene.nodes[i].parent >= 0 && moves[std::size_t(scene.nodes[i].parent)]) moves[i] = true;
}

std::vector<bool> animatedNodes(const Scene& scene) {
    std::vector<bool> moves(scene.nodes.size(), false);
    for (const AnimationChannel& channel : scene.animations) moves[std::size_t(channel.node)] = true;
    moveChildren(scene, moves);
    return moves;
}

std::vector<Bounds> movingBounds(const Scene& scene, const ScenePose& pose) {
    const std::vector<bool> moves = animatedNodes(scene);
    std::vector<Bounds> bounds;
    for (const Instance& instance : pose.instances)
        if (instance.node >= 0 && moves[std::size_t(instance.node)]) bounds.push_back(boundsOf(scene, {instance}));
    return bounds;
}

std::vector<Bounds> triangleBounds(const Scene& scene, const ScenePose& pose) {
    std::vector<Bounds> bounds;
    bounds.reserve(triangleCount(scene, pose));
    for (const Instance& instance : pose.instances) {
        for (const Primitive& p : scene.meshes[std::size_t(instance.mesh)].primitives) {
            const auto corner = [&](std::size_t i) {
                return glm::vec3(instance.toWorld * glm::vec4(p.positions[p.indices[i]], 1.0f));
            };
            for (std::size_t i = 0; i + 2 < p.indices.size(); i += 3) {
                const glm::vec3 a = corner(i), b = corner(i + 1), c = corner(i + 2);
                bounds.push_back({glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c))});
            }
        }
    }
    return bounds;
}

std::size_t triangleCount(const Scene& scene, const ScenePose& pose) {
    std::size_t count = 0;
    for (const Instance& instance : pose.instances) {
        for (const Primitive& p : scene.meshes[std::size_t(instance.mesh)].primitives) count += p.indices.size() / 3;
    }
    return count;
}

}  // namespace probegi

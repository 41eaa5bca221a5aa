#include "geometry/scene_geometry.h"

#include "core/sentence.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <utility>

#include "scene/animation.h"

namespace probegi {

SceneGeometry SceneGeometry::gather(const Scene& scene, const ScenePose& pose, const InstancePredicate& movable) {
    SceneGeometry result;
    result.materials = makeSurfaceMaterials(scene);
    std::vector<int> uses(scene.meshes.size(), 0);
    for (const Instance& instance : pose.instances) ++uses[std::size_t(instance.mesh)];
    std::vector<int> groupOf(scene.meshes.size(), -1);
    for (const Instance& instance : pose.instances) {
        const std::size_t mesh = std::size_t(instance.mesh);
        const bool merged = uses[mesh] == 1 && !(movable && movable(instance));
        if (merged || !invertible(instance.toWorld)) {
            appendMesh(result.world, scene.meshes[mesh], instance.toWorld, result.materials);
            continue;
        }
        if (groupOf[mesh] < 0) {
            groupOf[mesh] = int(result.groups.size());
            appendMesh(result.groups.emplace_back(), scene.meshes[mesh], glm::mat4(1.0f), result.materials);
        }
        if (result.groups[std::size_t(groupOf[mesh])].empty()) continue;
        result.placements.push_back({groupOf[mesh], instance.node, instance.toWorld, normalMatrix(instance.toWorld)});
    }
    return result;
}

Bounds SceneGeometry::bounds() const {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    Bounds all{glm::vec3(kInfinity), glm::vec3(-kInfinity)};
    if (!world.empty()) all = world.bounds();
    std::vector<Bounds> boxes;
    for (const SurfaceGroup& group : groups) boxes.push_back(group.bounds());
    for (const Placement& placement : placements) {
        const Bounds& box = boxes[std::size_t(placement.group)];
        const glm::mat3 linear(placement.toWorld);
        const glm::vec3 half = 0.5f * box.size();
        const glm::vec3 centre(placement.toWorld * glm::vec4(box.centre(), 1.0f));
        const glm::vec3 reach =
            glm::abs(linear[0]) * half.x + glm::abs(linear[1]) * half.y + glm::abs(linear[2]) * half.z;
        all.lower = glm::min(all.lower, centre - reach);
        all.upper = glm::max(all.upper, centre + reach);
    }
    return all.lower.x <= all.upper.x ? all : Bounds{};
}

InstancePredicate animatedInstances(const Scene& scene) {
    return movableInstances(scene, true, {});
}

InstancePredicate movableInstances(const Scene& scene, bool animated, std::span<const int> nodes) {
    std::vector<bool> moves = animated ? animatedNodes(scene) : std::vector<bool>(scene.nodes.size(), false);
    for (const int node : nodes) moves[std::size_t(node)] = true;
    moveChildren(scene, moves);
    return [moves = std::move(moves)](const Instance& instance) {
        return instance.node >= 0 && moves[std::size_t(instance.node)];
    };
}

Result<std::vector<Placement>> movedPlacements(std::vector<Placement> placements, const ScenePose& pose) {
    std::map<int, glm::mat4> transforms;
    for (const Instance& instance : pose.instances) transforms[instance.node] = instance.toWorld;
    for (Placement& placement : placements) {
        const auto found = transforms.find(placement.node);
        if (found == transforms.end())
            return fail(ErrorCode::invalidArgument,
                        sentence("the pose does not place node ", placement.node, ", so it is not one of this scene"));
        if (!invertible(found->second))
            return fail(ErrorCode::invalidArgument,
                        sentence("the pose flattens node ", placement.node, "; move it out of sight instead"));
        placement.toWorld = found->second;
        placement.normalToWorld = normalMatrix(found->second);
    }
    return placements;
}

Result<void> checkNodes(const Scene& scene, std::span<const int> nodes, const char* what) {
    for (const int node : nodes)
        if (node < 0 || std::size_t(node) >= scene.nodes.size())
            return fail(ErrorCode::invalidArgument,
                        sentence(what, " has ", node, ", but the scene has ", scene.nodes.size(), " nodes"));
    return {};
}

bool invertible(const glm::mat4& m) {
    const glm::vec3 x(m[0]), y(m[1]), z(m[2]);
    const float volume = std::abs(glm::dot(glm::cross(x, y), z));
    return volume > 1e-6f * glm::length(x) * glm::length(y) * glm::length(z);
}

}  // namespace probegi

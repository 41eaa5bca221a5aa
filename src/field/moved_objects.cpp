#include "field/moved_objects.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <optional>
#include <utility>

namespace probegi {

namespace {

using Corners = std::array<glm::vec3, 8>;

Bounds joined(const Bounds& a, const Bounds& b) {
    return {glm::min(a.lower, b.lower), glm::max(a.upper, b.upper)};
}

// The corners of the mesh's box, in the world.
Corners cornersOf(const Scene& scene, const Instance& instance) {
    const Bounds box = meshBounds(scene.meshes[std::size_t(instance.mesh)]);
    Corners corners;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::vec3 corner((i & 1 ? box.upper : box.lower).x, (i & 2 ? box.upper : box.lower).y,
                               (i & 4 ? box.upper : box.lower).z);
        corners[i] = glm::vec3(instance.toWorld * glm::vec4(corner, 1.0f));
    }
    return corners;
}

Bounds boxAround(const Corners& corners) {
    Bounds box{corners[0], corners[0]};
    for (const glm::vec3& corner : corners) box = joined(box, {corner, corner});
    return box;
}

float diagonalOf(const Corners& corners) {
    float longest = 0;
    for (std::size_t i = 0; i < corners.size() / 2; ++i)
        longest = std::max(longest, glm::distance(corners[i], corners[7 - i]));
    return longest;
}

// `before` and `after`: null where it is not there; not both.
MovedObject compared(const Scene& scene, const Instance* before, const Instance* after) {
    if (!before || !after) {
        const Instance& there = before ? *before : *after;
        const Corners corners = cornersOf(scene, there);
        return {there.node, 1.0f, diagonalOf(corners), boxAround(corners)};
    }
    const Corners then = cornersOf(scene, *before), now = cornersOf(scene, *after);
    MovedObject moved{after->node, 1.0f, std::max(diagonalOf(then), diagonalOf(now)),
                      joined(boxAround(then), boxAround(now))};
    if (before->mesh != after->mesh) return moved;
    float way = 0;
    for (std::size_t i = 0; i < then.size(); ++i) way = std::max(way, glm::distance(then[i], now[i]));
    moved.size = moved.extent > 0 ? std::min(way / moved.extent, 1.0f) : 0.0f;
    return moved;
}

}  // namespace

Bounds meshBounds(const Mesh& mesh) {
    std::optional<Bounds> box;
    for (const Primitive& primitive : mesh.primitives)
        for (const std::uint32_t index : primitive.indices) {
            const glm::vec3 p = primitive.positions[index];
            box = box ? joined(*box, {p, p}) : Bounds{p, p};
        }
    return box.value_or(Bounds{});
}

std::vector<MovedObject> movedObjects(const Scene& scene, const ScenePose& before, const ScenePose& after,
                                      float least) {
    std::map<int, std::pair<const Instance*, const Instance*>> byNode;
    for (const Instance& instance : before.instances) byNode[instance.node].first = &instance;
    for (const Instance& instance : after.instances) byNode[instance.node].second = &instance;
    std::vector<MovedObject> all;
    for (const auto& entry : byNode) {
        const Instance *was = entry.second.first, *is = entry.second.second;
        if (was && is && was->mesh == is->mesh && was->toWorld == is->toWorld) continue;
        const MovedObject moved = compared(scene, was, is);
        if (moved.size >= least) all.push_back(moved);
    }
    return all;
}

}  // namespace probegi

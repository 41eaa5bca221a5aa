#include "sdf/placed_primitives.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <unordered_map>

#include "scene/checks.h"
#include "sdf/solid.h"

namespace probegi {

namespace {

/// How far axes may differ in length, or from right angles, and still count as scaled alike: rounding of transforms.
constexpr float kAlike = 1e-3f;

bool scaledAlike(const glm::mat4& m) {
    const glm::vec3 x(m[0]), y(m[1]), z(m[2]);
    const float square = glm::dot(x, x);
    const auto like = [&](float a, float b) { return std::abs(a - b) <= kAlike * square; };
    return square > 0 && like(glm::dot(y, y), square) && like(glm::dot(z, z), square) && like(glm::dot(x, y), 0) &&
           like(glm::dot(y, z), 0) && like(glm::dot(z, x), 0);
}

std::string rides(std::size_t number, const SdfPrimitive& primitive) {
    return sentence(checks::title("primitive", number, primitive.name), " rides on node '",
                    checks::quotable(primitive.node), "', ");
}

Error refused(std::size_t number, const SdfPrimitive& primitive, const char* why) {
    return fail(ErrorCode::invalidArgument, rides(number, primitive) + why);
}

/// The first node of that name that has a mesh, else any of that name; -1: none.
int findNode(const Scene& scene, const std::string& name) {
    int found = -1;
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        if (scene.nodes[i].name != name) continue;
        if (scene.nodes[i].mesh >= 0) return int(i);
        if (found < 0) found = int(i);
    }
    return found;
}

}  // namespace

Bounds boundsOf(const kernels::SdfSolid& solid) {
    if (solid.shape == kernels::kSdfPlane) return {glm::vec3(-kernels::kSdfFar), glm::vec3(kernels::kSdfFar)};
    glm::vec3 reach = halfExtents(solid);
    if (solid.shape != kernels::kSdfSphere) {
        glm::vec3 turned(0.0f);
        for (int axis = 0; axis < 3; ++axis) {
            glm::vec3 along(0.0f);
            along[axis] = reach[axis];
            turned += glm::abs(kernels::sdfToWorld(solid, along));
        }
        reach = turned;
    }
    return {solid.centre - reach, solid.centre + reach};
}

Result<PlacedPrimitives> PlacedPrimitives::create(const SdfScene& sdf, const Scene& scene, const ScenePose& pose) {
    if (auto valid = validate(sdf); !valid) return valid.error();
    PlacedPrimitives placed;
    placed.m_primitives = sdf.primitives;
    for (std::size_t i = 0; i < sdf.primitives.size(); ++i) {
        const SdfPrimitive& primitive = sdf.primitives[i];
        placed.m_solids.push_back(makeSolid(primitive));
        if (primitive.node.empty()) continue;
        const int node = findNode(scene, primitive.node);
        if (node < 0) return refused(i, primitive, "which the scene does not have; correct the name or remove it");
        if (scene.nodes[std::size_t(node)].mesh < 0) {
            return refused(i, primitive, "which has no mesh; name the node whose mesh it stands for");
        }
        placed.m_riders.push_back({i, node});
    }
    if (auto moved = placed.setPose(pose); !moved) return moved.error();
    return placed;
}

Result<void> PlacedPrimitives::setPose(const ScenePose& pose) {
    std::unordered_map<int, const glm::mat4*> frames;
    if (!m_riders.empty())
        for (const Instance& instance : pose.instances) frames.emplace(instance.node, &instance.toWorld);
    std::vector<kernels::SdfSolid> solids = m_solids;
    for (const Rider& rider : m_riders) {
        const SdfPrimitive& primitive = m_primitives[rider.primitive];
        const auto frame = frames.find(rider.node);
        if (frame == frames.end()) {
            return refused(rider.primitive, primitive,
                           "which the pose does not have; give the pose of the tracer's scene, with all that rides");
        }
        if (!scaledAlike(*frame->second)) {
            return refused(rider.primitive, primitive,
                           "which is not scaled alike along all axes; give it a node that is, or let it stand in the "
                           "world");
        }
        solids[rider.primitive] = makeSolid(primitive, *frame->second);
    }
    m_solids = std::move(solids);
    return {};
}

Bounds PlacedPrimitives::bounds() const {
    Bounds all{glm::vec3(kernels::kSdfFar), glm::vec3(-kernels::kSdfFar)};
    for (const kernels::SdfSolid& solid : m_solids) {
        if (solid.shape == kernels::kSdfPlane) continue;
        const Bounds one = boundsOf(solid);
        all = {glm::min(all.lower, one.lower), glm::max(all.upper, one.upper)};
    }
    return all.lower.x <= all.upper.x ? all : Bounds{};
}

}  // namespace probegi

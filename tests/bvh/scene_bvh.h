#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "bvh/traversal.h"
#include "probegi/scene.h"

namespace probegi::test {

inline Context makeContext(int threads = 1) {
    return Context::create({.threads = threads, .log = {}, .progress = {}}).value();
}

/// Triangles of one space and one opacity.
struct SceneTriangles {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec2> uvs;
    std::vector<std::uint32_t> indices;
    std::vector<int> materials;  ///< by triangle

    TriangleSoup soup() const {
        return {.positions = positions.data(),
                .positionCount = positions.size(),
                .triangles = indices.data(),
                .triangleCount = indices.size() / 3};
    }
};

struct SceneGroup {
    SceneTriangles opaque, masked;

    void append(const Scene& scene, int mesh, const glm::mat4& toWorld);
    TriangleBvh build(const Context& context) const {
        return buildTriangleBvh(context, opaque.soup(), masked.soup()).value();
    }
};

/// A scene arranged as in the Embree tracer: meshes placed once are in world space, others are instances; with alpha
/// masks.
class SceneBvh {
public:
    SceneBvh(const Context& context, const Scene& scene, const ScenePose& pose);
    SceneBvh(const SceneBvh&) = delete;
    SceneBvh& operator=(const SceneBvh&) = delete;

    const TracedWorld& world() const { return m_world; }
    const SceneGroup& worldGroup() const { return m_worldGroup; }

private:
    bool alphaPasses(int instance, int primitive, glm::vec2 barycentric) const;

    const Scene& m_scene;
    SceneGroup m_worldGroup;
    std::vector<std::unique_ptr<SceneGroup>> m_groups;  ///< by mesh; null if it is not instanced
    std::vector<const SceneGroup*> m_groupOf;           ///< by instance
    TracedWorld m_world;
};

}  // namespace probegi::test

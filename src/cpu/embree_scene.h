#pragma once

#include <memory>
#include <vector>

#include "cpu/embree_handles.h"
#include "cpu/surface_mesh.h"

namespace probegi {

/// What Embree gets as the user pointer of a masked geometry.
struct EmbreeFilterData {
    const SurfaceMesh* mesh;
    const SurfaceMaterial* materials;
};

/// A scene as Embree and the surface look-ups see it: one group in world space with every mesh that is placed once,
/// and one group per mesh that is placed several times, each placement an Embree instance. Immutable once made.
/// Geometry numbers in every Embree scene are SurfaceGroup's; instances follow from kFirstInstance.
class EmbreeScene {
public:
    static constexpr unsigned kFirstInstance = 2;

    /// Errors: outOfMemory, invalidArgument (what Embree says).
    static Result<std::unique_ptr<EmbreeScene>> create(const Context& context, const Scene& scene,
                                                       const ScenePose& pose);

    struct Placement {
        int group;
        glm::mat4 toWorld;
        glm::mat3 normalToWorld;
    };

    RTCScene handle() const noexcept { return m_top.get(); }
    const Bounds& bounds() const noexcept { return m_bounds; }
    const std::vector<SurfaceMaterial>& materials() const noexcept { return m_materials; }
    const SurfaceGroup& world() const noexcept { return m_world; }
    const SurfaceGroup& group(const Placement& placement) const noexcept {
        return m_groups[std::size_t(placement.group)];
    }
    bool instanced() const noexcept { return !m_placements.empty(); }
    /// By Hit::instance.
    const Placement& placement(int instance) const noexcept {
        return m_placements[std::size_t(instance) - kFirstInstance];
    }

private:
    EmbreeScene() = default;
    void gather(const Scene& scene, const ScenePose& pose);
    void build();
    EmbreeSceneHandle makeScene(const SurfaceGroup& group);
    void attachMesh(RTCScene scene, const SurfaceMesh& mesh, int geometry);

    // Declared before the Embree objects, which read the meshes in place and so must go first.
    std::vector<SurfaceMaterial> m_materials;
    SurfaceGroup m_world;
    std::vector<SurfaceGroup> m_groups;
    std::vector<Placement> m_placements;
    std::vector<std::unique_ptr<EmbreeFilterData>> m_filters;
    Bounds m_bounds;
    EmbreeDevice m_device;
    std::vector<EmbreeSceneHandle> m_groupScenes;
    EmbreeSceneHandle m_top;
};

}  // namespace probegi

#pragma once

#include <memory>
#include <vector>

#include "cpu/embree_handles.h"
#include "probegi/tracer.h"
#include "surface/scene_geometry.h"

namespace probegi {

/// What Embree gets as the user pointer of a masked geometry.
struct EmbreeFilterData {
    const SurfaceMesh* mesh;
    const SurfaceMaterial* materials;
};

/// A SceneGeometry as Embree sees it: each placement is an Embree instance. Immutable once made.
/// Geometry numbers in every Embree scene are SurfaceGroup's; instances follow from kFirstInstance.
class EmbreeScene {
public:
    static constexpr unsigned kFirstInstance = 2;

    /// Errors: outOfMemory, invalidArgument (what Embree says).
    static Result<std::unique_ptr<EmbreeScene>> create(const Context& context, const Scene& scene,
                                                       const ScenePose& pose);

    RTCScene handle() const noexcept { return m_top.get(); }
    const Bounds& bounds() const noexcept { return m_bounds; }
    const SceneGeometry& geometry() const noexcept { return m_geometry; }
    bool instanced() const noexcept { return !m_geometry.placements.empty(); }
    /// By Hit::instance.
    const Placement& placement(int instance) const noexcept {
        return m_geometry.placements[std::size_t(instance) - kFirstInstance];
    }

private:
    EmbreeScene() = default;
    void build();
    EmbreeSceneHandle makeScene(const SurfaceGroup& group);
    void attachMesh(RTCScene scene, const SurfaceMesh& mesh, int geometry);

    // Declared before the Embree objects, which read the meshes in place and so must go first.
    SceneGeometry m_geometry;
    std::vector<std::unique_ptr<EmbreeFilterData>> m_filters;
    Bounds m_bounds;
    EmbreeDevice m_device;
    std::vector<EmbreeSceneHandle> m_groupScenes;
    EmbreeSceneHandle m_top;
};

}  // namespace probegi

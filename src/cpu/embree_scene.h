#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "cpu/embree_handles.h"
#include "geometry/scene_geometry.h"
#include "probegi/tracer.h"

namespace probegi {

/// User data of a masked Embree geometry.
struct EmbreeFilterData {
    const SurfaceMesh* mesh;
    const SurfaceMaterial* materials;
};

/// A SceneGeometry as Embree sees it: each placement is an Embree instance.
/// Geometry numbers in every Embree scene are SurfaceGroup's; instances follow from kFirstInstance.
class EmbreeScene {
public:
    static constexpr unsigned kFirstInstance = 2;

    /// With `movable`, the instances that it selects are placed, and the top level is built for changes.
    /// Errors: outOfMemory, invalidArgument (Embree's errors).
    static Result<std::unique_ptr<EmbreeScene>> create(const Context& context, const Scene& scene,
                                                       const ScenePose& pose, const InstancePredicate& movable = {});

    /// Moves the placements. Errors: those of movedPlacements, and Embree's.
    Result<void> place(const ScenePose& pose);

    /// Bytes that Embree has allocated since the scene was made, freed ones included: a deterministic measure of build
    /// cost.
    std::int64_t allocatedBytes() const noexcept { return m_allocated; }

    RTCScene handle() const noexcept { return m_top.get(); }
    const Bounds& bounds() const noexcept { return m_bounds; }
    const SceneGeometry& geometry() const noexcept { return m_geometry; }
    bool instanced() const noexcept { return !m_geometry.placements.empty(); }
    /// By Hit::instance.
    const Placement& placement(int instance) const noexcept {
        return m_geometry.placements[std::size_t(instance) - kFirstInstance];
    }

private:
    explicit EmbreeScene(const Context& context) : m_context(context) {}
    void build(bool topMoves);
    void commitTop();
    /// Embree's errors since the last call.
    Result<void> check();
    EmbreeSceneHandle makeScene(const SurfaceGroup& group, bool moves);
    void attachMesh(RTCScene scene, const SurfaceMesh& mesh, int geometry);

    Context m_context;
    std::atomic<std::int64_t> m_allocated{0};
    // Declared before the Embree objects, which read the meshes in place and so must be destroyed first.
    SceneGeometry m_geometry;
    std::vector<std::unique_ptr<EmbreeFilterData>> m_filters;
    Bounds m_bounds;
    EmbreeDevice m_device;
    std::vector<EmbreeSceneHandle> m_groupScenes;
    EmbreeSceneHandle m_top;
};

}  // namespace probegi

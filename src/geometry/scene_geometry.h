#pragma once

#include <functional>
#include <vector>

#include "geometry/surface_mesh.h"

namespace probegi {

/// A placed group of triangles.
struct Placement {
    int group = -1;  ///< index into SceneGeometry::groups
    int node = -1;   ///< index into Scene::nodes: the node that moves it
    glm::mat4 toWorld{1.0f};
    glm::mat3 normalToWorld{1.0f};
};

/// Selects instances that must not be merged into the world.
using InstancePredicate = std::function<bool(const Instance&)>;

/// A scene's triangles for tracers and surface look-ups: one world-space group of all static meshes placed once, and
/// one group per mesh that is placed several times or moves, with its placements. Refers to the scene's texels.
struct SceneGeometry {
    std::vector<SurfaceMaterial> materials;  ///< in the scene's order
    SurfaceGroup world;
    std::vector<SurfaceGroup> groups;
    std::vector<Placement> placements;  ///< of groups with triangles; every transform is invertible

    /// The scene must be valid and outlive the result. Instances selected by `movable` are placed even if their mesh
    /// occurs once, so that a backend moves them by changing a placement. A singular (flattening) transform is always
    /// applied to the mesh.
    static SceneGeometry gather(const Scene& scene, const ScenePose& pose, const InstancePredicate& movable = {});

    /// Total bounds, metres; boxes of placed groups are transformed as boxes. Zero-sized without triangles.
    Bounds bounds() const;

    const SurfaceGroup& group(const Placement& placement) const noexcept {
        return groups[std::size_t(placement.group)];
    }
};

/// The instances that the scene's animations move: their node or one of its ancestors has a channel.
InstancePredicate animatedInstances(const Scene& scene);
/// The instances of the given nodes and their descendants and, if `animated`, those that animations move. The nodes
/// must be the scene's.
InstancePredicate movableInstances(const Scene& scene, bool animated, std::span<const int> nodes);

/// The placements with their nodes' transforms in `pose`. Errors: invalidArgument (a node that the pose does not place,
/// or with a singular transform).
Result<std::vector<Placement>> movedPlacements(std::vector<Placement> placements, const ScenePose& pose);
/// Errors: invalidArgument (no such node in the scene; `what` names the list).
Result<void> checkNodes(const Scene& scene, std::span<const int> nodes, const char* what);

/// Whether a transform is invertible up to rounding; one that flattens the mesh is not.
bool invertible(const glm::mat4& m);

}  // namespace probegi

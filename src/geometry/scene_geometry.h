#pragma once

#include <functional>
#include <vector>

#include "geometry/surface_mesh.h"

namespace probegi {

/// A group of triangles somewhere in the world.
struct Placement {
    int group = -1;  ///< index into SceneGeometry::groups
    int node = -1;   ///< index into Scene::nodes: whose transform moves it
    glm::mat4 toWorld{1.0f};
    glm::mat3 normalToWorld{1.0f};
};

/// Names instances that must stay apart from the merged world.
using InstancePredicate = std::function<bool(const Instance&)>;

/// A scene's triangles as tracers and surface look-ups see them: one group in world space with every mesh that is
/// placed once, and one group per mesh that is placed several times or moves, with its placements. Refers to the
/// scene's texels.
struct SceneGeometry {
    std::vector<SurfaceMaterial> materials;  ///< in the scene's order
    SurfaceGroup world;
    std::vector<SurfaceGroup> groups;
    std::vector<Placement> placements;  ///< of groups with triangles; every transform has an inverse

    /// The scene must be valid and outlive the result. Instances that `movable` names are placed even where their mesh
    /// occurs once, so that a backend moves them by changing a placement. A transform without an inverse (flattening)
    /// is applied to the mesh in any case.
    static SceneGeometry gather(const Scene& scene, const ScenePose& pose, const InstancePredicate& movable = {});

    /// Of everything, metres; boxes of placed groups are transformed as boxes. Zero-sized where there are no triangles.
    Bounds bounds() const;

    const SurfaceGroup& group(const Placement& placement) const noexcept {
        return groups[std::size_t(placement.group)];
    }
};

/// The instances that the scene's animations move: their node or one of its ancestors has a channel.
InstancePredicate animatedInstances(const Scene& scene);
/// The instances of some nodes and of what hangs below them, and where `animated` says so those that animations move.
/// The nodes must be the scene's.
InstancePredicate movableInstances(const Scene& scene, bool animated, std::span<const int> nodes);

/// The placements where `pose` has their nodes. Errors: invalidArgument (a node that the pose does not place, or one
/// whose transform has no inverse).
Result<std::vector<Placement>> movedPlacements(std::vector<Placement> placements, const ScenePose& pose);
/// Errors: invalidArgument (a node that the scene has not; `what` names the list).
Result<void> checkNodes(const Scene& scene, std::span<const int> nodes, const char* what);

/// Whether a transform can be undone. One that flattens the mesh cannot, up to rounding.
bool invertible(const glm::mat4& m);

}  // namespace probegi

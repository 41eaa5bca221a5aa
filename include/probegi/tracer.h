#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "probegi/context.h"
#include "probegi/export.h"
#include "probegi/scene.h"
#include "probegi/shared/rays.h"

namespace probegi {

/// A triangle that sends light, in world space.
struct EmissiveTriangle {
    glm::vec3 corner{0.0f};      ///< metres
    std::uint32_t upTo = 0;      ///< share of all power of this triangle and those before it, times 2^32 - 1
    glm::vec3 edge1{0.0f};       ///< to the second corner; the front is where cross(edge1, edge2) points
    std::int32_t material = -1;  ///< as Surface::material of its hits, >= 0
    glm::vec3 edge2{0.0f};       ///< to the third corner
};

/// The surfaces of a tracer that send light, so that a probe can look at them instead of waiting for its rays to meet
/// them. A triangle is chosen with probability proportional to its area times the mean luminance of its material: how
/// likely a point was to be chosen then follows from the material of a hit, without knowing which triangle it was.
struct EmitterSet {
    std::vector<EmissiveTriangle> triangles;  ///< empty: nothing to look at
    std::vector<float>
        luminance;              ///< by material: of its emission, mean over its area, W sr^-1 m^-2; 0: not in the set
    float inversePower = 0.0f;  ///< 1 over the sum of area times luminance; 0 where the set is empty

    bool empty() const noexcept { return triangles.empty(); }
    /// Density per square metre of choosing a point of this material; 0 where it is never chosen.
    float density(std::int32_t material) const noexcept {
        return std::size_t(material) < luminance.size() ? luminance[std::size_t(material)] * inversePower : 0.0f;
    }
};

/// Fills what follows from triangles (corners, edges, materials) and `luminance`, which must have an entry for each of
/// their materials. Every surface of a material whose luminance is not 0 must be among the triangles. Triangles that
/// send nothing are kept and never chosen; where none sends anything the set is empty.
PROBEGI_API EmitterSet makeEmitterSet(std::vector<EmissiveTriangle> triangles, std::vector<float> luminance);

/// The first axis of the pipeline: what a ray hits. Implementations are immutable once made (but for MovableTracer) and
/// safe to use from many threads at once. Batches may have any length; the spans must be equally long. A tracer that
/// failed (a lost GPU) says so: what it left in the spans is then meaningless, and whoever asked passes the error on.
class PROBEGI_API Tracer {
public:
    virtual ~Tracer() = default;
    /// Closest hit of each ray. Alpha masks are honoured.
    virtual Result<void> closestHits(std::span<const Ray> rays, std::span<Hit> hits) const = 0;
    /// Whether anything lies between near and far: 1 blocked, 0 free. Alpha masks are honoured.
    virtual Result<void> occluded(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const = 0;
    /// Resolves valid hits; entries of missed rays are left as they are.
    virtual Result<void> surfaces(std::span<const Ray> rays, std::span<const Hit> hits,
                                  std::span<Surface> out) const = 0;
    /// The same with textures filtered over the cone of `spread` radians around each ray: for rays that stand alone for
    /// a pixel, whose distant textures would shimmer. A tracer that does not filter gives what surfaces() gives.
    virtual Result<void> filteredSurfaces(std::span<const Ray> rays, std::span<const Hit> hits, float /*spread*/,
                                          std::span<Surface> out) const {
        return surfaces(rays, hits, out);
    }
    /// Of everything that can be hit.
    virtual Bounds bounds() const = 0;
    /// The emitters that are worth looking at, for FieldDesc::emitterSamples; null: the tracer knows none. Lives as
    /// long as the tracer.
    virtual const EmitterSet* emitters() const { return nullptr; }
};

/// The lights that are not surfaces: punctual lights and the sky.
struct Lighting {
    std::vector<PlacedLight> lights;
    Sky sky;
};

/// A Tracer whose instances move: doors, lifts, whatever keeps its shape.
class PROBEGI_API MovableTracer : public Tracer {
public:
    /// Moves the movable instances to where `pose` has them; all others stay. The trees over the triangles are kept,
    /// only the one over the instances is made anew, so it costs little. Must not run beside any other call of the
    /// tracer. What a probe knows of distances follows slowly: see FieldEvent::largeObjectChange.
    /// Errors: invalidArgument (the pose is of another scene, or flattens an instance), outOfMemory. The tracer is then
    /// as it was.
    virtual Result<void> setPose(const ScenePose& pose) = 0;
};

/// Which instances a tracer keeps apart so that they can move; all others are merged where that is faster.
struct MovableDesc {
    bool animated = true;  ///< those of nodes that the scene's animations move
    /// Nodes that move though no animation does; their children move with them. Read during the call only.
    std::span<const int> nodes{};
};

/// Triangles by Embree on the CPU, with textures. Meshes used once are merged, shared ones become instances.
/// The scene must be valid and outlive the tracer. Errors: outOfMemory, invalidArgument, unsupported (built without
/// Embree).
PROBEGI_API Result<std::unique_ptr<Tracer>> makeEmbreeTracer(const Context& context, const Scene& scene,
                                                             const ScenePose& pose);

/// The same for a scene in which things move. Errors: those, and invalidArgument (a node that the scene has not).
PROBEGI_API Result<std::unique_ptr<MovableTracer>> makeMovableEmbreeTracer(const Context& context, const Scene& scene,
                                                                           const ScenePose& pose,
                                                                           const MovableDesc& desc = {});

}  // namespace probegi

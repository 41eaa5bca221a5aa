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

/// An emissive triangle in world space.
struct EmissiveTriangle {
    glm::vec3 corner{0.0f};      ///< metres
    std::uint32_t upTo = 0;      ///< cumulative share of the total power up to and including this triangle, times 2^32
                                 ///< - 1
    glm::vec3 edge1{0.0f};       ///< to the second corner; cross(edge1, edge2) points to the front
    std::int32_t material = -1;  ///< as Surface::material of its hits, >= 0
    glm::vec3 edge2{0.0f};       ///< to the third corner
};

/// A tracer's emissive surfaces, so that probes can sample them directly instead of waiting for rays to hit them. A
/// triangle is chosen with probability proportional to its area times its material's mean luminance, so the density of
/// a point follows from the hit's material alone, whichever triangle it is on.
struct EmitterSet {
    std::vector<EmissiveTriangle> triangles;  ///< empty: nothing to sample
    std::vector<float> luminance;  ///< by material: mean of its emission over its area, W sr^-1 m^-2; 0: not in the set
    float inversePower = 0.0f;     ///< 1 over the sum of area times luminance; 0 where the set is empty

    bool empty() const noexcept { return triangles.empty(); }
    /// Sampling density per square metre on this material; 0 if it is never chosen.
    float density(std::int32_t material) const noexcept {
        return std::size_t(material) < luminance.size() ? luminance[std::size_t(material)] * inversePower : 0.0f;
    }
};

/// Makes a set from triangles (corners, edges, materials) and `luminance`, which must have an entry for each of their
/// materials; the rest is computed. Every surface of a material with nonzero luminance must be among the triangles.
/// Triangles that emit nothing are kept but never chosen; if none emits, the set is empty.
PROBEGI_API EmitterSet makeEmitterSet(std::vector<EmissiveTriangle> triangles, std::vector<float> luminance);

/// The first axis of the pipeline: what a ray hits. Implementations are immutable (except MovableTracer) and
/// thread-safe. Batches may have any length; the spans must be equally long. After an error (a lost GPU) the contents
/// of the output spans are undefined; callers pass the error on.
class PROBEGI_API Tracer {
public:
    virtual ~Tracer() = default;
    /// Closest hit of each ray. Alpha masks are honoured.
    virtual Result<void> closestHits(std::span<const Ray> rays, std::span<Hit> hits) const = 0;
    /// Whether anything lies between near and far: 1 blocked, 0 clear. Alpha masks are honoured.
    virtual Result<void> occluded(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const = 0;
    /// Resolves valid hits; entries of missed rays are not written.
    virtual Result<void> surfaces(std::span<const Ray> rays, std::span<const Hit> hits,
                                  std::span<Surface> out) const = 0;
    /// The same with textures filtered over a cone of `spread` radians around each ray, for primary rays, whose distant
    /// textures would otherwise alias. By default, the same as surfaces().
    virtual Result<void> filteredSurfaces(std::span<const Ray> rays, std::span<const Hit> hits, float /*spread*/,
                                          std::span<Surface> out) const {
        return surfaces(rays, hits, out);
    }
    /// World-space bounds of all that can be hit.
    virtual Bounds bounds() const = 0;
    /// The emitters to sample (FieldDesc::emitterSamples); null: none known. Valid as long as the tracer.
    virtual const EmitterSet* emitters() const { return nullptr; }
};

/// Lights other than emissive surfaces: punctual lights and the sky.
struct Lighting {
    std::vector<PlacedLight> lights;
    Sky sky;
};

/// A Tracer whose instances can move rigidly or be scaled, but not deform.
class PROBEGI_API MovableTracer : public Tracer {
public:
    /// Moves the movable instances to their transforms in `pose`; all others stay. Cheap: only the top-level tree is
    /// rebuilt. Must not run concurrently with any other call of the tracer. The field's distances follow slowly: see
    /// FieldEvent::largeObjectChange. Errors: invalidArgument (the pose is of another scene, or flattens an instance),
    /// outOfMemory; the tracer is then unchanged.
    virtual Result<void> setPose(const ScenePose& pose) = 0;
};

/// Which instances stay separate so that they can move; the others may be merged for speed.
struct MovableDesc {
    bool animated = true;  ///< instances of nodes that the scene's animations move
    /// Further nodes that can move, with their children. Read during the call only.
    std::span<const int> nodes{};
};

/// How a scene is traced on a GPU.
enum class TracerKind : std::uint8_t {
    automatic,  ///< ray query where it is in hardware, else the BVH
    bvh,        ///< the library's own wide, quantised BVH in compute; any device
    rayQuery,   ///< VK_KHR_ray_query
    sdf,        ///< primitives instead of triangles (probegi/sdf.h); only where a call takes them
};

/// Triangles by Embree on the CPU, with textures. Meshes used once are merged, shared ones become instances.
/// The scene must be valid and outlive the tracer. Errors: outOfMemory, invalidArgument, unsupported (built without
/// Embree).
PROBEGI_API Result<std::unique_ptr<Tracer>> makeEmbreeTracer(const Context& context, const Scene& scene,
                                                             const ScenePose& pose);

/// The same for a scene with moving instances. Errors: as above, and invalidArgument (no such node in the scene).
PROBEGI_API Result<std::unique_ptr<MovableTracer>> makeMovableEmbreeTracer(const Context& context, const Scene& scene,
                                                                           const ScenePose& pose,
                                                                           const MovableDesc& desc = {});

}  // namespace probegi

#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <string>
#include <vector>

#include "probegi/export.h"
#include "probegi/image.h"
#include "probegi/result.h"
#include "probegi/scene.h"
#include "probegi/tracer.h"

namespace probegi {

/// Shapes with an exact Euclidean signed distance (SDFDDGI, section 3.1), each in a frame of its own around the origin.
enum class SdfShape : std::uint8_t {
    box,
    roundedBox,  ///< a box whose edges and corners are rounded
    sphere,
    capsule,   ///< all within a radius of a segment along the frame's Y axis
    cylinder,  ///< solid, with flat ends, along the frame's Y axis
    plane,     ///< all below the frame's plane y = 0: solid ground
};

/// Texels along each side of SdfPrimitive::faces.
constexpr int kSdfFaceSide = 6;

/// A solid that stands for part of a scene. Its distance is negative inside.
struct SdfPrimitive {
    std::string name{};
    SdfShape shape = SdfShape::box;
    glm::vec3 centre{0.0f};                      ///< metres
    glm::quat rotation{1.0f, 0.0f, 0.0f, 0.0f};  ///< of the shape's frame, unit
    /// Metres, > 0. Boxes: half the extents, rounding included. Sphere: x is the radius. Capsule: x is the radius, y
    /// half the length of the segment (0 allowed). Cylinder: x is the radius, y half the height. Plane: unused. What a
    /// shape does not use may be anything.
    glm::vec3 halfSize{0.5f};
    float rounding = 0.0f;   ///< roundedBox: radius of its edges, metres, 0 to the smallest half size
    glm::vec3 albedo{0.5f};  ///< linear RGB, 0..1
    /// Boxes only: the albedo of the faces in place of the one above, linear RGB, 0..1, between texels bilinear; empty:
    /// one colour all over. Faces -X, +X, -Y, +Y, -Z, +Z of the frame, each kSdfFaceSide rows of as many texels: rows
    /// run along the next axis after the face's (Y of X, Z of Y, X of Z), one after another along the last one. Files
    /// and tracers keep the square roots in 8 bits a channel.
    std::vector<glm::vec3> faces{};
    glm::vec3 emission{0.0f};  ///< radiance of its surface, W sr^-1 m^-2, 0 to 1e20
    /// Name of the node on which it rides: centre and rotation are then in that node's frame, which may turn, move and
    /// be scaled alike along all axes. Empty: it stands in the world.
    std::string node{};
    bool pinned = false;  ///< fitting keeps it as it is
};

/// A scene of primitives: the union of solids.
struct SdfScene {
    std::vector<SdfPrimitive> primitives{};  ///< at most kMaxSdfPrimitives
};

constexpr int kMaxSdfPrimitives = 4096;
/// Bytes of geometry of a primitive on a GPU, without colours.
constexpr std::size_t kSdfPrimitiveBytes = 48;

/// Checks every value. Errors: malformed, naming the primitive and the fault.
PROBEGI_API Result<void> validate(const SdfScene& sdf);

/// Signed distance to the union, metres: exact outside, and inside never more than the distance to its surface.
/// Without primitives 1e30. The scene must be valid, and no primitive may ride on a node.
PROBEGI_API float signedDistance(const SdfScene& sdf, glm::vec3 point);

/// Traces the surface of the union of solids on the CPU, by exact intersection. A ray that starts outside hits the
/// first solid that it enters; one that starts inside hits the union's surface from within, which is solid wall
/// (Surface::backface), at the point where it leaves the last of the solids that overlap or touch on its way; it is
/// occluded, too, if it enters another solid before. Hit::primitive counts SdfScene::primitives, Hit::geometry is 1 for
/// hits from within, the roughness is 1. bounds() are without planes. emitters() are the faces of boxes that emit
/// (null: none), and Surface::material is the primitive's number on those and -1 elsewhere. setPose() moves the
/// primitives that ride on nodes of `scene`, which is read during the call only. Errors: malformed (validate()),
/// invalidArgument (a primitive rides on a node that the scene lacks, that has no mesh or that is not scaled alike
/// along all axes), outOfMemory.
PROBEGI_API Result<std::unique_ptr<MovableTracer>> makeSdfTracer(const Context& context, const SdfScene& sdf,
                                                                 const Scene& scene, const ScenePose& pose);

/// The solids of a scene of primitives at one moment, against which look-ups test which probes a point sees
/// (FieldSettings::blockers). Immutable; any number of fields may share them.
class PROBEGI_API SdfBlockers {
public:
    std::size_t size() const noexcept;
    ~SdfBlockers();

    struct Impl;
    explicit SdfBlockers(std::unique_ptr<Impl> impl);
    const Impl& impl() const noexcept { return *m_impl; }

private:
    std::unique_ptr<Impl> m_impl;
};

/// Places primitives for LeakGuard::sdfShadow; of things that move, again for each pose. Errors: as makeSdfTracer().
PROBEGI_API Result<std::shared_ptr<const SdfBlockers>> placeSdf(const SdfScene& sdf, const Scene& scene,
                                                                const ScenePose& pose);

/// Reads primitives from JSON (docs/sdf.md describes the format). They have passed validate(). Errors: fileNotFound,
/// fileUnreadable, malformed (with the primitive's number and name), unsupported (a later version of the format),
/// outOfMemory.
PROBEGI_API Result<SdfScene> loadSdf(const std::filesystem::path& path, const ReadLimits& limits = {});
/// Writes them, as writeFile() does, one primitive a line. Errors: malformed (validate()), writeFailed.
PROBEGI_API Result<void> saveSdf(const std::filesystem::path& path, const SdfScene& sdf);

}  // namespace probegi

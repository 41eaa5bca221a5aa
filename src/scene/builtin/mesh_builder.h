#pragma once

#include <functional>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "probegi/scene.h"

namespace probegi::builtin {

/// Builds one primitive from shapes. Every solid shape is closed (its edges match exactly) and faces outwards.
/// uv0 is in metres, so that the material's uv transform alone sets the texture's size; v runs downwards.
class MeshBuilder {
public:
    explicit MeshBuilder(int material) { m_primitive.material = material; }
    /// Continues a primitive from take().
    explicit MeshBuilder(Primitive primitive) : m_primitive(std::move(primitive)) {}

    /// Applied to all vertices added from now on; must not mirror.
    void setTransform(const glm::mat4& toMesh) { m_transform = toMesh; }

    std::uint32_t vertex(glm::vec3 position, glm::vec3 normal, glm::vec2 uv);
    /// Omits triangles without area.
    void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);

    /// Flat face, corners counter-clockwise; uvs projected along the largest component of the normal.
    void face(std::span<const glm::vec3> convexCorners);
    void quad(glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d);
    void box(glm::vec3 lower, glm::vec3 upper);
    /// A box with edges bevelled at 45 degrees, which catch the light.
    void bevelledBox(glm::vec3 lower, glm::vec3 upper, float bevel);

    bool empty() const { return m_primitive.indices.empty(); }
    Primitive take() { return std::move(m_primitive); }

private:
    Primitive m_primitive;
    glm::mat4 m_transform{1.0f};
};

/// Factor on the radius of a lathed shape at an angle (radians) and a height (metres).
using RadiusFactor = std::function<float(float angle, float height)>;

/// Solid of revolution about +Y. The profile is (radius, height), from bottom to top; radius 0 at both ends closes it.
/// A point given twice is a sharp edge. `segments` >= 3.
void addLathe(MeshBuilder& out, std::span<const glm::vec2> profile, int segments, const RadiusFactor& factor = nullptr);

/// The part of a wall above a row of round arches, standing along +X from 0 to bays * bayWidth, centred on z = 0.
struct Arcade {
    int bays = 1;
    float bayWidth = 3.0f;   ///< metres, pier to pier
    float radius = 1.2f;     ///< of the arches, < bayWidth / 2
    float springing = 3.0f;  ///< height where the arches begin
    float top = 5.0f;        ///< > springing + radius
    float depth = 0.6f;
    int segments = 24;  ///< per arch
};
void addArcade(MeshBuilder& out, const Arcade& arcade);

/// A prism along +X: the convex outline is (z, y), counter-clockwise seen from +X.
void addPrism(MeshBuilder& out, std::span<const glm::vec2> outline, float x0, float x1);

/// A surface of columns x rows quads; `at` maps (0..1, 0..1) to positions, uv0 = that times `uvSize`. Not a solid:
/// meant for double-sided materials.
void addSheet(MeshBuilder& out, int columns, int rows, glm::vec2 uvSize,
              const std::function<glm::vec3(float u, float v)>& at);

/// Geodesic sphere of unit circumradius: an icosahedron split `levels` times, 20 * 4^levels triangles.
void addGeodesicSphere(MeshBuilder& out, int levels, const std::function<float(glm::vec3)>& radius);

}  // namespace probegi::builtin

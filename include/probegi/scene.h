#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "probegi/export.h"
#include "probegi/image.h"
#include "probegi/result.h"
#include "probegi/volume.h"

namespace probegi {

/// 8-bit RGBA texture image, row-major, top row first (glTF's uv origin is the top left corner).
struct TextureImage {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgba{};  ///< 4 * width * height
    std::string name{};
};

enum class Wrap : std::uint8_t { repeat, clampToEdge, mirroredRepeat };

/// A use of a TextureImage by a material slot.
struct TextureRef {
    int image = -1;    ///< index into Scene::images; -1: no texture, only the factor
    int texCoord = 0;  ///< uv set, 0 or 1
    Wrap wrapU = Wrap::repeat;
    Wrap wrapV = Wrap::repeat;
    bool nearest = false;         ///< true: no bilinear filtering
    glm::mat3 uvTransform{1.0f};  ///< KHR_texture_transform as a matrix on (u, v, 1)
};

/// BLEND is treated as MASK with cutoff 0.5 by every ray (docs/conventions.md says why).
enum class AlphaMode : std::uint8_t { opaque, mask, blend };

/// glTF 2.0 metallic-roughness material. Textures multiply the factors.
struct Material {
    std::string name{};
    glm::vec4 baseColor{1.0f};  ///< linear RGB + alpha, 0..1
    float metallic = 0.0f;      ///< 0..1
    float roughness = 1.0f;     ///< 0..1, perceptual (alpha = roughness^2)
    glm::vec3 emission{0.0f};   ///< radiance, W sr^-1 m^-2, >= 0 (emissiveFactor x KHR_materials_emissive_strength)
    float normalScale = 1.0f;
    TextureRef baseColorTexture{};          ///< sRGB + linear alpha
    TextureRef metallicRoughnessTexture{};  ///< linear; B metallic, G roughness
    TextureRef normalTexture{};             ///< linear, tangent space
    TextureRef emissiveTexture{};           ///< sRGB
    AlphaMode alphaMode = AlphaMode::opaque;
    float alphaCutoff = 0.5f;  ///< for AlphaMode::mask, 0..1
    bool doubleSided = false;  ///< false: probes treat the back as solid wall (radiance 0, shortened distance)
};

/// Indexed triangles with one material. Normals, tangents and uvs are empty or the size of positions.
struct Primitive {
    std::vector<glm::vec3> positions{};  ///< metres, mesh space
    std::vector<glm::vec3> normals{};    ///< unit; empty: the geometric normal
    std::vector<glm::vec4>
        tangents{};  ///< xyz unit, w = handedness +-1; empty: derived from uvs where a normal map needs them
    std::vector<glm::vec2> uv0;
    std::vector<glm::vec2> uv1;
    std::vector<std::uint32_t> indices{};  ///< 3 per triangle, counter-clockwise seen from the front
    int material = 0;                      ///< index into Scene::materials
};

struct Mesh {
    std::string name{};
    std::vector<Primitive> primitives{};
};

enum class LightType : std::uint8_t { directional, point, spot };

/// KHR_lights_punctual. Light travels along the node's -Z axis.
struct Light {
    std::string name{};
    LightType type = LightType::point;
    glm::vec3 intensity{1.0f};    ///< directional: W m^-2 at normal incidence ("lx"); point, spot: W sr^-1 ("cd")
    float range = 0.0f;           ///< metres; 0: unlimited
    float innerConeAngle = 0.0f;  ///< radians, spot, 0..outer
    float outerConeAngle = 0.785398163f;  ///< radians, spot, up to pi/2
};

/// Perspective pinhole. The node's -Z axis is the viewing direction, +Y is up.
struct Camera {
    std::string name{};
    float yfov = 1.0471976f;  ///< vertical, radians, 0..pi
    float znear = 0.01f;      ///< metres
};

/// A node of the hierarchy. Parents come before children in Scene::nodes.
struct Node {
    std::string name{};
    int parent = -1;
    glm::vec3 translation{0.0f};
    glm::quat rotation{1.0f, 0.0f, 0.0f, 0.0f};
    glm::vec3 scale{1.0f};
    std::optional<glm::mat4> matrix{};  ///< if set, replaces translation, rotation and scale (and is not animated)
    int mesh = -1;
    int light = -1;
    int camera = -1;
};

enum class AnimationPath : std::uint8_t { translation, rotation, scale };
enum class Interpolation : std::uint8_t { step, linear, cubicSpline };

/// One keyframed property of one node. Values: xyz0 or quaternion xyzw; cubicSpline has three per key (in-tangent,
/// value, out-tangent), as in glTF.
struct AnimationChannel {
    int node = -1;
    AnimationPath path = AnimationPath::translation;
    Interpolation interpolation = Interpolation::linear;
    std::vector<float> times{};  ///< seconds, strictly increasing
    std::vector<glm::vec4> values{};
};

/// Light from infinitely far away.
struct Sky {
    glm::vec3 radiance{0.0f};  ///< W sr^-1 m^-2, 0 to 1e20; multiplies the image, if there is one
    HdrImage image{};  ///< equirectangular, centre column = direction -Z, top row = +Y, 0 to 1e20 with the factor;
                       ///< empty: constant
    bool textured() const { return image.width > 0; }
    bool black() const { return radiance.x <= 0 && radiance.y <= 0 && radiance.z <= 0; }
};

/// Everything visible or light-emitting: plain data, freely editable.
struct Scene {
    std::string name{};
    std::vector<Mesh> meshes{};
    std::vector<Material> materials{};
    std::vector<TextureImage> images{};
    std::vector<Light> lights{};
    std::vector<Camera> cameras{};
    std::vector<Node> nodes{};
    std::vector<AnimationChannel> animations{};
    Sky sky{};
    std::optional<VolumeDesc> grid{};        ///< a probe grid that came with the scene; empty: placed automatically
    std::vector<VolumeDesc> furtherGrids{};  ///< more of them, at most 31; only where there is a `grid`
    float exposure = 1.0f;                   ///< suggested tone-map exposure for pictures of this scene
    /// Position of this scene's (0, 0, 0) in the coordinates of its file, metres. Nonzero only if loadScene() moved a
    /// scene that was far from the origin.
    glm::vec3 origin{0.0f};

    /// Adds a root node and returns its index.
    int addNode(Node node) {
        nodes.push_back(std::move(node));
        return int(nodes.size()) - 1;
    }
};

/// A mesh placed in the world.
struct Instance {
    int mesh = -1;
    int node = -1;
    glm::mat4 toWorld{1.0f};
};

/// A punctual light in world space.
struct PlacedLight {
    LightType type = LightType::point;
    glm::vec3 position{0.0f};       ///< metres; unused for directional
    glm::vec3 direction{0, -1, 0};  ///< unit, the direction in which the light travels; unused for point
    glm::vec3 intensity{0.0f};      ///< as Light::intensity
    float range = 0.0f;             ///< metres, 0: unlimited
    float cosInner = 1.0f;
    float cosOuter = 0.0f;
};

/// A camera in world space.
struct PlacedCamera {
    std::string name{};
    glm::vec3 position{0.0f};
    glm::vec3 forward{0, 0, -1};  ///< unit
    glm::vec3 up{0, 1, 0};        ///< unit, orthogonal to forward
    float yfov = 1.0471976f;      ///< vertical, radians
};

struct Bounds {
    glm::vec3 lower{0.0f};
    glm::vec3 upper{0.0f};
    glm::vec3 size() const { return upper - lower; }
    glm::vec3 centre() const { return 0.5f * (lower + upper); }
};

/// The scene at one moment: the hierarchy and its animations resolved to world space.
struct ScenePose {
    std::vector<Instance> instances{};
    std::vector<PlacedLight> lights{};
    std::vector<PlacedCamera> cameras{};
    Bounds bounds;  ///< of all triangles, metres; zero-sized for a scene without triangles
};

/// Checks every index, array length and value of the scene. Errors: malformed, naming the first fault. Everything that
/// takes a Scene relies on this having passed.
PROBEGI_API Result<void> validate(const Scene& scene);

/// Resolves hierarchy and animation at a time in seconds (clamped to the animation's span). The scene must be valid.
PROBEGI_API ScenePose poseAt(const Scene& scene, float seconds = 0.0f);

/// World bounds of each instance that the scene's animations move, for FieldControl::setMoving.
PROBEGI_API std::vector<Bounds> movingBounds(const Scene& scene, const ScenePose& pose);

/// World bounds of each triangle of the pose, for MaskDesc::occluders.
PROBEGI_API std::vector<Bounds> triangleBounds(const Scene& scene, const ScenePose& pose);

/// Triangles over all instances of the pose.
PROBEGI_API std::size_t triangleCount(const Scene& scene, const ScenePose& pose);

/// A camera at `from` that looks at `at`. `yfov` in radians.
PROBEGI_API PlacedCamera lookAt(glm::vec3 from, glm::vec3 at, float yfov = 1.0471976f);

/// A camera outside the bounds that sees all of them, for scenes without a camera.
PROBEGI_API PlacedCamera overviewCamera(const Bounds& bounds);

}  // namespace probegi

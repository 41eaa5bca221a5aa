#pragma once

#include <vector>

#include "geometry/mip_maps.h"
#include "geometry/texture_sampler.h"

namespace probegi {

/// How a material's triangles affect rays.
enum class Opacity : std::uint8_t {
    opaque,  ///< every hit counts
    masked,  ///< a hit counts if the texture's alpha reaches the cutoff
    absent,  ///< no hit ever counts: the triangles are omitted
};

/// A Material with its textures resolved, ready for look-ups. Refers to the scene's texels and to `mips`.
struct SurfaceMaterial {
    SurfaceMaterial() = default;
    SurfaceMaterial(const Scene& scene, const Material& material, const MipMaps& mips = {});

    bool normalMapped() const noexcept { return normalTexture.present() && normalScale != 0.0f; }
    bool emissive() const noexcept { return emission.x > 0 || emission.y > 0 || emission.z > 0; }
    /// Whether any texture reads the second uv set.
    bool usesSecondUv() const noexcept;

    glm::vec3 baseColor{1.0f};
    float metallic = 0.0f;
    glm::vec3 emission{0.0f};
    float roughness = 1.0f;
    float normalScale = 1.0f;
    float textureAlphaCutoff = 0.0f;  ///< threshold for the texture's alpha: the cutoff over the alpha factor
    Opacity opacity = Opacity::opaque;
    bool doubleSided = false;
    TextureSampler baseColorTexture;
    TextureSampler metallicRoughnessTexture;
    TextureSampler normalTexture;
    TextureSampler emissiveTexture;
};

/// All materials of a scene, in its order. Without `mips`, look-ups use level 0.
std::vector<SurfaceMaterial> makeSurfaceMaterials(const Scene& scene, const MipMaps& mips = {});

}  // namespace probegi

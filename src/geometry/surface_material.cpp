#include "geometry/surface_material.h"

namespace probegi {

namespace {

TextureSampler makeSampler(const Scene& scene, const TextureRef& ref, TexelKind kind, const MipMaps& mips) {
    if (ref.image < 0) return TextureSampler();
    return TextureSampler(ref, scene.images[std::size_t(ref.image)], mips.of(ref.image, kind));
}

/// BLEND counts as MASK with cutoff 0.5 (docs/conventions.md says why).
float alphaCutoff(const Material& material) {
    switch (material.alphaMode) {
        case AlphaMode::opaque:
            return 0.0f;
        case AlphaMode::mask:
            return material.alphaCutoff;
        case AlphaMode::blend:
            return 0.5f;
    }
    return 0.0f;
}

}  // namespace

SurfaceMaterial::SurfaceMaterial(const Scene& scene, const Material& material, const MipMaps& mips)
    : baseColor(material.baseColor),
      metallic(material.metallic),
      emission(material.emission),
      roughness(material.roughness),
      normalScale(material.normalScale),
      doubleSided(material.doubleSided),
      baseColorTexture(makeSampler(scene, material.baseColorTexture, TexelKind::color, mips)),
      metallicRoughnessTexture(makeSampler(scene, material.metallicRoughnessTexture, TexelKind::data, mips)),
      normalTexture(makeSampler(scene, material.normalTexture, TexelKind::data, mips)),
      emissiveTexture(makeSampler(scene, material.emissiveTexture, TexelKind::color, mips)) {
    const float cutoff = alphaCutoff(material);
    if (cutoff <= 0.0f) return;
    // Alpha tests cost time at every candidate hit, so only materials whose alpha straddles the cutoff get one.
    const glm::vec2 range = baseColorTexture.alphaRange() * material.baseColor.a;
    if (range.x >= cutoff) return;
    opacity = range.y < cutoff ? Opacity::absent : Opacity::masked;
    textureAlphaCutoff = cutoff / material.baseColor.a;
}

bool SurfaceMaterial::usesSecondUv() const noexcept {
    return baseColorTexture.texCoord() == 1 || metallicRoughnessTexture.texCoord() == 1 ||
           normalTexture.texCoord() == 1 || emissiveTexture.texCoord() == 1;
}

std::vector<SurfaceMaterial> makeSurfaceMaterials(const Scene& scene, const MipMaps& mips) {
    std::vector<SurfaceMaterial> materials;
    materials.reserve(scene.materials.size());
    for (const Material& material : scene.materials) materials.emplace_back(scene, material, mips);
    return materials;
}

}  // namespace probegi

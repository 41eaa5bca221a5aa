#include "scene/checks.h"

namespace probegi {

using namespace checks;

Result<void> validateImages(const Scene& scene) {
    for (std::size_t i = 0; i < scene.images.size(); ++i) {
        const TextureImage& image = scene.images[i];
        const std::string what = title("image", i, image.name);
        if (image.width < 1 || image.height < 1 || image.width > 65536 || image.height > 65536) {
            return malformed("{}: size {} x {} must be 1..65536 pixels each way", what, image.width, image.height);
        }
        const std::size_t expected = 4 * std::size_t(image.width) * std::size_t(image.height);
        if (image.rgba.size() != expected) {
            return malformed("{}: {} bytes of pixels where {} x {} RGBA needs {}", what, image.rgba.size(), image.width,
                             image.height, expected);
        }
    }
    return {};
}

namespace {

Result<void> validateTexture(const Scene& scene, const std::string& what, const char* slot, const TextureRef& ref) {
    if (!optionalIndex(ref.image, scene.images.size())) {
        return malformed("{}: {} texture uses image {}, but the scene has {}", what, slot, ref.image,
                         scene.images.size());
    }
    if (ref.texCoord != 0 && ref.texCoord != 1) {
        return malformed("{}: {} texture uses uv set {}; only 0 and 1 are supported", what, slot, ref.texCoord);
    }
    if (!finite(ref.uvTransform)) return malformed("{}: {} texture has a uv transform that is not finite", what, slot);
    return {};
}

Result<void> validateFactors(const std::string& what, const Material& m) {
    for (int c = 0; c < 4; ++c) {
        if (!within(m.baseColor[c], 0, 1)) {
            return malformed("{}: base colour {} must be 0..1 in every component", what, text(m.baseColor));
        }
    }
    if (!within(m.metallic, 0, 1)) return malformed("{}: metallic {:g} must be 0..1", what, m.metallic);
    if (!within(m.roughness, 0, 1)) return malformed("{}: roughness {:g} must be 0..1", what, m.roughness);
    if (!energy(m.emission)) {
        return malformed("{}: emission {} must be 0 to {:g}", what, text(m.emission), kBrightest);
    }
    if (!finite(m.normalScale)) return malformed("{}: normal scale {:g} must be finite", what, m.normalScale);
    if (!within(m.alphaCutoff, 0, 1)) return malformed("{}: alpha cutoff {:g} must be 0..1", what, m.alphaCutoff);
    return {};
}

}  // namespace

Result<void> validateMaterials(const Scene& scene) {
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        const Material& m = scene.materials[i];
        const std::string what = title("material", i, m.name);
        if (auto r = validateFactors(what, m); !r) return r;
        if (auto r = validateTexture(scene, what, "base colour", m.baseColorTexture); !r) return r;
        if (auto r = validateTexture(scene, what, "metallic-roughness", m.metallicRoughnessTexture); !r) return r;
        if (auto r = validateTexture(scene, what, "normal", m.normalTexture); !r) return r;
        if (auto r = validateTexture(scene, what, "emissive", m.emissiveTexture); !r) return r;
    }
    return {};
}

}  // namespace probegi

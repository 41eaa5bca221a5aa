#include "scene/checks.h"

namespace probegi {

using namespace checks;

Result<void> validateImages(const Scene& scene) {
    for (std::size_t i = 0; i < scene.images.size(); ++i) {
        const TextureImage& image = scene.images[i];
        const std::string what = title("image", i, image.name);
        if (image.width < 1 || image.height < 1 || image.width > 65536 || image.height > 65536) {
            return malformed(what, ": size ", image.width, " x ", image.height, " must be 1..65536 pixels per side");
        }
        const std::size_t expected = 4 * std::size_t(image.width) * std::size_t(image.height);
        if (image.rgba.size() != expected) {
            return malformed(what, ": ", image.rgba.size(), " bytes of pixels where ", image.width, " x ", image.height,
                             " RGBA needs ", expected);
        }
    }
    return {};
}

namespace {

Result<void> validateTexture(const Scene& scene, const std::string& what, const char* slot, const TextureRef& ref) {
    if (!optionalIndex(ref.image, scene.images.size())) {
        return malformed(what, ": ", slot, " texture uses image ", ref.image, ", but the scene has ",
                         scene.images.size());
    }
    if (ref.texCoord != 0 && ref.texCoord != 1) {
        return malformed(what, ": ", slot, " texture uses uv set ", ref.texCoord, "; only 0 and 1 are supported");
    }
    if (!finite(ref.uvTransform)) return malformed(what, ": ", slot, " texture has a uv transform that is not finite");
    return {};
}

Result<void> validateFactors(const std::string& what, const Material& m) {
    for (int c = 0; c < 4; ++c) {
        if (!within(m.baseColor[c], 0, 1)) {
            return malformed(what, ": base colour ", text(m.baseColor), " must be 0..1 in every component");
        }
    }
    if (!within(m.metallic, 0, 1)) return malformed(what, ": metallic ", m.metallic, " must be 0..1");
    if (!within(m.roughness, 0, 1)) return malformed(what, ": roughness ", m.roughness, " must be 0..1");
    if (!energy(m.emission)) return malformed(what, ": emission ", text(m.emission), " must be 0 to ", kBrightest);
    if (!finite(m.normalScale)) return malformed(what, ": normal scale ", m.normalScale, " must be finite");
    if (!within(m.alphaCutoff, 0, 1)) return malformed(what, ": alpha cutoff ", m.alphaCutoff, " must be 0..1");
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

#include <cmath>
#include <map>

#include "io/gltf_accessor.h"
#include "io/gltf_import.h"
#include "io/image_codec.h"

namespace probegi::io {

namespace {

/// Decodes each image on first use.
class Images {
public:
    explicit Images(Import& import) : m_import(import) {}

    /// Scene image of a model image.
    int use(const std::string& user, int source) {
        const std::size_t index = checkedIndex(user, "image", source, m_import.model.images.size());
        const auto [slot, isNew] = m_slots.try_emplace(index, int(m_slots.size()));
        if (isNew) m_import.scene().images.push_back(decode(index, m_import.model.images[index]));
        return slot->second;
    }

private:
    TextureImage decode(std::size_t index, const tinygltf::Image& image) {
        const std::string shown = !image.uri.empty() ? image.uri : image.name;
        try {
            const std::span<const std::uint8_t> bytes =
                image.bufferView >= 0 ? bytesOfView(m_import.model, image.bufferView) : std::span(image.image);
            m_import.pixels.charge(4 * texturePixels(bytes));
            TextureImage texture = decodeTexture(bytes);
            texture.name = shown;
            return texture;
        } catch (const Refused& refused) {
            refuse(refused.error.code, "{}: {}", title("image", index, shown), refused.error.message);
        }
    }

    Import& m_import;
    std::map<std::size_t, int> m_slots;
};

Wrap wrapOf(int mode) {
    switch (mode) {
        case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
            return Wrap::clampToEdge;
        case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
            return Wrap::mirroredRepeat;
        default:
            return Wrap::repeat;
    }
}

/// KHR_texture_transform: uv' = offset + rotation * scale * uv. A positive rotation turns the uvs counter-clockwise as
/// seen on the image, with v pointing down; the sample code in the extension's text has the opposite sign, but its
/// prose, test model and renderers agree on this one (KhronosGroup/glTF issue 1563).
glm::mat3 uvTransformOf(const tinygltf::Value& transform) {
    const double angle = numberOf(transform, "rotation", 0.0);
    const auto cosine = float(std::cos(angle));
    const auto sine = float(std::sin(angle));
    const glm::mat3 rotation(cosine, -sine, 0, sine, cosine, 0, 0, 0, 1);
    glm::mat3 scale(1.0f);
    scale[0][0] = float(numberOf(transform, "scale", 0, 1.0));
    scale[1][1] = float(numberOf(transform, "scale", 1, 1.0));
    glm::mat3 matrix = rotation * scale;
    matrix[2] = {float(numberOf(transform, "offset", 0, 0.0)), float(numberOf(transform, "offset", 1, 0.0)), 1.0f};
    return matrix;
}

void applySampler(Import& import, const std::string& user, int sampler, TextureRef& ref) {
    if (sampler < 0) return;
    const auto& samplers = import.model.samplers;
    const tinygltf::Sampler& s = samplers[checkedIndex(user, "sampler", sampler, samplers.size())];
    ref.wrapU = wrapOf(s.wrapS);
    ref.wrapV = wrapOf(s.wrapT);
    ref.nearest = s.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
}

/// Info: TextureInfo or NormalTextureInfo.
template <class Info>
TextureRef importTexture(Import& import, Images& images, const std::string& user, const Info& info) {
    TextureRef ref;
    if (info.index < 0) return ref;
    const auto& textures = import.model.textures;
    const tinygltf::Texture& texture = textures[checkedIndex(user, "texture", info.index, textures.size())];
    if (texture.source < 0) {
        import.warn(fmt::format("{}: a texture has no PNG or JPEG image; its factor alone is used", user));
        return ref;
    }
    ref.texCoord = info.texCoord;
    applySampler(import, user, texture.sampler, ref);
    if (const auto* transform = findExtension(info.extensions, "KHR_texture_transform")) {
        ref.uvTransform = uvTransformOf(*transform);
        ref.texCoord = int(numberOf(*transform, "texCoord", ref.texCoord));
    }
    if (ref.texCoord < 0 || ref.texCoord > 1) {
        import.warn(fmt::format("{}: a texture uses uv set {}, only 0 and 1 are supported; its factor alone is used",
                                user, ref.texCoord));
        return {};
    }
    ref.image = images.use(user, texture.source);
    return ref;
}

/// A factor that glTF limits to lower..upper; values outside are clamped, with a warning.
float factor(Import& import, const std::string& user, const char* member, double value, float upper = 1.0f) {
    const float number = finiteFloat(user, member, value);
    const float limited = std::clamp(number, 0.0f, upper);
    if (limited != number) import.warn(fmt::format("{}: {} {} was limited to {}", user, member, number, limited));
    return limited;
}

AlphaMode alphaModeOf(Import& import, const std::string& user, const std::string& mode) {
    if (mode == "MASK") return AlphaMode::mask;
    if (mode == "BLEND") return AlphaMode::blend;
    if (mode != "OPAQUE") import.warn(fmt::format("{}: unknown alpha mode; OPAQUE is used", user));
    return AlphaMode::opaque;
}

glm::vec3 emissionOf(Import& import, const std::string& user, const tinygltf::Material& m) {
    double strength = 1.0;
    if (const auto* extension = findExtension(m.extensions, "KHR_materials_emissive_strength")) {
        strength = numberOf(*extension, "emissiveStrength", 1.0);
    }
    glm::vec3 emission(0.0f);
    for (int c = 0; c < 3 && std::size_t(c) < m.emissiveFactor.size(); ++c) {
        emission[c] = factor(import, user, "emission", m.emissiveFactor[std::size_t(c)] * strength, checks::kBrightest);
    }
    return emission;
}

Material importMaterial(Import& import, Images& images, std::size_t index, const tinygltf::Material& m) {
    const std::string user = title("material", index, m.name);
    const tinygltf::PbrMetallicRoughness& pbr = m.pbrMetallicRoughness;
    Material out;
    out.name = m.name;
    for (int c = 0; c < 4 && std::size_t(c) < pbr.baseColorFactor.size(); ++c) {
        out.baseColor[c] = factor(import, user, "base colour", pbr.baseColorFactor[std::size_t(c)]);
    }
    out.metallic = factor(import, user, "metallic", pbr.metallicFactor);
    out.roughness = factor(import, user, "roughness", pbr.roughnessFactor);
    out.emission = emissionOf(import, user, m);
    out.normalScale = finiteFloat(user, "normal scale", m.normalTexture.scale);
    out.baseColorTexture = importTexture(import, images, user, pbr.baseColorTexture);
    out.metallicRoughnessTexture = importTexture(import, images, user, pbr.metallicRoughnessTexture);
    out.normalTexture = importTexture(import, images, user, m.normalTexture);
    out.emissiveTexture = importTexture(import, images, user, m.emissiveTexture);
    out.alphaMode = alphaModeOf(import, user, m.alphaMode);
    out.alphaCutoff = factor(import, user, "alpha cutoff", m.alphaCutoff);
    out.doubleSided = m.doubleSided;
    return out;
}

}  // namespace

void importMaterials(Import& import) {
    Images images(import);
    const auto& materials = import.model.materials;
    for (std::size_t i = 0; i < materials.size(); ++i) {
        import.scene().materials.push_back(importMaterial(import, images, i, materials[i]));
    }
}

}  // namespace probegi::io

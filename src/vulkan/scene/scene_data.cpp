#include "vulkan/scene/scene_data.h"

#include <bit>
#include <cstring>
#include <glm/gtc/matrix_inverse.hpp>
#include <map>

#include "geometry/lighting.h"
#include "kernels/shade/texture.h"

namespace probegi::vulkan {

namespace {

static_assert(std::endian::native == std::endian::little, "texels are copied as words with R in the lowest byte");
static_assert(sizeof(SurfaceVertex) == sizeof(kernels::GpuVertex));

/// Stores each image and each texture reference once.
class TexturePacker {
public:
    TexturePacker(const Scene& scene, const MipMaps& mips, SceneData& data)
        : m_scene(scene), m_mipMaps(mips), m_data(data) {}

    /// Returns the index of the record; -1 for no texture.
    int add(const TextureRef& ref, TexelKind kind) {
        if (ref.image < 0) return -1;
        const TextureImage& image = m_scene.images[std::size_t(ref.image)];
        const glm::mat3& m = ref.uvTransform;
        const std::span<const std::uint8_t> mips = m_mipMaps.of(ref.image, kind);
        const kernels::GpuTexture texture{
            packAddress(texelBytes(ref.image)),
            image.width,
            image.height,
            {m[0][0], m[1][0], m[2][0]},
            {m[0][1], m[1][1], m[2][1]},
            kernels::packTextureFlags(int(ref.wrapU), int(ref.wrapV), ref.nearest, ref.texCoord),
            mips.empty() ? 1 : kernels::mipLevels(image.width, image.height),
            mips.empty() ? glm::uvec2(0) : packAddress(mipBytes(ref.image, kind, mips))};
        Words words;
        std::memcpy(words.data(), &texture, sizeof(texture));
        const auto [found, isNew] = m_textures.try_emplace(words, int(m_data.textures.size()));
        if (isNew) m_data.textures.push_back(texture);
        return found->second;
    }

private:
    using Words = std::array<std::uint32_t, sizeof(kernels::GpuTexture) / 4>;

    std::uint64_t texelBytes(int image) {
        const auto [found, isNew] = m_images.try_emplace(image, 4 * std::uint64_t(m_data.texels.size()));
        if (isNew) append(m_scene.images[std::size_t(image)].rgba);
        return found->second;
    }

    std::uint64_t mipBytes(int image, TexelKind kind, std::span<const std::uint8_t> rgba) {
        const auto [found, isNew] = m_mips.try_emplace({image, kind}, 4 * std::uint64_t(m_data.texels.size()));
        if (isNew) append(rgba);
        return found->second;
    }

    void append(std::span<const std::uint8_t> rgba) {
        const std::size_t first = m_data.texels.size();
        m_data.texels.resize(first + rgba.size() / 4);
        std::memcpy(m_data.texels.data() + first, rgba.data(), rgba.size());
    }

    const Scene& m_scene;
    const MipMaps& m_mipMaps;
    SceneData& m_data;
    std::map<int, std::uint64_t> m_images;
    std::map<std::pair<int, TexelKind>, std::uint64_t> m_mips;
    std::map<Words, int> m_textures;
};

void packMesh(const SurfaceMesh& mesh, SceneData& data, std::vector<bool>& shown) {
    kernels::GpuMesh packed{std::uint32_t(data.vertices.size()), std::uint32_t(data.triangles.size()),
                            std::uint32_t(mesh.triangles.size()), -1, -1};
    for (const SurfaceVertex& v : mesh.vertices) data.vertices.push_back({v.position, v.normal, v.uv});
    for (const SurfaceTriangle& t : mesh.triangles) {
        data.triangles.push_back({{t.vertex[0], t.vertex[1], t.vertex[2]}, t.material});
        shown[t.material] = true;
    }
    if (!mesh.uv1.empty()) {
        packed.firstUv1 = int(data.uv1.size());
        data.uv1.insert(data.uv1.end(), mesh.uv1.begin(), mesh.uv1.end());
    }
    if (!mesh.tangents.empty()) {
        packed.firstTangent = int(data.tangents.size());
        data.tangents.insert(data.tangents.end(), mesh.tangents.begin(), mesh.tangents.end());
    }
    data.meshes.push_back(packed);
}

void packGroup(const SurfaceGroup& group, SceneData& data, std::vector<bool>& shown) {
    static_assert(SurfaceGroup::kOpaque == 0 && SurfaceGroup::kMasked == 1);
    packMesh(group.opaque, data, shown);
    packMesh(group.masked, data, shown);
}

kernels::GpuMaterial packMaterial(const SurfaceMaterial& m) {
    return {
        m.baseColor, m.metallic, m.emission, m.roughness, m.normalScale, m.textureAlphaCutoff, m.doubleSided ? 1 : 0,
        -1,          -1,         -1,         -1,          0.0f};
}

void reserve(const SceneGeometry& geometry, SceneData& data) {
    std::size_t vertices = 0, triangles = 0;
    const auto count = [&](const SurfaceGroup& group) {
        vertices += group.opaque.vertices.size() + group.masked.vertices.size();
        triangles += group.opaque.triangles.size() + group.masked.triangles.size();
    };
    count(geometry.world);
    for (const SurfaceGroup& group : geometry.groups) count(group);
    data.vertices.reserve(vertices);
    data.triangles.reserve(triangles);
}

}  // namespace

SceneData packScene(const SceneGeometry& geometry, const EmitterSet& emitters, const Scene& scene,
                    const MipMaps& mips) {
    SceneData data;
    reserve(geometry, data);
    std::vector<bool> shown(scene.materials.size(), false);
    packGroup(geometry.world, data, shown);
    for (const SurfaceGroup& group : geometry.groups) packGroup(group, data, shown);
    for (const Placement& placement : geometry.placements) data.instances.push_back(packInstance(placement));

    TexturePacker textures(scene, mips, data);
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        const Material& material = scene.materials[i];
        const SurfaceMaterial& surface = geometry.materials[i];
        kernels::GpuMaterial packed = packMaterial(surface);
        if (i < emitters.luminance.size()) packed.emittedLuminance = emitters.luminance[i];
        if (shown[i]) {
            packed.baseColorTexture = textures.add(material.baseColorTexture, TexelKind::color);
            packed.metallicRoughnessTexture = textures.add(material.metallicRoughnessTexture, TexelKind::data);
            if (surface.normalMapped()) packed.normalTexture = textures.add(material.normalTexture, TexelKind::data);
            if (surface.emissive()) packed.emissiveTexture = textures.add(material.emissiveTexture, TexelKind::color);
        }
        data.materials.push_back(packed);
    }
    for (int code = 0; code < 256; ++code) data.srgbTable.push_back(srgbToLinear(std::uint8_t(code)));
    data.emitters = packEmitters(emitters);
    return data;
}

std::vector<kernels::GpuEmitter> packEmitters(const EmitterSet& emitters) {
    std::vector<kernels::GpuEmitter> packed;
    packed.reserve(emitters.triangles.size());
    for (const EmissiveTriangle& t : emitters.triangles)
        packed.push_back({t.corner, t.upTo, t.edge1, t.material, t.edge2});
    return packed;
}

std::vector<kernels::GpuMaterial> packEmitterMaterials(const EmitterSet& emitters) {
    std::vector<kernels::GpuMaterial> packed;
    packed.reserve(emitters.luminance.size());
    for (const float luminance : emitters.luminance) {
        packed.push_back(packMaterial({}));
        packed.back().emittedLuminance = luminance;
    }
    return packed;
}

kernels::GpuInstance packInstance(const Placement& placement) {
    return {glm::mat4x3(placement.toWorld), glm::mat4x3(glm::affineInverse(placement.toWorld)), placement.normalToWorld,
            placement.group + 1};
}

std::vector<kernels::GpuLight> packLights(std::span<const PlacedLight> lights) {
    std::vector<kernels::GpuLight> packed;
    for (const PlacedLight& l : lights)
        packed.push_back({l.position, int(l.type), l.direction, l.range, l.intensity, l.cosInner, l.cosOuter});
    return packed;
}

kernels::GpuSky packSky(const Sky& sky) {
    return {sky.radiance, sky.textured() ? sky.image.width : 0, sky.textured() ? sky.image.height : 0};
}

}  // namespace probegi::vulkan

#include "field_file/content_hash.h"
#include "io/refused.h"
#include "probegi/field_file.h"

namespace probegi {

namespace {

void addTexture(ContentHash& hash, const Scene& scene, const TextureRef& texture) {
    hash.add(texture.image < 0);
    if (texture.image < 0) return;
    const TextureImage& image = scene.images[std::size_t(texture.image)];
    hash.add(image.width);
    hash.addList(image.rgba);
    hash.add(texture.texCoord);
    hash.add(texture.wrapU);
    hash.add(texture.wrapV);
    hash.add(texture.nearest);
    hash.add(texture.uvTransform);
}

/// What rays meet.
std::uint64_t geometryOf(const Scene& scene, const ScenePose& pose) {
    ContentHash hash;
    for (const Instance& instance : pose.instances) {
        hash.add(instance.toWorld);
        for (const Primitive& primitive : scene.meshes[std::size_t(instance.mesh)].primitives) {
            hash.addList(primitive.positions);
            hash.addList(primitive.indices);
            const Material& material = scene.materials[std::size_t(primitive.material)];
            hash.add(material.doubleSided);
            hash.add(material.alphaMode);
            if (material.alphaMode == AlphaMode::opaque) continue;
            hash.add(material.alphaCutoff);
            hash.add(material.baseColor.w);
            addTexture(hash, scene, material.baseColorTexture);
            hash.addList(primitive.uv0);
            hash.addList(primitive.uv1);
        }
    }
    return hash.value();
}

void addLights(ContentHash& hash, const Lighting& lighting) {
    for (const PlacedLight& light : lighting.lights) {
        hash.add(light.type);
        if (light.type != LightType::directional) hash.add(light.position);
        if (light.type != LightType::point) hash.add(light.direction);
        hash.add(light.intensity);
        hash.add(light.range);
        hash.add(light.cosInner);
        hash.add(light.cosOuter);
    }
    hash.add(lighting.sky.radiance);
    hash.add(lighting.sky.image.width);
    hash.addList(lighting.sky.image.pixels);
}

bool emits(const Material& material) {
    return material.emission.x > 0 || material.emission.y > 0 || material.emission.z > 0;
}

bool hasNormalMap(const Material& material) {
    return material.normalTexture.image >= 0 && material.normalScale != 0;
}

/// Of what probes see: their rays take all surfaces as matt (kernels/shade/resolve_surface.h), so that metalness and
/// roughness are not in it.
void addMaterial(ContentHash& hash, const Scene& scene, const Material& material) {
    hash.add(glm::vec3(material.baseColor));
    addTexture(hash, scene, material.baseColorTexture);
    hash.add(material.emission);
    if (emits(material)) addTexture(hash, scene, material.emissiveTexture);
    hash.add(hasNormalMap(material));
    if (!hasNormalMap(material)) return;
    hash.add(material.normalScale);
    addTexture(hash, scene, material.normalTexture);
}

/// Where the material's textures lie on a surface, and how light falls on it.
void addShading(ContentHash& hash, const Primitive& primitive, const Material& material) {
    hash.addList(primitive.normals);
    if (hasNormalMap(material)) hash.addList(primitive.tangents);
    bool read[2] = {false, false};
    const auto reads = [&](const TextureRef& texture) {
        if (texture.image >= 0) read[texture.texCoord == 1] = true;
    };
    reads(material.baseColorTexture);
    if (emits(material)) reads(material.emissiveTexture);
    if (hasNormalMap(material)) reads(material.normalTexture);
    if (read[0]) hash.addList(primitive.uv0);
    if (read[1]) hash.addList(primitive.uv1);
}

std::uint64_t lightOf(const Scene& scene, const ScenePose& pose, const Lighting& lighting) {
    ContentHash hash;
    addLights(hash, lighting);
    for (const Instance& instance : pose.instances)
        for (const Primitive& primitive : scene.meshes[std::size_t(instance.mesh)].primitives) {
            hash.add(primitive.material);
            addShading(hash, primitive, scene.materials[std::size_t(primitive.material)]);
        }
    for (const Material& material : scene.materials) addMaterial(hash, scene, material);
    return hash.value();
}

/// 0 stands for unknown.
std::uint64_t known(std::uint64_t hash) {
    return hash == 0 ? 1 : hash;
}

}  // namespace

Result<SceneFingerprint> fingerprintOf(const Scene& scene, const ScenePose& pose, const Lighting& lighting) {
    return io::guarded("the scene's fingerprint", [&] {
        return SceneFingerprint{known(geometryOf(scene, pose)), known(lightOf(scene, pose, lighting))};
    });
}

}  // namespace probegi

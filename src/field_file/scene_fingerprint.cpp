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

std::uint64_t lightOf(const Scene& scene, const ScenePose& pose, const Lighting& lighting) {
    ContentHash hash;
    addLights(hash, lighting);
    for (const Instance& instance : pose.instances)
        for (const Primitive& primitive : scene.meshes[std::size_t(instance.mesh)].primitives)
            hash.add(primitive.material);
    for (const Material& material : scene.materials) {
        hash.add(material.baseColor);
        hash.add(material.metallic);
        hash.add(material.emission);
        addTexture(hash, scene, material.baseColorTexture);
        addTexture(hash, scene, material.emissiveTexture);
    }
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

#include "bvh/scene_bvh.h"

#include <cmath>

namespace probegi::test {

namespace {

int wrapped(int i, int size, Wrap wrap) {
    const int period = wrap == Wrap::mirroredRepeat ? 2 * size : size;
    if (wrap == Wrap::clampToEdge) return std::clamp(i, 0, size - 1);
    const int k = ((i % period) + period) % period;
    return k < size ? k : 2 * size - 1 - k;
}

/// Alpha of a material's texture (nearest, or bilinear between texel centres), 0..1.
float textureAlpha(const Scene& scene, const TextureRef& ref, glm::vec2 uv) {
    if (ref.image < 0) return 1.0f;
    const TextureImage& image = scene.images[std::size_t(ref.image)];
    const glm::vec3 p = ref.uvTransform * glm::vec3(uv, 1.0f);
    const auto at = [&](int x, int y) {
        const int i = wrapped(x, image.width, ref.wrapU), j = wrapped(y, image.height, ref.wrapV);
        return float(image.rgba[4 * (std::size_t(j) * std::size_t(image.width) + std::size_t(i)) + 3]) / 255.0f;
    };
    const float x = p.x * float(image.width), y = p.y * float(image.height);
    if (ref.nearest) return at(int(std::floor(x)), int(std::floor(y)));
    const int i = int(std::floor(x - 0.5f)), j = int(std::floor(y - 0.5f));
    const float s = x - 0.5f - float(i), t = y - 0.5f - float(j);
    return (1 - t) * ((1 - s) * at(i, j) + s * at(i + 1, j)) + t * ((1 - s) * at(i, j + 1) + s * at(i + 1, j + 1));
}

}  // namespace

void SceneGroup::append(const Scene& scene, int mesh, const glm::mat4& toWorld) {
    for (const Primitive& p : scene.meshes[std::size_t(mesh)].primitives) {
        const bool isOpaque = scene.materials[std::size_t(p.material)].alphaMode == AlphaMode::opaque;
        SceneTriangles& to = isOpaque ? opaque : masked;
        const auto first = std::uint32_t(to.positions.size());
        for (const glm::vec3& position : p.positions)
            to.positions.push_back(glm::vec3(toWorld * glm::vec4(position, 1.0f)));
        to.uvs.resize(first);
        to.uvs.insert(to.uvs.end(), p.uv0.begin(), p.uv0.end());
        to.uvs.resize(to.positions.size());
        for (const std::uint32_t index : p.indices) to.indices.push_back(first + index);
        to.materials.resize(to.indices.size() / 3, p.material);
    }
}

SceneBvh::SceneBvh(const Context& context, const Scene& scene, const ScenePose& pose)
    : m_scene(scene), m_groups(scene.meshes.size()) {
    std::vector<int> uses(scene.meshes.size(), 0);
    for (const Instance& instance : pose.instances) ++uses[std::size_t(instance.mesh)];
    std::vector<std::uint32_t> roots(scene.meshes.size());
    std::vector<Bounds> bounds(scene.meshes.size()), boxes;
    std::vector<kernels::BvhInstance> placed;
    for (const Instance& instance : pose.instances) {
        const auto mesh = std::size_t(instance.mesh);
        if (uses[mesh] == 1) {
            m_worldGroup.append(scene, instance.mesh, instance.toWorld);
            continue;
        }
        if (!m_groups[mesh]) {
            m_groups[mesh] = std::make_unique<SceneGroup>();
            m_groups[mesh]->append(scene, instance.mesh, glm::mat4(1.0f));
            const TriangleBvh bvh = m_groups[mesh]->build(context);
            roots[mesh] = m_world.arrays.append(bvh);
            bounds[mesh] = bvh.bounds;
        }
        boxes.push_back(placedBounds(bounds[mesh], instance.toWorld));
        placed.push_back(makeBvhInstance(instance.toWorld, roots[mesh], int(placed.size())));
        m_groupOf.push_back(m_groups[mesh].get());
    }
    const InstanceBvh top = buildInstanceBvh(context, boxes).value();
    for (const std::uint32_t i : top.order) m_world.instances.push_back(placed[i]);
    m_world.instancesRoot = m_world.arrays.append(top);
    m_world.worldRoot = m_world.arrays.append(m_worldGroup.build(context));
    m_world.alphaPasses = [this](int i, int p, glm::vec2 b) { return alphaPasses(i, p, b); };
}

bool SceneBvh::alphaPasses(int instance, int primitive, glm::vec2 barycentric) const {
    const SceneTriangles& masked = (instance < 0 ? m_worldGroup : *m_groupOf[std::size_t(instance)]).masked;
    const std::uint32_t* corner = &masked.indices[3 * std::size_t(primitive)];
    const glm::vec2 uv = masked.uvs[corner[0]] * (1.0f - barycentric.x - barycentric.y) +
                         masked.uvs[corner[1]] * barycentric.x + masked.uvs[corner[2]] * barycentric.y;
    const Material& material = m_scene.materials[std::size_t(masked.materials[std::size_t(primitive)])];
    const float cutoff = material.alphaMode == AlphaMode::mask ? material.alphaCutoff : 0.5f;
    return material.baseColor.a * textureAlpha(m_scene, material.baseColorTexture, uv) >= cutoff;
}

}  // namespace probegi::test

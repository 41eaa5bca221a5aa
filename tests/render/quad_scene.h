#pragma once

#include "probegi/probegi.h"

namespace probegi::test {

/// Scenes of axis-aligned squares, with all that is needed to draw them.
class QuadScene {
public:
    QuadScene() { m_scene.meshes.emplace_back(); }

    /// A square of side 2 * half around `centre`, which faces `right` x `up`.
    QuadScene& quad(glm::vec3 centre, glm::vec3 right, glm::vec3 up, float half, Material material) {
        m_scene.materials.push_back(std::move(material));
        Primitive primitive;
        const glm::vec3 r = half * right, u = half * up;
        primitive.positions = {centre - r - u, centre + r - u, centre + r + u, centre - r + u};
        primitive.indices = {0, 1, 2, 0, 2, 3};
        primitive.material = int(m_scene.materials.size()) - 1;
        m_scene.meshes[0].primitives.push_back(std::move(primitive));
        return *this;
    }

    /// A floor facing up.
    QuadScene& floor(float half, Material material = {}) {
        return quad({0, 0, 0}, {1, 0, 0}, {0, 0, -1}, half, std::move(material));
    }

    struct Ready {
        Context context;
        std::unique_ptr<Scene> scene;
        std::unique_ptr<Tracer> tracer;

        Picture picture(const Lighting& lighting, const PictureDesc& desc, const Field* field = nullptr) const {
            return std::move(renderPicture(context, *tracer, lighting, field, desc).value().picture);
        }
    };

    Ready ready(int threads = 1) const {
        ContextDesc desc;
        desc.threads = threads;
        Context context = Context::create(desc).value();
        auto scene = std::make_unique<Scene>(m_scene);
        Node node;
        node.mesh = 0;
        scene->addNode(node);
        auto tracer = makeEmbreeTracer(context, *scene, poseAt(*scene)).value();
        return {std::move(context), std::move(scene), std::move(tracer)};
    }

private:
    Scene m_scene;
};

inline Material matt(glm::vec3 albedo) {
    Material material;
    material.baseColor = glm::vec4(albedo, 1.0f);
    return material;
}

inline PlacedLight pointLight(glm::vec3 position, glm::vec3 intensity) {
    PlacedLight light;
    light.type = LightType::point;
    light.position = position;
    light.intensity = intensity;
    return light;
}

inline PlacedLight sunLight(glm::vec3 direction, float irradiance) {
    PlacedLight light;
    light.type = LightType::directional;
    light.direction = glm::normalize(direction);
    light.intensity = glm::vec3(irradiance);
    return light;
}

/// Straight down on the origin from `height`, up in the picture = -Z.
inline PictureDesc fromAbove(float height, int width, int rows) {
    PictureDesc desc;
    desc.camera.position = {0, height, 0};
    desc.camera.forward = {0, -1, 0};
    desc.camera.up = {0, 0, -1};
    desc.camera.yfov = 1.5707963f;
    desc.width = width;
    desc.height = rows;
    desc.samplesPerAxis = 1;
    desc.diffuseOnly = true;
    return desc;
}

}  // namespace probegi::test

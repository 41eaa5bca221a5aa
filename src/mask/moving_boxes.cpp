#include <glm/mat3x3.hpp>

#include "field/moved_objects.h"
#include "probegi/mask_updater.h"
#include "scene/animation.h"

namespace probegi {

std::vector<OrientedBox> movingBoxes(const Scene& scene, const ScenePose& pose) {
    const std::vector<bool> moves = animatedNodes(scene);
    std::vector<const Instance*> instanceOf(scene.nodes.size(), nullptr);
    for (const Instance& instance : pose.instances)
        if (instance.node >= 0) instanceOf[std::size_t(instance.node)] = &instance;
    std::vector<OrientedBox> boxes;
    for (std::size_t node = 0; node < moves.size(); ++node) {
        if (!moves[node] || scene.nodes[node].mesh < 0) continue;
        OrientedBox& box = boxes.emplace_back(OrientedBox{pose.bounds.centre()});
        if (!instanceOf[node]) continue;
        const glm::mat4& toWorld = instanceOf[node]->toWorld;
        const Bounds mesh = meshBounds(scene.meshes[std::size_t(instanceOf[node]->mesh)]);
        box.centre = glm::vec3(toWorld * glm::vec4(mesh.centre(), 1.0f));
        for (int axis = 0; axis < 3; ++axis) box.halfAxes[axis] = glm::vec3(toWorld[axis]) * (0.5f * mesh.size()[axis]);
    }
    return boxes;
}

}  // namespace probegi

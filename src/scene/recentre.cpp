#include "scene/recentre.h"

#include <algorithm>
#include <cmath>

namespace probegi {

namespace {

/// Shift along each axis; 0 for a scene near enough.
glm::vec3 shiftOf(const Bounds& bounds) {
    constexpr float kFar = 16.0f;  // sizes of the scene: four of a float's 24 binary digits
    const glm::vec3 size = bounds.size();
    const glm::vec3 centre = bounds.centre();
    const float largest = std::max({size.x, size.y, size.z});
    const float farthest = std::max({std::abs(centre.x), std::abs(centre.y), std::abs(centre.z)});
    glm::vec3 shift(0.0f);
    if (!(largest > 0) || farthest < kFar * largest) return shift;
    const float step = std::exp2(std::ceil(std::log2(largest)));
    for (int axis = 0; axis < 3; ++axis) shift[axis] = std::round(centre[axis] / step) * step;
    return shift;
}

void moveNode(Node& node, glm::vec3 shift) {
    if (node.matrix) {
        (*node.matrix)[3] -= glm::vec4(shift, 0.0f);
    } else {
        node.translation -= shift;
    }
}

void moveKeys(AnimationChannel& channel, glm::vec3 shift) {
    const bool cubic = channel.interpolation == Interpolation::cubicSpline;
    for (std::size_t i = 0; i < channel.values.size(); ++i) {
        if (!cubic || i % 3 == 1) channel.values[i] -= glm::vec4(shift, 0.0f);  // tangents stay
    }
}

}  // namespace

bool recentre(Scene& scene) {
    const glm::vec3 shift = shiftOf(poseAt(scene).bounds);
    if (shift == glm::vec3(0.0f)) return false;
    for (Node& node : scene.nodes) {
        if (node.parent < 0) moveNode(node, shift);
    }
    for (AnimationChannel& channel : scene.animations) {
        const bool root = scene.nodes[std::size_t(channel.node)].parent < 0;
        if (root && channel.path == AnimationPath::translation) moveKeys(channel, shift);
    }
    if (scene.grid) scene.grid->origin -= shift;
    for (VolumeDesc& grid : scene.furtherGrids) grid.origin -= shift;
    scene.origin += shift;
    return true;
}

}  // namespace probegi

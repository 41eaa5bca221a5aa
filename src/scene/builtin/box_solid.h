#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "probegi/scene.h"

namespace probegi::builtin {

/// Materials of the surfaces around an empty space, by the direction of their normal; -1: that of the solid.
struct Paint {
    std::array<int, 6> byNormal{-1, -1, -1, -1, -1, -1};  ///< +x -x +y -y +z -z

    static Paint room(int wall, int floor, int ceiling) { return {{wall, wall, floor, ceiling, wall, wall}}; }
    static Paint all(int material) { return room(material, material, material); }
};

/// Architecture as a union of axis-aligned boxes with others carved out, in call order. The result is the boundary: one
/// closed surface without inner faces, gaps or T-junctions, however the boxes overlap. A face between wall and empty
/// space gets the paint of the space or, if the wall is newer, the wall's own material. Coordinates are rounded to 0.1
/// mm.
class BoxSolid {
public:
    void fill(glm::vec3 lower, glm::vec3 upper, int material);
    /// Also repaints space that is already empty.
    void carve(glm::vec3 lower, glm::vec3 upper, const Paint& paint = {});
    Mesh build(std::string name) const;

private:
    struct Step {
        glm::vec3 lower, upper;
        int material;  ///< -1: carve
        Paint paint;
    };
    std::vector<Step> m_steps;
};

}  // namespace probegi::builtin

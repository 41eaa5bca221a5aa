#include "room.h"

#include <probegi/shapes.h>

#include <cmath>

using namespace probegi;

namespace {

struct Wall {
    glm::vec3 corner, right, up, inward;
};

std::vector<Wall> wallsOf(const Room& room) {
    const glm::vec3 x{room.size.x, 0, 0}, y{0, room.size.y, 0}, z{0, 0, room.size.z}, o{0};
    return {{o, z, x, {0, 1, 0}},  {y, x, z, {0, -1, 0}}, {o, x, y, {0, 0, 1}},
            {z, y, x, {0, 0, -1}}, {o, y, z, {1, 0, 0}},  {x, z, y, {-1, 0, 0}}};
}

}  // namespace

Scene Room::scene() const {
    Scene scene;
    scene.name = "room";
    Material grey;
    grey.baseColor = {kAlbedo, kAlbedo, kAlbedo, 1};
    scene.materials.push_back(grey);
    Primitive walls;
    addRoom(walls, glm::vec3(0), size);
    addObject(scene, std::move(walls), "walls");
    return scene;
}

std::vector<FieldQuery> Room::wallPoints() const {
    constexpr float kStep = 0.25f;
    std::vector<FieldQuery> points;
    for (const Wall& wall : wallsOf(*this)) {
        const int columns = int(std::lround(glm::length(wall.right) / kStep));
        const int rows = int(std::lround(glm::length(wall.up) / kStep));
        for (int i = 0; i < columns * rows; ++i) {
            const float u = (float(i % columns) + 0.5f) / float(columns);
            const float v = (float(i / columns) + 0.5f) / float(rows);
            points.push_back({wall.corner + u * wall.right + v * wall.up, wall.inward, wall.inward});
        }
    }
    return points;
}

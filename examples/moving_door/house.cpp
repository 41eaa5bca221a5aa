#include "house.h"

#include <cmath>

using namespace probegi;

namespace {

constexpr float kHalf = House::kWall / 2, kEnd = House::kRoom + kHalf;
constexpr float kDoorWidth = 1, kDoorHeight = 2;

Primitive walls() {
    constexpr float out = kEnd + House::kWall, top = House::kHeight, deep = House::kRoom / 2, wall = House::kWall;
    Primitive all;
    addBox(all, {-out, -wall, -deep - wall}, {out, 0, deep + wall});                    // floor
    addBox(all, {-out, top, -deep - wall}, {out, top + wall, deep + wall});             // ceiling
    addBox(all, {-out, 0, -deep - wall}, {out, top, -deep});                            // the long walls
    addBox(all, {-out, 0, deep}, {out, top, deep + wall});                              //
    addBox(all, {-out, 0, -deep}, {-kEnd, top, deep});                                  // the short walls
    addBox(all, {kEnd, 0, -deep}, {out, top, deep});                                    //
    addBox(all, {-kHalf, 0, -deep}, {kHalf, top, -kDoorWidth / 2});                     // around the door
    addBox(all, {-kHalf, 0, kDoorWidth / 2}, {kHalf, top, deep});                       //
    addBox(all, {-kHalf, kDoorHeight, -kDoorWidth / 2}, {kHalf, top, kDoorWidth / 2});  //
    return all;
}

}  // namespace

House::House() {
    scene.name = "two rooms and a door";
    scene.materials.resize(1);
    scene.materials[0].baseColor = {0.7f, 0.7f, 0.7f, 1};
    addObject(scene, walls(), "walls");
    Primitive leaf;  // its hinge is at its own origin
    addBox(leaf, {-kHalf, 0, 0}, {kHalf, kDoorHeight, kDoorWidth});
    door = addObject(scene, std::move(leaf), "door");
    scene.nodes[std::size_t(door)].translation = {0, 0, -kDoorWidth / 2};
}

ScenePose House::poseWithDoor(float angle) const {
    Scene moved = scene;  // an engine fills a ScenePose with its own transforms
    moved.nodes[std::size_t(door)].rotation = glm::angleAxis(angle, glm::vec3(0, 1, 0));
    return poseAt(moved);
}

std::vector<FieldQuery> House::secondRoom() const {
    std::vector<FieldQuery> points;
    for (float along = 0.25f; along < kRoom; along += 0.5f)
        for (float up = 0.25f; up < kHeight; up += 0.5f)
            for (const float side : {-1.0f, 1.0f}) {
                const glm::vec3 inward(0, 0, -side);
                points.push_back({{kHalf + along, up, side * kRoom / 2}, inward, inward});
            }
    return points;
}

#pragma once

#include <probegi/probegi.h>

#include <vector>

/// Two rooms of 4 x 3 x 4 m with a 20 cm wall between them and a door in it. A lamp hangs in the first room.
struct House {
    static constexpr float kRoom = 4, kHeight = 3, kWall = 0.2f;

    House();
    /// The pose with the door opened by an angle in radians; 0: shut.
    probegi::ScenePose poseWithDoor(float angle) const;
    /// Points all over the walls of the second room.
    std::vector<probegi::FieldQuery> secondRoom() const;

    probegi::Scene scene;
    int door = -1;  ///< node index
};

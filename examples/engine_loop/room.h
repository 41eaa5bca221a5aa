#pragma once

#include <probegi/field.h>
#include <probegi/scene.h>

#include <vector>

/// A closed, uniformly grey room.
struct Room {
    static constexpr float kAlbedo = 0.5f;
    glm::vec3 size{6, 3, 4};  ///< metres; one corner is the origin

    float area() const { return 2 * (size.x * size.y + size.y * size.z + size.z * size.x); }
    probegi::Scene scene() const;
    /// Points spread evenly over all six walls.
    std::vector<probegi::FieldQuery> wallPoints() const;
};

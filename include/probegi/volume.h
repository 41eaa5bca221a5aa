#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include "probegi/export.h"

namespace probegi {

/// A lattice of probes. Probe (x, y, z) stands at (x, y, z) * spacing, turned by `orientation`, from `origin`;
/// its number in the volume is x + counts.x * (y + counts.y * z).
struct VolumeDesc {
    glm::vec3 origin{0.0f};   ///< position of probe (0, 0, 0), metres
    glm::vec3 spacing{1.0f};  ///< metres between neighbours, > 0
    glm::ivec3 counts{2};     ///< probes per axis, 2..1024, at most 2^24 in all volumes of a field
    /// Turns the lattice about its origin: a unit quaternion from the volume's axes to the world's.
    glm::quat orientation{1.0f, 0.0f, 0.0f, 0.0f};
    /// The volume scrolls after the camera (Field::followCamera), and once the camera's position is known
    /// (FieldSettings::camera), it answers in a box around the camera itself, a cell smaller on each side than its
    /// window: light then changes as the camera moves, not when the window leaps (section 7.4). At least 5 probes per
    /// axis.
    bool tracksCamera = false;

    bool operator==(const VolumeDesc&) const = default;
};

/// By how many whole cells the volume's window must be scrolled (Field::scroll) so that a point of the world, the
/// camera say, is within half a cell of its middle.
PROBEGI_API glm::ivec3 cellsToCentre(const VolumeDesc& volume, glm::vec3 point) noexcept;

/// Cells beyond the half by which a camera may leave the middle before a window follows it.
inline constexpr float kFollowDeadBand = 0.25f;

/// The same for a window that follows a camera frame by frame: 0 on every axis along which the camera is within half a
/// cell and `deadBand` cells of the middle, else what cellsToCentre() says. So a camera that trembles on the seam of
/// two cells moves nothing. `deadBand`: 0..0.5.
PROBEGI_API glm::ivec3 cellsToFollow(const VolumeDesc& volume, glm::vec3 camera,
                                     float deadBand = kFollowDeadBand) noexcept;

inline int probeCount(const VolumeDesc& v) {
    return v.counts.x * v.counts.y * v.counts.z;
}

/// In the world, metres.
inline glm::vec3 probePosition(const VolumeDesc& v, int number) {
    const int x = number % v.counts.x;
    const int y = number / v.counts.x % v.counts.y;
    const int z = number / (v.counts.x * v.counts.y);
    const glm::vec3 offset = glm::vec3(float(x), float(y), float(z)) * v.spacing;
    return v.origin + (v.orientation == glm::quat(1.0f, 0.0f, 0.0f, 0.0f) ? offset : v.orientation * offset);
}

}  // namespace probegi

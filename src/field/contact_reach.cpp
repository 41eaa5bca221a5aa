#include "field/contact_reach.h"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/vector_relational.hpp>

namespace probegi {

namespace {

constexpr float kReachWithoutField = 0.125f;  // of the scene's diagonal

bool holds(const VolumeDesc& volume, glm::vec3 point) {
    const glm::vec3 inside = glm::inverse(volume.orientation) * (point - volume.origin);
    const glm::vec3 size = volume.spacing * glm::vec3(volume.counts - 1);
    return glm::all(glm::greaterThanEqual(inside, glm::vec3(0.0f))) && glm::all(glm::lessThanEqual(inside, size));
}

// Metres between probes.
float spacingAround(const FieldControl& control, glm::vec3 camera) {
    float around = 0, all = 0;  // 0: none yet
    for (int i = 0; i < int(control.desc().volumes.size()); ++i) {
        const VolumeDesc volume = control.place(i);
        const float spacing = (volume.spacing.x + volume.spacing.y + volume.spacing.z) / 3;
        if (all == 0 || spacing < all) all = spacing;
        if (holds(volume, camera) && (around == 0 || spacing < around)) around = spacing;
    }
    return around > 0 ? around : all;
}

}  // namespace

float contactReach(const PictureDesc& desc, const Field* field, const Bounds& scene) {
    const float unit =
        field ? spacingAround(field->control(), desc.camera.position) : kReachWithoutField * glm::length(scene.size());
    return desc.contactReach * unit;
}

}  // namespace probegi

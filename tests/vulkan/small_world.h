#pragma once

#include <gtest/gtest.h>

#include "probegi/probegi.h"
#include "probegi/vulkan.h"
#include "support/field_setup.h"

namespace probegi::test {

/// A built-in scene with its pose, lights, and a grid of a few probes.
struct SmallWorld {
    explicit SmallWorld(const char* name = "cornell") : scene(*makeBuiltinScene(name)) {
        pose = poseAt(scene);
        lighting = {pose.lights, scene.sky};
        // Inside the walls.
        desc.volumes[0].counts = {3, 2, 3};
        desc.volumes[0].origin = pose.bounds.lower + 0.15f * pose.bounds.size();
        desc.volumes[0].spacing = 0.7f * pose.bounds.size() / glm::vec3(desc.volumes[0].counts - 1);
        desc.raysPerProbe = 16;
        desc.irradianceTexels = 4;
        desc.visibilityTexels = 6;
    }
    FieldQuery query() const { return {pose.bounds.centre(), {0, 1, 0}, {0, 1, 0}}; }
    PictureDesc picture() const {
        PictureDesc picture;
        picture.camera = lookAt(pose.bounds.centre(), pose.bounds.lower);
        picture.width = 16;
        picture.height = 8;
        return picture;
    }

    Scene scene;
    ScenePose pose;
    Lighting lighting;
    FieldSetup desc;
};

/// The kinds of tracer that a device supports.
inline std::vector<vulkan::TracerKind> tracerKinds(const vulkan::Device& device) {
    std::vector<vulkan::TracerKind> kinds{vulkan::TracerKind::bvh};
    if (device.rayQuery()) kinds.push_back(vulkan::TracerKind::rayQuery);
    return kinds;
}

inline bool finite(glm::vec3 v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace probegi::test

#pragma once

#include <memory>

#include "core/embree.h"

namespace probegi {

/// Deleters for std::unique_ptr to Embree's reference-counted objects.
struct EmbreeRelease {
    void operator()(RTCDevice device) const noexcept { rtcReleaseDevice(device); }
    void operator()(RTCScene scene) const noexcept { rtcReleaseScene(scene); }
    void operator()(RTCGeometry geometry) const noexcept { rtcReleaseGeometry(geometry); }
};

using EmbreeDevice = std::unique_ptr<RTCDeviceTy, EmbreeRelease>;
using EmbreeSceneHandle = std::unique_ptr<RTCSceneTy, EmbreeRelease>;
using EmbreeGeometry = std::unique_ptr<RTCGeometryTy, EmbreeRelease>;

}  // namespace probegi

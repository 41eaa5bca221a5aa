#include "core/sentence.h"
#include "vulkan/device/errors.h"
#include "vulkan/tracers/scene_tracer.h"

namespace probegi::vulkan {

// Defined in NAME_scene_tracer.cpp.
std::unique_ptr<SceneTracer> makeBvhSceneTracer(const TracedScene& scene);
std::unique_ptr<SceneTracer> makeRayQuerySceneTracer(const TracedScene& scene);
std::unique_ptr<SceneTracer> makeSdfSceneTracer(const TracedScene& scene);

namespace {

bool always(const Device&) {
    return true;
}
bool never(const Device&) {
    return false;
}
bool hasRayQuery(const Device& device) {
    return device.rayQuery();
}
// A software device's ray query gains nothing from hardware: with Mesa 25.0 it took eight times as long as the BVH.
bool hasRayQueryInHardware(const Device& device) {
    return device.rayQuery() && device.info().type != kSoftwareDevice;
}

/// All tracers, in the order in which TracerKind::automatic prefers them.
constexpr SceneTracerType kTracers[] = {
    {"ray_query", TracerKind::rayQuery, "ray query", hasRayQuery, hasRayQueryInHardware, makeRayQuerySceneTracer},
    {"bvh", TracerKind::bvh, "", always, always, makeBvhSceneTracer},
    {"sdf", TracerKind::sdf, "", always, never, makeSdfSceneTracer, false},
};

}  // namespace

const SceneTracerType& sceneTracerType(const Device& device, TracerKind wanted) {
    for (const SceneTracerType& type : kTracers) {
        if (wanted == TracerKind::automatic ? !type.preferred(device) : type.kind != wanted) continue;
        if (type.possible(device)) return type;
        throw Failure(ErrorCode::unsupported,
                      sentence(type.needs, " was asked for, but the device '", device.info().name,
                               "' does not have it or it is not enabled; use the BVH tracer"));
    }
    throw Failure(ErrorCode::unsupported, "there is no tracer of this kind");
}

}  // namespace probegi::vulkan

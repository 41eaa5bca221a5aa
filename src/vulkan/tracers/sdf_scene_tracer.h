#pragma once

#include "vulkan/tracers/scene_tracer.h"

namespace probegi::vulkan {

/// The tracer of primitives in the paper's own way (SDFDDGI, section 3.3): sphere tracing by clusters. TracerKind::sdf
/// is exact intersection; this one is there to be measured against it.
const SceneTracerType& sphereTracedSdf();

}  // namespace probegi::vulkan

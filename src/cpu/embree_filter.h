#pragma once

#include "core/embree.h"

namespace probegi {

/// Embree filter for intersection and occlusion: rejects hits whose masked material's alpha is below its cutoff. The
/// geometry's user pointer must be an EmbreeFilterData.
void rejectTransparent(const RTCFilterFunctionNArguments* args);

}  // namespace probegi

#pragma once

#include "probegi/tracer.h"

namespace probegi {

/// Area times luminance, W sr^-1; 0 for a triangle that cannot be sampled.
double emitterPower(const EmissiveTriangle& triangle, float luminance);

}  // namespace probegi

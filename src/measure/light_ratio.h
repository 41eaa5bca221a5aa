#pragma once

#include "probegi/measure.h"

namespace probegi {

/// The pictures must be of one size and finite.
LightRatio lightRatio(const HdrImage& test, const HdrImage& reference);

}  // namespace probegi

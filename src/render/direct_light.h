#pragma once

#include "render/tile_samples.h"

namespace probegi {

/// Fills `direct`: the surface's own emission, plus reflected light of each visible punctual light.
/// Errors: those of the tracer.
Result<void> shadeDirect(const Tracer& tracer, const Lighting& lighting, float sceneMagnitude, bool diffuseOnly,
                         TileSamples& samples);

}  // namespace probegi

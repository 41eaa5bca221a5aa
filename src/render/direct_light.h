#pragma once

#include "render/tile_samples.h"

namespace probegi {

/// Fills `direct`: the surface's own emission, and what it reflects of each punctual light that it can see.
/// Errors: those of the tracer.
Result<void> shadeDirect(const Tracer& tracer, const Lighting& lighting, float sceneMagnitude, bool diffuseOnly,
                         TileSamples& samples);

}  // namespace probegi

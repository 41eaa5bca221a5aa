#pragma once

#include "frame_ring.h"
#include "global_illumination.h"

/// Asks both volumes the same questions all over the rooms, in a compute pass of the library, and prints what they
/// say. Right: they agree within 2 %, and daylight has found its way through the door.
bool answersAreRight(const EngineDevice& engine, MemoryPool& pool, FrameRing& ring, GlobalIllumination& gi,
                     const FrameData& frame);

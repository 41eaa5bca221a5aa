#pragma once

#include "frame_ring.h"
#include "global_illumination.h"

/// Queries both volumes at the same points all over the rooms, in a compute pass of the library, and prints the
/// results. Returns true if they agree within 2 % and daylight comes through the door.
bool answersAreRight(const EngineDevice& engine, MemoryPool& pool, FrameRing& ring, GlobalIllumination& gi,
                     const FrameData& frame);

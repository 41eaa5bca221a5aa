#pragma once

#include <span>
#include <vector>

#include "field/update_frame.h"
#include "probegi/tracer.h"

namespace probegi {

/// What placing probes finds.
struct FoundPlaces {
    std::vector<std::uint32_t> placements;  ///< words, by slot
    std::vector<std::uint8_t> surfaces;     ///< by slot: a ray met a static surface that uses the probe
};

/// Places all probes that are new (sections 5 and 6.3): all looks of relocation at once, with rays of their own. Rays
/// that end in `moving` bounds say nothing of the static geometry and are left out. Errors: those of the tracer.
Result<FoundPlaces> placeProbes(const Context& context, const UpdateFrame& frame,
                                std::span<const std::uint32_t> placements, std::span<const Bounds> moving,
                                const Tracer& tracer);

/// One look by the rays of an update that the caller traced, [task][ray].
FoundPlaces lookAround(const Context& context, const UpdateFrame& frame, std::span<const std::uint32_t> placements,
                       std::span<const Bounds> moving, std::span<const RayDatum> rayData);

}  // namespace probegi

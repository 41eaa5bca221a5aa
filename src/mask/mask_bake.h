#pragma once

#include <optional>

#include "mask/mask_cubes.h"

namespace probegi {

/// A bake with all that it found on the way, so that it can go on where geometry moves.
struct MaskBake {
    /// `desc` must be valid; of it no positions and occluders are kept.
    MaskBake(const FieldDesc& field, const MaskDesc& desc);

    /// Masks as look-ups read them (kernels/guards/masks.h has the layout).
    std::shared_ptr<const Masks> publish();

    std::vector<VolumeDesc> volumes;
    MaskDesc desc;
    MaskCells cells;
    ProbeSight sight;
    std::optional<ProbeGraph> graph;
    Clusters clusters;
    MaskCubes cubes;
    std::vector<std::uint32_t> cubeOf;  ///< by blocked cell
    std::uint32_t openCube = 0;         ///< that of all other cells, which see all
    MaskReport report;                  ///< cubes and bytes: those of the last publish()
};

/// Errors: as bakeMasks(). Throws std::bad_alloc.
Result<MaskBake> bakeMaskParts(const Context& context, const Tracer& tracer, const FieldDesc& field,
                               const MaskDesc& desc);

Error noMemoryForMasks();

}  // namespace probegi

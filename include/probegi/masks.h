#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "probegi/context.h"
#include "probegi/export.h"
#include "probegi/field.h"
#include "probegi/result.h"
#include "probegi/scene.h"
#include "probegi/tracer.h"
#include "probegi/volume.h"

namespace probegi {

/// How masks are baked (mask paper, section 3.4).
struct MaskDesc {
    int clusters = 4;  ///< K, into how many clusters the probes fall, 1..8. With 8 each probe of a cell has its own
                       ///< (eq. 4), and masks are the visibility itself; fewer let a point blend probes of one cluster
                       ///< of which it sees only most
    int factor = 8;    ///< texels along the edge of a cell, both of its faces included, 2..16
    /// No leak, blind places apart: a cluster counts only where a point sees all its probes in the cell. With fewer
    /// than 6 clusters many points then see none, and go by the distance moments.
    bool strict = false;
    int sweeps = 800;         ///< of simulated annealing over all probes, 0..100000; 0: the colouring is its start,
                              ///< improved greedily
    float sparsity = 0.001f;  ///< lambda of eq. 8, 0..1, in texels
    std::uint64_t seed = 1;   ///< of the annealing
    /// Where the probes stand, by slot, metres, in the world (FieldControl::probePosition after relocation). Empty: all
    /// stand on their lattices. Read during the call only, as the next one.
    std::span<const glm::vec3> positions{};
    /// World bounds that hold all that may block, metres: cells that none of them touches need no rays
    /// (triangleBounds()). Empty: Tracer::bounds().
    std::span<const Bounds> occluders{};
};

/// What a bake took and what it made.
struct MaskReport {
    double visibilitySeconds = 0;  ///< rays, and the sums of eq. 6
    double clusterSeconds = 0;     ///< annealing (eqs. 7 and 8)
    double maskSeconds = 0;        ///< the local solve of eq. 5, and rays between texels
    double compressSeconds = 0;    ///< merging equal cubes
    std::uint64_t rays = 0;
    std::size_t cells = 0;           ///< of all volumes
    std::size_t blocked = 0;         ///< cells with an occluder: only they were looked at
    std::size_t cubes = 0;           ///< that differ
    std::size_t denseBytes = 0;      ///< of one byte a texel and cluster, as Table 2 counts
    std::size_t bytes = 0;           ///< of what is kept: cubes, indirection, clusters
    double startLoss = 0, loss = 0;  ///< eqs. 7 and 8 of the convex division, and of the colouring
    double residual = 0;             ///< eq. 5, as a share of the leaking baseline's; 0 where that has none
    double meanClusters = 0;         ///< clusters that a texel sees, of those in its cell
    double blindTexels = 0;          ///< share of texels that see no cluster: in matter, on walls, or shut in
};

/// Which clusters of probes each place of a field's volumes sees: baked visibility (Zhou et al., "Fast Probe-Leaking
/// Elimination Using Mask Decomposition"). Only geometry is in it, so lights may change. Immutable; any number of
/// fields with these volumes may share it: FieldSettings::masks.
class PROBEGI_API Masks {
public:
    const std::vector<VolumeDesc>& volumes() const noexcept;
    const MaskReport& report() const noexcept;
    int clusters() const noexcept;
    int factor() const noexcept;
    bool packed() const noexcept { return clusters() <= 4; }  ///< whether two texels share one of words()
    /// Cluster of the probe of a slot, 0..clusters-1. Unchecked.
    int cluster(int slot) const noexcept;
    /// As look-ups read it, on every backend: src/kernels/guards/masks.h has the layout.
    std::span<const std::uint32_t> words() const noexcept;
    ~Masks();

    struct Impl;
    explicit Masks(std::unique_ptr<Impl> impl);

private:
    std::unique_ptr<Impl> m_impl;
};

/// Bakes the masks of a field's volumes from what stands still in a tracer. Reports the stages "seeing probes",
/// "colouring probes" and "solving masks". The same for any number of threads. Errors: invalidArgument (the message
/// names the member and its range; volumes that track a camera), cancelled, outOfMemory, and those of the tracer.
PROBEGI_API Result<std::shared_ptr<const Masks>> bakeMasks(const Context& context, const Tracer& tracer,
                                                           const FieldDesc& field, const MaskDesc& desc = {});

}  // namespace probegi

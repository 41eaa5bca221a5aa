#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "probegi/grid.h"

namespace probegi {

/// The order in which an update traces its rays. A task has the probes of a small box of the grid and some directions,
/// and rays of one direction lie side by side in it: they start near each other, meet the same nodes, triangles, texels
/// and probes, and find them in the caches. Rays of one probe have nothing in common but their origin.

/// Boxes of up to 16 neighbouring probes that cover a grid.
class ProbeBlocks {
public:
    static constexpr int kMostProbes = 16;

    explicit ProbeBlocks(const GridDesc& grid);

    std::size_t count() const noexcept;
    /// The probes of one box, x fastest; fewer where the grid ends.
    void probesOf(std::size_t block, std::vector<std::uint32_t>& probes) const;

private:
    glm::ivec3 m_counts;  // of probes
    glm::ivec3 m_blocks;  // of boxes
};

/// One direction of a set, and which.
struct OrderedDirection {
    glm::vec3 direction;
    std::uint32_t index;
};

/// The directions along a curve over the sphere, so that what follows one another looks the same way.
std::vector<OrderedDirection> alongCurve(std::span<const glm::vec3> directions);

}  // namespace probegi

#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "probegi/grid.h"

namespace probegi {

/// The order in which an update traces its rays. A task has the probes of a small box of the grid and some directions;
/// rays of one direction are adjacent in it. They start near each other and hit the same nodes, triangles, texels and
/// probes, which are then cached. Rays of one probe share only their origin.

/// Boxes of up to 16 neighbouring probes that cover a grid.
class ProbeBlocks {
public:
    static constexpr int kMostProbes = 16;

    explicit ProbeBlocks(const GridDesc& grid);

    std::size_t count() const noexcept;
    /// The probes of one box, x fastest; fewer at the grid's end.
    void probesOf(std::size_t block, std::vector<std::uint32_t>& probes) const;

private:
    glm::ivec3 m_counts;  // of probes
    glm::ivec3 m_blocks;  // of boxes
};

/// A direction of a set with its index.
struct OrderedDirection {
    glm::vec3 direction;
    std::uint32_t index;
};

/// The directions along a space-filling curve over the sphere, so that consecutive ones are similar.
std::vector<OrderedDirection> alongCurve(std::span<const glm::vec3> directions);

}  // namespace probegi

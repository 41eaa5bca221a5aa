#pragma once

#include <glm/vec3.hpp>

namespace probegi {

/// An axis-aligned lattice of probes. Probe (x, y, z) stands at origin + (x, y, z) * spacing;
/// its linear index is x + counts.x * (y + counts.y * z).
struct GridDesc {
    glm::vec3 origin{0.0f};   ///< position of probe (0, 0, 0), metres
    glm::vec3 spacing{1.0f};  ///< metres between neighbours, > 0
    glm::ivec3 counts{2};     ///< probes per axis, 2..1024, at most 2^24 in all
};

inline int probeCount(const GridDesc& g) {
    return g.counts.x * g.counts.y * g.counts.z;
}

inline glm::vec3 probePosition(const GridDesc& g, int index) {
    const int x = index % g.counts.x;
    const int y = index / g.counts.x % g.counts.y;
    const int z = index / (g.counts.x * g.counts.y);
    return g.origin + glm::vec3(float(x), float(y), float(z)) * g.spacing;
}

}  // namespace probegi

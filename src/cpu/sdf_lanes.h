#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "kernels/sdf/primitive.h"
#include "probegi/tracer.h"

namespace probegi {

/// Solids as rays in lanes meet them: boxes along the world's axes, then turned boxes, then all other shapes in a box
/// around each. Of hits at the same distance, the first in this order counts.
class SdfLanes {
public:
    /// A box, turned or not.
    struct Box {
        glm::vec3 centre;
        std::int32_t solid;  // its number
        glm::vec3 halfSize;
        std::int32_t exact;                  // other shapes: 0; boxes: 1
        std::array<glm::vec3, 3> axes = {};  // of the frame, in the world: turned ones only
    };
    /// Boxes along the world's axes around all of them, in the order of boxes: one coordinate of each in a row, padded
    /// with boxes that nothing hits.
    struct AroundAll {
        std::array<std::vector<float>, 3> centre, halfSize;
    };

    SdfLanes() = default;
    explicit SdfLanes(std::span<const kernels::SdfSolid> solids);

    std::span<const Box> boxes() const noexcept { return m_boxes; }
    /// How many of boxes() are along the world's axes.
    std::size_t aligned() const noexcept { return m_aligned; }
    const AroundAll& around() const noexcept { return m_around; }
    const kernels::SdfSolid& solid(std::int32_t number) const noexcept { return m_solids[std::size_t(number)]; }

private:
    void addAround(const Bounds& bounds);
    void pad();

    std::vector<kernels::SdfSolid> m_solids;
    std::vector<Box> m_boxes;
    std::size_t m_aligned = 0;
    AroundAll m_around;
};

/// Exact hits of the union of solids, with the fastest instructions that the processor has: as Tracer::closestHits and
/// Tracer::occluded. Hit::primitive is the solid, Hit::geometry its side (kernels/sdf/union_hit.h).
void sdfClosestHits(const SdfLanes& lanes, std::span<const Ray> rays, std::span<Hit> hits);
void sdfOccluded(const SdfLanes& lanes, std::span<const Ray> rays, std::span<std::uint8_t> blocked);

}  // namespace probegi

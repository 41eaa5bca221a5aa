#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "kernels/volume/volume.h"
#include "probegi/masks.h"

namespace probegi {

/// A cell that something may block: its lowest probe's slot says which it is. Its texels lie on its faces and between
/// them, x fastest.
struct MaskCell {
    std::array<int, 8> slot;         ///< of its probes: bits 0 to 2 of the number are x, y and z
    std::array<glm::vec3, 8> probe;  ///< where they stand, metres, in the world
    glm::vec3 origin;                ///< of texel 0, metres, in the world
    std::array<glm::vec3, 3> step;   ///< from texel to texel, metres, in the world
    float texelSize;                 ///< the smallest of their lengths

    glm::vec3 texel(int x, int y, int z) const {
        return origin + float(x) * step[0] + float(y) * step[1] + float(z) * step[2];
    }
    /// The same by its number; `factor`: texels an axis.
    glm::vec3 texel(std::size_t number, int factor) const {
        const int t = int(number);
        return texel(t % factor, t / factor % factor, t / (factor * factor));
    }
};

/// All cells of a field's volumes, and which of them may be blocked.
struct MaskCells {
    std::size_t count = 0;          ///< of all
    std::vector<MaskCell> blocked;  ///< volume by volume, x fastest
    std::vector<glm::vec3> probes;  ///< by slot, metres, in the world
};

/// The desc and positions must be valid. Bounds may be infinite. A cell without occluders is one that none of them
/// comes near to, wherever in reach of it its probes stand.
MaskCells findMaskCells(const FieldDesc& field, const MaskDesc& desc, const Bounds& all);

/// How far probes stand off their places in a volume, per axis of its frame, metres. `probes`: those of the volume.
glm::vec3 farthestOffset(const VolumeDesc& volume, const kernels::Volume& v, std::span<const glm::vec3> probes);

/// A range of a volume's cells, `end` not in it; none where it is not above `begin`.
struct CellRange {
    glm::ivec3 begin{0}, end{0};
};

/// The cells that something within bounds (world, metres) may block, probes standing up to `offset` off their places.
CellRange cellsTouched(const kernels::Volume& v, glm::vec3 offset, const Bounds& bounds);

/// A cell of a volume whose slots begin at `firstSlot`. `probes`: of all volumes.
MaskCell makeMaskCell(const VolumeDesc& volume, int firstSlot, glm::ivec3 base, int factor,
                      std::span<const glm::vec3> probes);

/// Trilinear weights of a cell's eight probes at its texels: [texel][probe]. `factor`: texels an axis.
std::vector<std::array<float, 8>> texelWeights(int factor);

}  // namespace probegi

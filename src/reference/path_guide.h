#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "probegi/volume.h"

namespace probegi {

/// Learned directions of incoming light: for each region of space, boxes around the places that send it much light,
/// such as sunlit floor or sky behind a window. Boxes are fixed in space, so one list serves a whole region without
/// parallax. A direction is sampled through a uniform point in a box; its density is
/// in closed form (t1^3 - t0^3) / (3 V) for a ray inside the box from t0 to t1.
class PathGuide {
public:
    static constexpr int kLanes = 8;  ///< boxes evaluated at once
    static constexpr int kMaxBlocks = 8;
    static constexpr int kMaxBoxes = kLanes * kMaxBlocks;  ///< per region
    static constexpr int kFacings = 6;                     ///< regions by the axis that a receiver faces
    static constexpr int kCellsPerSpacing = 1;
    /// The rest is sampled from the BSDF, so light unknown to the guide keeps at least 1 / 5 of its density.
    static constexpr float kMaxShare = 0.8f;

    /// Boxes of zero strength pad the last block of a region; they are never chosen.
    struct alignas(32) Block {
        float lower[3][kLanes];
        float upper[3][kLanes];
        float strength[kLanes];  ///< radiance times the share of the box that is bright and visible
    };

    struct Region {
        std::uint32_t firstBlock = 0;
        std::uint32_t blocks = 0;
        float background = 0;  ///< mean radiance, cosine-weighted, from outside the boxes
        float expected = 0;    ///< root mean square of the incoming radiance, as sampled; 0: none or unknown
    };

    /// The guide at one point: the boxes, weighted by their apparent brightness from there.
    struct Mixture {
        const Block* blocks = nullptr;
        int count = 0;    ///< of blocks
        float share = 0;  ///< of samples to draw from the boxes, 0..kMaxShare
        float total = 0;  ///< of the weights
        float weights[kMaxBoxes];
    };

    /// For learning: the regions are set afterwards.
    explicit PathGuide(const VolumeDesc& grid);

    /// The region of a point that faces `normal`, 0..regionCount()-1. Points outside the grid belong to its edge.
    std::size_t regionOf(glm::vec3 position, glm::vec3 normal) const noexcept;
    std::size_t regionCount() const noexcept { return m_regions.size(); }
    const Region& region(std::size_t index) const noexcept { return m_regions[index]; }
    /// At most kMaxBlocks blocks; replaces an earlier list of the region.
    void setRegion(std::size_t index, std::vector<Block> blocks, float background);
    void clearRegion(std::size_t index) noexcept { m_regions[index].blocks = 0; }
    /// Values that are not positive and finite mean unknown.
    void setExpected(std::size_t index, float expected) noexcept {
        m_regions[index].expected = expected > 0 && expected < 1e30f ? expected : 0.0f;
    }
    /// Whether no region has a box.
    bool empty() const noexcept;

    const Region& regionAt(glm::vec3 position, glm::vec3 normal) const noexcept {
        return m_regions[regionOf(position, normal)];
    }
    /// share == 0: no guiding here. The guide must outlive the mixture.
    void mixtureAt(const Region& region, glm::vec3 position, glm::vec3 normal, Mixture& out) const noexcept;
    void mixtureAt(glm::vec3 position, glm::vec3 normal, Mixture& out) const noexcept {
        mixtureAt(regionAt(position, normal), position, normal, out);
    }
    /// A unit direction from `position` through a box. `choice`, `u` and `v` are uniform in 0..1; the mixture's share
    /// must not be 0.
    static glm::vec3 sample(const Mixture& mixture, glm::vec3 position, float choice, glm::vec2 u, float v) noexcept;
    /// Density of sample() per steradian.
    static float pdf(const Mixture& mixture, glm::vec3 position, glm::vec3 direction) noexcept;

    /// Approximate cosine-weighted share of the hemisphere that each box of the block covers, 0..1.
    static void seenShares(const Block& block, glm::vec3 position, glm::vec3 normal, float* out) noexcept;

private:
    VolumeDesc m_grid;
    std::vector<Region> m_regions;
    std::vector<Block> m_blocks;
};

}  // namespace probegi

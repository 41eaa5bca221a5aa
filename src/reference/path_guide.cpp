#include "reference/path_guide.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace probegi {

namespace {

constexpr float kPi = 3.14159265f;
/// Below this share of the samples, a guide is not worth its evaluation.
constexpr float kMinShare = 0.05f;

int facingOf(glm::vec3 n) {
    const glm::vec3 a = glm::abs(n);
    const int axis = a.x >= a.y && a.x >= a.z ? 0 : (a.y >= a.z ? 1 : 2);
    return 2 * axis + (n[axis] < 0 ? 1 : 0);
}

}  // namespace

PathGuide::PathGuide(const VolumeDesc& grid) : m_grid(grid) {
    m_grid.counts = grid.counts * kCellsPerSpacing;
    m_grid.spacing = grid.spacing / float(kCellsPerSpacing);
    m_regions.resize(std::size_t(probeCount(m_grid)) * kFacings);
}

std::size_t PathGuide::regionOf(glm::vec3 position, glm::vec3 normal) const noexcept {
    const glm::vec3 offset = glm::conjugate(m_grid.orientation) * (position - m_grid.origin);
    const glm::vec3 cell = glm::floor(offset / m_grid.spacing);
    const glm::ivec3 c(glm::clamp(cell, glm::vec3(0.0f), glm::vec3(m_grid.counts - 1)));
    return std::size_t(c.x + m_grid.counts.x * (c.y + m_grid.counts.y * c.z)) * kFacings +
           std::size_t(facingOf(normal));
}

void PathGuide::setRegion(std::size_t index, std::vector<Block> blocks, float background) {
    m_regions[index].firstBlock = std::uint32_t(m_blocks.size());
    m_regions[index].blocks = std::uint32_t(blocks.size());
    m_regions[index].background = background;
    m_blocks.insert(m_blocks.end(), blocks.begin(), blocks.end());
}

bool PathGuide::empty() const noexcept {
    return std::all_of(m_regions.begin(), m_regions.end(), [](const Region& region) { return region.blocks == 0; });
}

void PathGuide::seenShares(const Block& block, glm::vec3 p, glm::vec3 n, float* out) noexcept {
    const glm::vec3 a(std::abs(n.x), std::abs(n.y), std::abs(n.z));
    for (int i = 0; i < kLanes; ++i) {
        const float hx = 0.5f * (block.upper[0][i] - block.lower[0][i]);
        const float hy = 0.5f * (block.upper[1][i] - block.lower[1][i]);
        const float hz = 0.5f * (block.upper[2][i] - block.lower[2][i]);
        const float cx = block.lower[0][i] + hx - p.x;
        const float cy = block.lower[1][i] + hy - p.y;
        const float cz = block.lower[2][i] + hz - p.z;
        const float inverse = 1.0f / std::sqrt(cx * cx + cy * cy + cz * cz + hx * hx + hy * hy + hz * hz + 1e-12f);
        // Silhouette of a distant box; the quarters keep it positive if the point is inside.
        const float outline = 4.0f * inverse *
                              ((std::abs(cx) + 0.25f * hx) * hy * hz + (std::abs(cy) + 0.25f * hy) * hx * hz +
                               (std::abs(cz) + 0.25f * hz) * hx * hy);
        const float solid = std::min(outline * inverse * inverse, 2.0f * kPi);
        // Mean height above the horizon, assuming heights uniform between the lowest and the highest.
        const float height = n.x * cx + n.y * cy + n.z * cz;
        const float extent = a.x * hx + a.y * hy + a.z * hz + 1e-12f;
        const float top = std::max(height + extent, 0.0f);
        const float mean = height >= extent ? height : top * top / (4.0f * extent);
        out[i] = std::min(mean * inverse, 1.0f) * solid * (1.0f / kPi);
    }
}

void PathGuide::mixtureAt(const Region& here, glm::vec3 position, glm::vec3 normal, Mixture& out) const noexcept {
    out.share = 0;
    out.count = int(here.blocks);
    if (out.count == 0) return;
    out.blocks = m_blocks.data() + here.firstBlock;
    float sums[kLanes] = {};
    for (int b = 0; b < out.count; ++b) {
        float* weights = out.weights + b * kLanes;
        seenShares(out.blocks[b], position, normal, weights);
        for (int i = 0; i < kLanes; ++i) sums[i] += weights[i] *= out.blocks[b].strength[i];
    }
    out.total = 0;
    for (const float sum : sums) out.total += sum;
    const float share = out.total / (out.total + here.background);
    if (share >= kMinShare) out.share = std::min(share, kMaxShare);  // not-a-number is no share
}

glm::vec3 PathGuide::sample(const Mixture& mixture, glm::vec3 position, float choice, glm::vec2 u, float v) noexcept {
    const int boxes = mixture.count * kLanes;
    float left = choice * mixture.total;
    int chosen = -1;
    for (int i = 0; i < boxes; ++i) {
        if (mixture.weights[i] <= 0) continue;
        chosen = i;
        left -= mixture.weights[i];
        if (left < 0) break;
    }
    const Block& block = mixture.blocks[chosen / kLanes];
    const int lane = chosen % kLanes;
    const glm::vec3 within(u, v);
    glm::vec3 apart;
    for (int axis = 0; axis < 3; ++axis) {
        const float lower = block.lower[axis][lane], upper = block.upper[axis][lane];
        apart[axis] = lower + (upper - lower) * within[axis] - position[axis];
    }
    const float squared = glm::dot(apart, apart);
    return squared > 0 ? apart / std::sqrt(squared) : glm::vec3(0, 1, 0);
}

float PathGuide::pdf(const Mixture& mixture, glm::vec3 p, glm::vec3 direction) noexcept {
    const auto inverse = [](float d) { return 1.0f / (std::abs(d) < 1e-9f ? std::copysign(1e-9f, d) : d); };
    const float ix = inverse(direction.x), iy = inverse(direction.y), iz = inverse(direction.z);
    float sums[kLanes] = {};
    for (int b = 0; b < mixture.count; ++b) {
        const Block& block = mixture.blocks[b];
        const float* weights = mixture.weights + b * kLanes;
        for (int i = 0; i < kLanes; ++i) {
            const float x0 = (block.lower[0][i] - p.x) * ix, x1 = (block.upper[0][i] - p.x) * ix;
            const float y0 = (block.lower[1][i] - p.y) * iy, y1 = (block.upper[1][i] - p.y) * iy;
            const float z0 = (block.lower[2][i] - p.z) * iz, z1 = (block.upper[2][i] - p.z) * iz;
            const float enter =
                std::max(std::max(std::min(x0, x1), std::min(y0, y1)), std::max(std::min(z0, z1), 0.0f));
            const float leave = std::min(std::min(std::max(x0, x1), std::max(y0, y1)), std::max(z0, z1));
            const float length = std::max(leave - enter, 0.0f);
            const float volume = (block.upper[0][i] - block.lower[0][i]) * (block.upper[1][i] - block.lower[1][i]) *
                                 (block.upper[2][i] - block.lower[2][i]);
            const float density = length * (leave * leave + leave * enter + enter * enter) / (3.0f * volume);
            sums[i] += length > 0.0f ? weights[i] * density : 0.0f;
        }
    }
    float sum = 0;
    for (const float s : sums) sum += s;
    return sum / mixture.total;
}

}  // namespace probegi

#include "field/ray_order.h"

#include <algorithm>
#include <glm/common.hpp>

#include "kernels/probe/octahedral.h"
#include "kernels/volume/probe_cage.h"

namespace probegi {

namespace {

constexpr glm::ivec3 kBlock{2, 2, 4};
static_assert(kBlock.x * kBlock.y * kBlock.z == ProbeBlocks::kMostProbes);

// Interleaved bits of x and y, x lowest (Morton curve).
std::uint32_t interleaved(std::uint32_t x, std::uint32_t y) {
    std::uint32_t code = 0;
    for (int bit = 0; bit < 8; ++bit) code |= (x >> bit & 1u) << (2 * bit) | (y >> bit & 1u) << (2 * bit + 1);
    return code;
}

std::uint32_t placeOnCurve(glm::vec3 direction) {
    const glm::vec2 at = glm::clamp(kernels::octEncode(direction) * 128.0f + 128.0f, 0.0f, 255.0f);
    return interleaved(std::uint32_t(at.x), std::uint32_t(at.y));
}

}  // namespace

ProbeBlocks::ProbeBlocks(const GridDesc& grid) : m_counts(grid.counts), m_blocks((grid.counts + kBlock - 1) / kBlock) {}

std::size_t ProbeBlocks::count() const noexcept {
    return std::size_t(m_blocks.x) * std::size_t(m_blocks.y) * std::size_t(m_blocks.z);
}

void ProbeBlocks::probesOf(std::size_t block, std::vector<std::uint32_t>& probes) const {
    const int number = int(block);
    const glm::ivec3 lower =
        kBlock * glm::ivec3(number % m_blocks.x, number / m_blocks.x % m_blocks.y, number / (m_blocks.x * m_blocks.y));
    const glm::ivec3 upper = glm::min(lower + kBlock, m_counts);
    probes.clear();
    for (int z = lower.z; z < upper.z; ++z)
        for (int y = lower.y; y < upper.y; ++y)
            for (int x = lower.x; x < upper.x; ++x)
                probes.push_back(std::uint32_t(kernels::probeNumber({x, y, z}, m_counts)));
}

std::vector<OrderedDirection> alongCurve(std::span<const glm::vec3> directions) {
    std::vector<OrderedDirection> ordered;
    for (std::uint32_t i = 0; i < directions.size(); ++i) ordered.push_back({directions[i], i});
    std::sort(ordered.begin(), ordered.end(), [](const OrderedDirection& a, const OrderedDirection& b) {
        const std::uint32_t first = placeOnCurve(a.direction), second = placeOnCurve(b.direction);
        return first != second ? first < second : a.index < b.index;
    });
    return ordered;
}

}  // namespace probegi

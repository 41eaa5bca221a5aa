#include "field/ray_order.h"

#include <algorithm>
#include <glm/common.hpp>
#include <numeric>

#include "field/layout.h"
#include "kernels/probe/octahedral.h"

namespace probegi {

namespace {

constexpr glm::ivec3 kBlock{2, 2, 4};
static_assert(kBlock.x * kBlock.y * kBlock.z == TaskBlocks::kMostTasks);

glm::ivec3 boxesOf(const kernels::Volume& volume) {
    return (volume.counts + kBlock - 1) / kBlock;
}

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

TaskBlocks::TaskBlocks(std::span<const kernels::Volume> volumes, std::span<const ProbeTask> tasks)
    : m_tasks(tasks.size()) {
    std::vector<std::uint32_t> firstBlock;
    std::uint32_t blocks = 0;
    for (const kernels::Volume& v : volumes) {
        firstBlock.push_back(blocks);
        const glm::ivec3 boxes = boxesOf(v);
        blocks += std::uint32_t(boxes.x * boxes.y * boxes.z);
    }
    const auto blockOf = [&](const ProbeTask& task) {
        const kernels::Volume& v = volumes[task.volume];
        const glm::ivec3 boxes = boxesOf(v), box = kernels::probeCell(v, int(task.slot)) / kBlock;
        return firstBlock[task.volume] + std::uint32_t(box.x + boxes.x * (box.y + boxes.y * box.z));
    };
    // Sorted by counting: the end of each box, then its tasks from the last one down.
    m_begins.resize(blocks + 1);
    for (const ProbeTask& task : tasks) ++m_begins[blockOf(task)];
    std::partial_sum(m_begins.begin(), m_begins.end(), m_begins.begin());
    for (std::size_t i = tasks.size(); i-- > 0;) m_tasks[--m_begins[blockOf(tasks[i])]] = std::uint32_t(i);
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

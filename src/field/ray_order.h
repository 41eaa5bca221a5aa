#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "kernels/volume/volume.h"
#include "probegi/control.h"

namespace probegi {

/// The order in which an update traces its rays. A batch has the probes of a small box of a volume and some directions,
/// and rays of one direction lie side by side in it: they start near each other, meet the same nodes, triangles, texels
/// and probes, and find them in the caches. Rays of one probe have nothing in common but their origin.

/// An update's tasks in boxes of up to 16 neighbouring probes.
class TaskBlocks {
public:
    static constexpr int kMostTasks = 16;

    TaskBlocks(std::span<const kernels::Volume> volumes, std::span<const ProbeTask> tasks);

    std::size_t count() const noexcept { return m_begins.size() - 1; }
    /// Numbers of the tasks of one box, in their order; none where no task is in the box.
    std::span<const std::uint32_t> tasksOf(std::size_t block) const noexcept {
        return std::span(m_tasks).subspan(m_begins[block], m_begins[block + 1] - m_begins[block]);
    }

private:
    std::vector<std::uint32_t> m_tasks;   // box by box
    std::vector<std::uint32_t> m_begins;  // of each box in m_tasks, and the end
};

/// A direction of a set with its index.
struct OrderedDirection {
    glm::vec3 direction;
    std::uint32_t index;
};

/// The directions along a space-filling curve over the sphere, so that consecutive ones are similar.
std::vector<OrderedDirection> alongCurve(std::span<const glm::vec3> directions);

}  // namespace probegi

#include "cpu/solid_probes.h"

#include <glm/geometric.hpp>

#include "core/parallel.h"
#include "kernels/volume/probe_offset.h"

namespace probegi {

namespace {

glm::vec3 offsetOf(const FieldView& view, const kernels::Volume& volume, int slot) {
    return kernels::probeOffset(volume, int(view.placements[slot]));
}

// Steps into the open by way of the 26 neighbours.
std::uint32_t stepsByNeighbours(const FieldView& view, std::span<const kernels::ProbeSides> sides,
                                const ProbeTask& task) {
    const kernels::Volume& volume = view.volumes[task.volume];
    const int probe = int(task.slot);
    const glm::ivec3 cell = kernels::probeCell(volume, probe);
    const glm::ivec3 lowest = glm::max(cell - 1, glm::ivec3(0)), highest = glm::min(cell + 1, volume.counts - 1);
    std::uint32_t steps = kernels::kNoWayOut;
    for (int z = lowest.z; z <= highest.z; ++z)
        for (int y = lowest.y; y <= highest.y; ++y)
            for (int x = lowest.x; x <= highest.x; ++x) {
                const int neighbour = kernels::probeSlot(volume, {x, y, z});
                const std::uint32_t by = kernels::stepsBy(sides[std::size_t(neighbour)].steps);
                if (by >= steps || neighbour == probe) continue;
                glm::vec3 way = glm::vec3(glm::ivec3(x, y, z) - cell) * volume.spacing;
                if (volume.relocated != 0) way += offsetOf(view, volume, neighbour) - offsetOf(view, volume, probe);
                const float distance = glm::length(way);
                const glm::vec3 direction = kernels::toWorldDirection(volume, way / distance);
                if (kernels::freeWay(probeMoments(view, probe, direction).x,
                                     probeMoments(view, neighbour, -direction).x, distance * volume.inverseMaxDistance))
                    steps = by;
            }
    return steps;
}

}  // namespace

void findSolidProbes(const Context& context, const FieldView& view, std::span<const ProbeTask> tasks,
                     std::span<kernels::ProbeSides> sides) {
    parallelFor(context, tasks.size(), 256, [&](std::size_t begin, std::size_t end) {
        for (const ProbeTask& task : tasks.subspan(begin, end - begin)) {
            kernels::ProbeSides& own = sides[task.slot];
            const std::uint32_t found =
                kernels::looksForWay(own) ? stepsByNeighbours(view, sides, task) : kernels::kNoWayOut;
            const kernels::ProbeSides next = kernels::foundWay(own, found);
            own.nextSteps = next.nextSteps;
            own.trust = next.trust;
        }
    });
}

}  // namespace probegi

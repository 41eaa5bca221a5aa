#include "mask/mask_cells.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "field/layout.h"
#include "kernels/lookup/used_probes.h"

namespace probegi {

namespace {

/// Added around cells, in spacings: rays end a little beyond texels.
constexpr float kMargin = 0.05f;

/// The cells of one axis that a range of the volume's frame touches; all in spacings from the lowest probe.
std::pair<int, int> touched(float lower, float upper, int cells) {
    // Comparisons that a NaN fails leave all cells in.
    const float low = lower > 0.0f ? std::min(std::floor(lower), float(cells)) : 0.0f;
    const float high = upper < float(cells) ? std::max(std::floor(upper), -1.0f) : float(cells - 1);
    return {int(low), std::min(int(high), cells - 1)};
}

void mark(glm::ivec3 cells, const CellRange& range, std::vector<bool>& blocked) {
    for (int z = range.begin.z; z < range.end.z; ++z)
        for (int y = range.begin.y; y < range.end.y; ++y)
            for (int x = range.begin.x; x < range.end.x; ++x)
                blocked[std::size_t(x + cells.x * (y + cells.y * z))] = true;
}

}  // namespace

glm::vec3 farthestOffset(const VolumeDesc& volume, const kernels::Volume& v, std::span<const glm::vec3> probes) {
    glm::vec3 farthest(0.0f);
    for (std::size_t i = 0; i < probes.size(); ++i)
        farthest =
            glm::max(farthest, glm::abs(kernels::toVolumeDirection(v, probes[i] - probePosition(volume, int(i)))));
    return farthest;
}

CellRange cellsTouched(const kernels::Volume& v, glm::vec3 offset, const Bounds& bounds) {
    const kernels::Box box = kernels::boxInVolume(v, bounds.lower, bounds.upper);
    const glm::vec3 lower = (box.lower - offset - v.origin) * v.inverseSpacing - kMargin;
    const glm::vec3 upper = (box.upper + offset - v.origin) * v.inverseSpacing + kMargin;
    CellRange range;
    for (int axis = 0; axis < 3; ++axis) {
        const auto [first, last] = touched(lower[axis], upper[axis], v.counts[axis] - 1);
        range.begin[axis] = first;
        range.end[axis] = last + 1;
    }
    return range;
}

MaskCell makeMaskCell(const VolumeDesc& volume, int firstSlot, glm::ivec3 base, int factor,
                      std::span<const glm::vec3> probes) {
    const auto number = [&](glm::ivec3 at) { return at.x + volume.counts.x * (at.y + volume.counts.y * at.z); };
    MaskCell cell;
    for (std::size_t i = 0; i < 8; ++i) {
        cell.slot[i] = firstSlot + number(base + glm::ivec3(int(i) & 1, int(i) >> 1 & 1, int(i) >> 2));
        cell.probe[i] = probes[std::size_t(cell.slot[i])];
    }
    cell.origin = probePosition(volume, number(base));
    cell.texelSize = 1e30f;
    for (int axis = 0; axis < 3; ++axis) {
        glm::ivec3 next = base;
        ++next[axis];
        glm::vec3& step = cell.step[std::size_t(axis)];
        step = (probePosition(volume, number(next)) - cell.origin) / float(factor - 1);
        cell.texelSize = std::min(cell.texelSize, glm::length(step));
    }
    return cell;
}

MaskCells findMaskCells(const FieldDesc& field, const MaskDesc& desc, const Bounds& all) {
    MaskCells found;
    for (const VolumeDesc& volume : field.volumes)
        for (int i = 0; i < probeCount(volume); ++i) found.probes.push_back(probePosition(volume, i));
    if (!desc.positions.empty()) found.probes.assign(desc.positions.begin(), desc.positions.end());

    const std::vector<kernels::Volume> volumes = makeVolumes(field);
    for (std::size_t i = 0; i < volumes.size(); ++i) {
        const kernels::Volume& v = volumes[i];
        const glm::ivec3 cells = v.counts - 1;
        const std::size_t count = std::size_t(cells.x) * std::size_t(cells.y) * std::size_t(cells.z);
        const auto own =
            std::span(found.probes).subspan(std::size_t(v.firstSlot), std::size_t(kernels::volumeProbes(v)));
        const glm::vec3 offset = farthestOffset(field.volumes[i], v, own);
        std::vector<bool> blocked(count);
        for (const Bounds& bounds : desc.occluders.empty() ? std::span(&all, 1) : desc.occluders)
            mark(cells, cellsTouched(v, offset, bounds), blocked);
        for (std::size_t c = 0; c < count; ++c) {
            const glm::ivec3 base(int(c) % cells.x, int(c) / cells.x % cells.y, int(c) / (cells.x * cells.y));
            if (blocked[c])
                found.blocked.push_back(makeMaskCell(field.volumes[i], v.firstSlot, base, desc.factor, found.probes));
        }
        found.count += count;
    }
    return found;
}

std::vector<std::array<float, 8>> texelWeights(int factor) {
    std::vector<std::array<float, 8>> weights;
    const float scale = 1.0f / float(factor - 1);
    for (int z = 0; z < factor; ++z)
        for (int y = 0; y < factor; ++y)
            for (int x = 0; x < factor; ++x) {
                const glm::vec3 at = glm::vec3(glm::ivec3(x, y, z)) * scale;
                std::array<float, 8>& w = weights.emplace_back();
                for (int i = 0; i < 8; ++i)
                    w[std::size_t(i)] =
                        (i & 1 ? at.x : 1 - at.x) * (i & 2 ? at.y : 1 - at.y) * (i & 4 ? at.z : 1 - at.z);
            }
    return weights;
}

}  // namespace probegi

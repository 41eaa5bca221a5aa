#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "core/sentence.h"
#include "field/layout.h"
#include "field/walls.h"

namespace probegi {

namespace {

// Added to the margin, in cells: a whole number of cells would put probes exactly into the outermost walls.
constexpr float kOffWall = 0.25f;

// Probes per axis for cubic cells of side s that cover `size` with the margin, at least one.
glm::ivec3 countsFor(glm::vec3 size, float s, float marginCells) {
    const glm::vec3 cells = size / s + 2.0f * (marginCells + kOffWall);
    return glm::clamp(glm::ivec3(glm::ceil(cells)) + 1, glm::ivec3(2), glm::ivec3(1024));
}

double total(glm::ivec3 counts) {
    return double(counts.x) * counts.y * counts.z;
}

// The smallest cubic cell whose grid has at most `target` probes, by bisection over the monotone count.
float cubicSpacing(glm::vec3 size, int target, float marginCells) {
    float high = std::max({size.x, size.y, size.z});
    float low = high * 1e-4f;
    for (int i = 0; i < 48; ++i) {
        const float middle = std::sqrt(low * high);
        (total(countsFor(size, middle, marginCells)) > target ? low : high) = middle;
    }
    return high;
}

}  // namespace

Result<VolumeDesc> placeVolume(const Bounds& bounds, const PlacementDesc& desc) {
    const glm::vec3 size = bounds.size();
    const float largest = std::max({size.x, size.y, size.z});
    if (!std::isfinite(largest) || !(largest > 0))
        return fail(ErrorCode::invalidArgument, "the scene has no extent to place probes in; set a volume");
    if (!(desc.marginCells >= 0) || desc.marginCells > 100)
        return fail(ErrorCode::invalidArgument, sentence("marginCells is ", desc.marginCells, "; it must be 0 to 100"));

    // A flat axis still gets a cell, and a little room so that the scene is never exactly on the grid's face.
    const glm::vec3 padded = glm::max(size, glm::vec3(largest * 1e-3f));
    VolumeDesc grid;
    if (desc.counts == glm::ivec3(0)) {
        if (desc.targetProbes < 8 || desc.targetProbes > 1 << 24)
            return fail(ErrorCode::invalidArgument,
                        sentence("targetProbes is ", desc.targetProbes, "; it must be 8 to ", 1 << 24));
        const float spacing = cubicSpacing(padded, desc.targetProbes, desc.marginCells);
        grid.counts = countsFor(padded, spacing, desc.marginCells);
        grid.spacing = glm::vec3(spacing);
    } else {
        for (int axis = 0; axis < 3; ++axis) {
            if (desc.counts[axis] < 2 || desc.counts[axis] > 1024)
                return fail(ErrorCode::invalidArgument,
                            sentence("counts has ", desc.counts[axis], "; each axis must have 2 to 1024 probes"));
            const float inner = float(desc.counts[axis] - 1) - 2.0f * (desc.marginCells + kOffWall);
            // With too few probes for a margin on both sides, the scene fills the middle half of the grid.
            grid.spacing[axis] = padded[axis] / std::max(inner, 0.5f * float(desc.counts[axis] - 1));
        }
        grid.counts = desc.counts;
    }
    const float closest = std::min({grid.spacing.x, grid.spacing.y, grid.spacing.z});
    if (closest < kSmallestSpacing)
        return fail(
            ErrorCode::invalidArgument,
            sentence("the scene is only ", largest, " m large: its probes would be ", closest,
                     " m apart, but at least ", kSmallestSpacing, " m is needed; is it in metres? scale it up"));
    grid.origin = bounds.centre() - 0.5f * grid.spacing * glm::vec3(grid.counts - 1);
    return grid;
}

Result<VolumeDesc> placeVolume(const Tracer& tracer, const PlacementDesc& desc) {
    if (auto placeable = placeVolume(tracer.bounds(), desc); !placeable) return placeable;
    const auto walls = findWalls(tracer);
    if (!walls) return walls.error();
    Bounds bounds = tracer.bounds();
    const glm::quat frame = desc.turned ? wallFrame(*walls) : VolumeDesc{}.orientation;
    if (frame != VolumeDesc{}.orientation) {
        const auto turned = boundsInFrame(tracer, *walls, frame);
        if (!turned) return turned.error();
        bounds = *turned;
    }
    auto grid = placeVolume(bounds, desc);
    if (!grid) return grid;
    for (int axis = 0; axis < 3; ++axis) {
        glm::vec3 along(0.0f);
        along[axis] = 1;
        const AxisPlacement fitted =
            fitToWalls(wallsAcross(*walls, frame * along), walls->size(), {grid->origin[axis], grid->spacing[axis]},
                       grid->counts[axis], bounds.lower[axis], bounds.upper[axis], desc.marginCells);
        grid->origin[axis] = fitted.first;
        grid->spacing[axis] = fitted.spacing;
    }
    grid->origin = frame * grid->origin;
    grid->orientation = frame;
    return grid;
}

}  // namespace probegi

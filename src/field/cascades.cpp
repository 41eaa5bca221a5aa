#include <cmath>
#include <string>

#include "core/sentence.h"
#include "field/layout.h"
#include "kernels/abi/field_constants.h"

namespace probegi {

namespace {

constexpr float kLargestFactor = 16.0f;

Result<void> checkCascades(const CascadeDesc& desc) {
    if (desc.levels < 1 || desc.levels > kernels::kMostVolumes)
        return fail(ErrorCode::invalidArgument,
                    sentence("levels is ", desc.levels, "; it must be 1 to ", kernels::kMostVolumes));
    if (!(desc.factor > 1.0f && desc.factor <= kLargestFactor))
        return fail(ErrorCode::invalidArgument,
                    sentence("factor is ", desc.factor, "; it must be more than 1, and at most ", kLargestFactor));
    for (int axis = 0; axis < 3; ++axis) {
        if (!(desc.spacing[axis] >= kSmallestSpacing && desc.spacing[axis] <= kLargestSpacing))
            return fail(ErrorCode::invalidArgument,
                        sentence("spacing is ", desc.spacing[axis], " on an axis; it must be ", kSmallestSpacing,
                                 " to ", kLargestSpacing));
        if (!std::isfinite(desc.centre[axis])) return fail(ErrorCode::invalidArgument, "centre is not finite");
        if (desc.counts[axis] < kFewestTracking || desc.counts[axis] > 1024)
            return fail(ErrorCode::invalidArgument, sentence("counts is ", desc.counts[axis],
                                                             " on an axis; it must be ", kFewestTracking, " to 1024"));
    }
    return {};
}

}  // namespace

Result<std::vector<VolumeDesc>> makeCascades(const CascadeDesc& desc) {
    if (auto ok = checkCascades(desc); !ok) return ok.error();
    FieldDesc field;
    field.volumes.clear();
    glm::vec3 spacing = desc.spacing;
    for (int level = 0; level < desc.levels; ++level, spacing *= desc.factor) {
        const glm::vec3 half = 0.5f * spacing * glm::vec3(desc.counts - 1);
        field.volumes.push_back({.origin = desc.centre - half,
                                 .spacing = spacing,
                                 .counts = desc.counts,
                                 .tracksCamera = desc.tracksCamera});
    }
    // The rest is what any field asks of its volumes.
    if (auto ok = validateFieldDesc(field); !ok) return ok.error();
    return std::move(field.volumes);
}

}  // namespace probegi

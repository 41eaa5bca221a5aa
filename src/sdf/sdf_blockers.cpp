#include "sdf/sdf_blockers.h"

#include <glm/common.hpp>
#include <new>
#include <utility>

#include "sdf/placed_primitives.h"

namespace probegi {

namespace {

// How far a turn may be off a quarter's multiple and still leave a box along the world's axes.
constexpr float kUpright = 1e-6f;

/// A box whose axes are the world's, in another order or upside down, as one that is not turned: look-ups test it
/// faster.
kernels::SdfSolid upright(kernels::SdfSolid solid) {
    if (solid.shape != kernels::kSdfBox) return solid;
    glm::vec3 halfSize(0.0f);
    for (int axis = 0; axis < 3; ++axis) {
        glm::vec3 along(0.0f);
        along[axis] = 1;
        const glm::vec3 turned = glm::abs(kernels::sdfToWorld(solid, along));
        for (int other = 0; other < 3; ++other) {
            if (turned[other] > kUpright && turned[other] < 1 - kUpright) return solid;
            if (turned[other] > 0.5f) halfSize[other] = solid.halfSize[axis];
        }
    }
    solid.rotation = glm::vec4(0, 0, 0, 1);
    solid.halfSize = halfSize;
    return solid;
}

kernels::SdfBlocker blockerOf(const kernels::SdfSolid& given) {
    const kernels::SdfSolid solid = upright(given);
    if (solid.shape == kernels::kSdfPlane) return {solid, glm::vec3(kernels::kSdfFar)};
    const Bounds bounds = boundsOf(solid);
    return {solid, 0.5f * (bounds.upper - bounds.lower)};
}

}  // namespace

SdfBlockers::SdfBlockers(std::unique_ptr<Impl> impl) : m_impl(std::move(impl)) {}
SdfBlockers::~SdfBlockers() = default;

std::size_t SdfBlockers::size() const noexcept {
    return m_impl->blockers.size();
}

std::span<const kernels::SdfBlocker> blockersOf(const SdfBlockers* blockers) noexcept {
    if (!blockers) return {};
    return blockers->impl().blockers;
}

Result<std::shared_ptr<const SdfBlockers>> placeSdf(const SdfScene& sdf, const Scene& scene, const ScenePose& pose) {
    try {
        auto placed = PlacedPrimitives::create(sdf, scene, pose);
        if (!placed) return placed.error();
        auto impl = std::make_unique<SdfBlockers::Impl>();
        impl->blockers.reserve(placed->solids().size());
        for (const kernels::SdfSolid& solid : placed->solids()) impl->blockers.push_back(blockerOf(solid));
        return std::shared_ptr<const SdfBlockers>(std::make_shared<SdfBlockers>(std::move(impl)));
    } catch (const std::bad_alloc&) {
        return fail(ErrorCode::outOfMemory, "not enough memory for the primitives of the leak guard");
    }
}

}  // namespace probegi

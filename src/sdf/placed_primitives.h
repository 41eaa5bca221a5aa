#pragma once

#include <vector>

#include "kernels/sdf/primitive.h"
#include "probegi/sdf.h"

namespace probegi {

/// The primitives of a scene at one moment, in the world.
class PlacedPrimitives {
public:
    /// Errors: malformed (validate()), invalidArgument (a primitive rides on a node that the scene lacks, that has no
    /// mesh or that is not scaled alike along all axes).
    static Result<PlacedPrimitives> create(const SdfScene& sdf, const Scene& scene, const ScenePose& pose);

    /// Moves those that ride on nodes. Errors: invalidArgument, as above; nothing has then changed.
    Result<void> setPose(const ScenePose& pose);

    const std::vector<SdfPrimitive>& primitives() const noexcept { return m_primitives; }
    /// In the order of primitives().
    const std::vector<kernels::SdfSolid>& solids() const noexcept { return m_solids; }
    /// Of all but planes, which have none; zero-sized without any.
    Bounds bounds() const;

private:
    struct Rider {
        std::size_t primitive;
        int node;
    };

    std::vector<SdfPrimitive> m_primitives;
    std::vector<kernels::SdfSolid> m_solids;
    std::vector<Rider> m_riders;
};

/// The box along the world's axes around a solid; of a plane without limits.
Bounds boundsOf(const kernels::SdfSolid& solid);

}  // namespace probegi

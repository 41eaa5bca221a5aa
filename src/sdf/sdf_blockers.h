#pragma once

#include <span>
#include <vector>

#include "kernels/sdf/sdf_solid.h"
#include "probegi/sdf.h"

namespace probegi {

struct SdfBlockers::Impl {
    std::vector<kernels::SdfBlocker> blockers;
};

/// As look-ups read them (kernels/guards/sdf_shadow.h); of null none.
std::span<const kernels::SdfBlocker> blockersOf(const SdfBlockers* blockers) noexcept;

}  // namespace probegi

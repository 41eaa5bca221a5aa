#pragma once

#include <cstdint>

#include "probegi/sdf.h"

namespace probegi::tool {

/// FNV-1a (draft-eastlake-fnv, 64 bits) of all that light depends on: not of names, nor of what fitting keeps.
std::uint64_t hashOf(const SdfScene& sdf) noexcept;

}  // namespace probegi::tool

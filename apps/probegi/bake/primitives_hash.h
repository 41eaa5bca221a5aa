#pragma once

#include <cstdint>

#include "probegi/sdf.h"

namespace probegi::tool {

/// XXH64 of all that light depends on: not of names, nor of what fitting keeps.
std::uint64_t hashOf(const SdfScene& sdf);

}  // namespace probegi::tool

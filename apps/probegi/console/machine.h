#pragma once

#include <string>

namespace probegi::tool {

/// The processor's name from the operating system, or "unknown processor".
std::string processorName();

}  // namespace probegi::tool

#pragma once

#include <string>

namespace probegi::tool {

/// The processor's name as the operating system gives it; "unknown processor" where it gives none.
std::string processorName();

}  // namespace probegi::tool

#pragma once

#include <string_view>

#include "probegi/context.h"

namespace probegi::tool {

/// A context that talks to the person at the terminal: warnings on stderr, and a progress bar with the time left
/// where stderr is a terminal (nothing is drawn otherwise). Range of threads: 0 (all) to 1024.
Result<Context> makeContext(int threads);

/// "warning: ..." on stderr.
void printWarning(std::string_view sentence);

/// "error: ..." on stderr, as exactly one line. Returns the exit code of a failed run.
int printError(const Error& error);

}  // namespace probegi::tool

#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "probegi/context.h"

namespace probegi::tool {

/// A context that talks to the person at the terminal: warnings on stderr, and a progress bar with the time left
/// where stderr is a terminal (nothing is drawn otherwise). Range of threads: 0 (all) to 1024.
Result<Context> makeContext(int threads);

/// The same bar for a loop of the tool's own. Draws nothing where stderr is no terminal.
class LoopProgress {
public:
    LoopProgress(std::string stage, int total);
    ~LoopProgress();
    LoopProgress(const LoopProgress&) = delete;
    LoopProgress& operator=(const LoopProgress&) = delete;

    void done(int count);

private:
    struct Impl;
    std::unique_ptr<Impl> m_impl;
};

/// "warning: ..." on stderr.
void printWarning(std::string_view sentence);

/// "error: ..." on stderr, as exactly one line. Returns the exit code of a failed run.
int printError(const Error& error);

}  // namespace probegi::tool

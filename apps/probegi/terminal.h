#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "probegi/context.h"

namespace probegi::tool {

/// A context that talks to the person at the terminal: warnings on stderr, and a progress bar with the time left
/// where stderr is a terminal (nothing is drawn otherwise). Range of threads: 0 (all) to 1024.
Result<Context> makeContext(int threads);

/// One bar over several pieces of work, with the time left for all of them. Draws nothing where stderr is no terminal.
class WholeBar {
public:
    WholeBar();
    ~WholeBar();
    WholeBar(const WholeBar&) = delete;
    WholeBar& operator=(const WholeBar&) = delete;

    /// Guesses of the pieces' seconds, once they are known and before the first begins.
    void plan(std::vector<double> guesses);
    void begin(std::string piece);
    void done(double shareOfPiece);
    /// Takes the bar away, for text that follows.
    void clear();

private:
    struct Impl;
    friend Result<Context> makeContext(int threads, WholeBar& bar);
    std::shared_ptr<Impl> m_impl;
};

/// A context whose stages move the bar of the piece that they belong to. Before the first piece it draws nothing.
Result<Context> makeContext(int threads, WholeBar& bar);

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

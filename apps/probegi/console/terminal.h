#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <system_error>
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

/// Text of a file's or of the command line's as a terminal may show it: control characters, which could move the cursor
/// or rename the window, those that turn the direction of writing, and bytes that are no UTF-8 become "?", line breaks
/// become spaces. A text of more than `most` bytes loses its middle.
std::string plainText(std::string_view text, std::size_t most = std::string_view::npos);

/// What of a name is shown in a line of a table.
constexpr std::size_t kShownName = 80;

/// Makes sure that what was printed has arrived. `reason`: why printing failed before, where that is known. Returns the
/// exit code: that of the run, or 1 and "error: ...".
int closeStandardOutput(int exitCode, std::error_code reason = {});

/// Takes the numbers of standard streams that whoever started the program has closed, so that no file gets one of them
/// and with it what is printed. To be called first.
void keepStandardStreams();

/// "warning: ..." on stderr.
void printWarning(std::string_view sentence);

/// "error: ..." on stderr, as exactly one line. Returns the exit code of a failed run.
int printError(const Error& error);

}  // namespace probegi::tool

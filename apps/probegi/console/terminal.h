#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "probegi/context.h"

namespace probegi::tool {

/// A context that prints warnings to stderr and, if stderr is a terminal, draws a progress bar with the time left.
/// Range of threads: 0 (all) to 1024.
Result<Context> makeContext(int threads);

/// One progress bar over several pieces of work. Draws only if stderr is a terminal.
class WholeBar {
public:
    WholeBar();
    ~WholeBar();
    WholeBar(const WholeBar&) = delete;
    WholeBar& operator=(const WholeBar&) = delete;

    /// Estimated seconds of each piece. Call it before the first begins.
    void plan(std::vector<double> guesses);
    void begin(std::string piece);
    void done(double shareOfPiece);
    /// Clears the bar, so that text can be printed.
    void clear();

private:
    struct Impl;
    friend Result<Context> makeContext(int threads, WholeBar& bar);
    std::shared_ptr<Impl> m_impl;
};

/// A context whose stages advance the current piece of the bar. Draws nothing before the first piece.
Result<Context> makeContext(int threads, WholeBar& bar);

/// A progress bar for a loop in the tool itself. Draws only if stderr is a terminal.
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

/// Untrusted text made safe for a terminal: control characters (which could move the cursor or rename the window),
/// bidirectional controls and invalid UTF-8 become "?", line breaks become spaces. Texts of more than `most` bytes lose
/// their middle.
std::string plainText(std::string_view text, std::size_t most = std::string_view::npos);

/// Longest name shown in a table row, in bytes.
constexpr std::size_t kShownName = 80;

/// Flushes standard output and reports earlier failures of printing; `reason`: their cause, if known. Returns the exit
/// code of the run, or if printing failed prints "error: ..." and returns 1.
int closeStandardOutput(int exitCode, std::error_code reason = {});

/// Occupies the descriptors of standard streams that are closed at start. Otherwise the next file opened would get one
/// of them, and receive what is printed. Call it first.
void keepStandardStreams();

/// "warning: ..." on stderr.
void printWarning(std::string_view sentence);

/// "error: ..." on stderr, as exactly one line. Returns the exit code of a failed run.
int printError(const Error& error);

}  // namespace probegi::tool

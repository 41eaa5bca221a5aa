#pragma once

#include <functional>
#include <memory>
#include <string_view>

#include "probegi/result.h"

namespace probegi {

enum class LogLevel { info, warning };

/// A snapshot of one long-running stage, for a progress bar.
struct ProgressReport {
    std::string_view stage;     ///< what is being done, e.g. "path tracing"
    double fraction = 0;        ///< share done, 0..1
    double secondsElapsed = 0;  ///< since the stage began
    double secondsLeft = -1;    ///< estimate; negative while unknown
};

/// How a Context is made. All fields have working defaults.
struct ContextDesc {
    /// Worker threads. 0: all hardware threads. Range 0..1024. Results never depend on it.
    int threads = 0;
    /// Receives log lines; empty: silence. May be called from any thread, never from two at once.
    std::function<void(LogLevel, std::string_view)> log{};
    /// Receives progress about ten times a second at most, and once with fraction 1 at the end of each stage.
    /// Return false to cancel: the running call then returns ErrorCode::cancelled. Empty: no progress.
    std::function<bool(const ProgressReport&)> progress{};
};

/// Threads, log and progress: what every pass needs and no pass owns. Cheap to copy (shared handle);
/// there is no global state, two contexts are independent.
class Context {
public:
    /// Errors: invalidArgument when threads is out of range, outOfMemory where the system does not start so many.
    static Result<Context> create(const ContextDesc& desc = {});

    int threads() const noexcept;
    void log(LogLevel level, std::string_view line) const;

    struct Impl;
    Impl& impl() const noexcept { return *m_impl; }

private:
    explicit Context(std::shared_ptr<Impl> impl) : m_impl(std::move(impl)) {}
    std::shared_ptr<Impl> m_impl;
};

}  // namespace probegi

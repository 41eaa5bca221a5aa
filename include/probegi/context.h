#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string_view>

#include "probegi/export.h"
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
    /// Worker threads. 0: all hardware threads. Range 0..1024. Results never depend on it. 1: everything runs on the
    /// calling thread. Built without oneTBB (PROBEGI_TBB=OFF) the library has no threads of its own, so that 0 means 1,
    /// unless `parallelFor` brings some.
    int threads = 0;
    /// The engine's own job system, in place of threads of the library's: call task(i) for every i of 0..count, on any
    /// threads and in any order, and return when all are done. A task throws nothing; it must end on the thread where
    /// it began, and asks for no further loop: one within a task runs on the task's thread. Empty: the library's
    /// threads. Embree builds its trees on threads of its own in any case.
    std::function<void(std::size_t count, const std::function<void(std::size_t)>& task)> parallelFor{};
    /// Receives log lines; empty: silence. May be called from any thread, never from two at once.
    std::function<void(LogLevel, std::string_view)> log{};
    /// Receives progress about ten times a second at most, and once with fraction 1 at the end of each stage.
    /// Return false to cancel: the running call then returns ErrorCode::cancelled. Empty: no progress.
    std::function<bool(const ProgressReport&)> progress{};
};

/// Threads or the engine's jobs, log and progress: what every pass needs and no pass owns. Cheap to copy (shared
/// handle); there is no global state, two contexts are independent.
class PROBEGI_API Context {
public:
    /// Errors: invalidArgument (threads is out of range), unsupported (several threads, and none are there),
    /// outOfMemory (the system does not start so many).
    static Result<Context> create(const ContextDesc& desc = {});

    int threads() const noexcept;  ///< how many work at most
    void log(LogLevel level, std::string_view line) const;

    struct Impl;
    Impl& impl() const noexcept { return *m_impl; }

private:
    explicit Context(std::shared_ptr<Impl> impl) : m_impl(std::move(impl)) {}
    std::shared_ptr<Impl> m_impl;
};

}  // namespace probegi

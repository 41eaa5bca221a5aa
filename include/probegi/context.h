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
    double fraction = 0;        ///< completed share, 0..1
    double secondsElapsed = 0;  ///< since the stage began
    double secondsLeft = -1;    ///< estimate; negative while unknown
};

/// How a Context is made. All fields have working defaults.
struct ContextDesc {
    /// Worker threads, 0..1024. 0: all hardware threads; 1: everything runs on the calling thread. Results never depend
    /// on it. Without oneTBB (PROBEGI_TBB=OFF) the library has no threads of its own, and 0 means 1 unless
    /// `parallelFor` is set.
    int threads = 0;
    /// The engine's job system, used instead of the library's threads: call task(i) for every i in 0..count-1, on any
    /// threads and in any order, and return when all are done. Tasks do not throw, must finish on the thread they
    /// started on, and do not start further loops: nested loops run on the task's thread. Empty: the library's threads.
    /// Embree always builds its BVHs on its own threads.
    std::function<void(std::size_t count, const std::function<void(std::size_t)>& task)> parallelFor{};
    /// Receives log lines; empty: no log. Called from any thread, never from two at once.
    std::function<void(LogLevel, std::string_view)> log{};
    /// Receives progress at most about ten times a second, and once with fraction 1 at the end of each stage. Return
    /// false to cancel: the running call then returns ErrorCode::cancelled. Empty: no progress.
    std::function<bool(const ProgressReport&)> progress{};
};

/// Threads (or the engine's jobs), log and progress, shared by all passes. Cheap to copy (shared handle). There is no
/// global state; contexts are independent.
class PROBEGI_API Context {
public:
    /// Errors: invalidArgument (threads is out of range), unsupported (several threads requested, built without
    /// threads), outOfMemory (the system cannot start that many).
    static Result<Context> create(const ContextDesc& desc = {});

    int threads() const noexcept;  ///< maximum number of concurrent threads
    void log(LogLevel level, std::string_view line) const;

    struct Impl;
    Impl& impl() const noexcept { return *m_impl; }

private:
    explicit Context(std::shared_ptr<Impl> impl) : m_impl(std::move(impl)) {}
    std::shared_ptr<Impl> m_impl;
};

}  // namespace probegi

#include "core/parallel.h"

#include <exception>

namespace probegi {

namespace {

// Whether this thread is running a task of an engine's job.
thread_local bool t_inJob = false;

// The first exception in any of an engine's jobs, whose threads must not see exceptions.
class FirstException {
public:
    void keepCurrent() {
        const std::scoped_lock lock(m_mutex);
        if (!m_first) m_first = std::current_exception();
    }
    void rethrow() const {
        if (m_first) std::rethrow_exception(m_first);
    }

private:
    std::mutex m_mutex;
    std::exception_ptr m_first;
};

void runJobs(const ContextDesc& desc, std::size_t count, const std::function<void(std::size_t)>& task) {
    FirstException thrown;
    desc.parallelFor(count, [&](std::size_t i) {
        const bool before = t_inJob;
        t_inJob = true;
        try {
            task(i);
        } catch (...) {
            thrown.keepCurrent();
        }
        t_inJob = before;
    });
    thrown.rethrow();
}

}  // namespace

void runTasks(const Context& context, std::size_t count, const std::function<void(std::size_t)>& task) {
    const Context::Impl& impl = context.impl();
    if (impl.threads > 1 && count > 1 && impl.desc.parallelFor && !t_inJob) return runJobs(impl.desc, count, task);
    if (impl.threads > 1 && count > 1 && impl.workers) return impl.workers->run(count, task);
    for (std::size_t i = 0; i < count; ++i) task(i);
}

void runInside(const Context& context, const std::function<void()>& body) {
    if (const auto& workers = context.impl().workers)
        workers->inside(body);
    else
        body();
}

}  // namespace probegi

#include "probegi/context.h"

#include <algorithm>
#include <latch>
#include <new>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "core/context_impl.h"
#include "core/sentence.h"

namespace probegi {

namespace {

/// Whether that many further threads can be started. TBB, which starts them later, aborts if it cannot.
Result<void> tryThreads(int count) {
    std::latch end(1);
    std::vector<std::jthread> threads;
    const char* reason = nullptr;
    std::string why;
    try {
        threads.reserve(std::size_t(count));
        while (int(threads.size()) < count) threads.emplace_back([&] { end.wait(); });
    } catch (const std::system_error& error) {
        why = error.code().message();
        reason = why.c_str();
    } catch (const std::bad_alloc&) {
        reason = "no memory";
    }
    end.count_down();
    if (!reason) return {};
    return fail(ErrorCode::outOfMemory,
                sentence("the system starts only ", threads.size() + 1, " of ", count + 1, " threads (", reason,
                         "); use fewer, or raise its limits on processes and memory (ulimit -u, ulimit -v)"));
}

}  // namespace

Result<Context> Context::create(const ContextDesc& desc) {
    if (desc.threads < 0 || desc.threads > 1024)
        return fail(ErrorCode::invalidArgument, sentence("threads is ", desc.threads, "; it must be 0 (all) to 1024"));
    const bool several = desc.parallelFor || workersExist();
    if (desc.threads > 1 && !several)
        return fail(ErrorCode::unsupported, sentence("threads is ", desc.threads,
                                                     ", but this ProbeGI was built without threads of its own; "
                                                     "leave it 0, or set parallelFor"));
    const int all = several ? std::max(1, int(std::thread::hardware_concurrency())) : 1;
    auto impl = std::make_shared<Impl>();
    impl->desc = desc;
    impl->threads = desc.threads > 0 ? desc.threads : all;
    if (!desc.parallelFor) {
        if (auto tried = tryThreads(impl->threads - 1); !tried) return tried.error();
        impl->workers = makeWorkers(impl->threads);
    }
    return Context(std::move(impl));
}

int Context::threads() const noexcept {
    return m_impl->threads;
}

void Context::log(LogLevel level, std::string_view line) const {
    if (!m_impl->desc.log) return;
    const std::lock_guard lock(m_impl->logMutex);
    m_impl->desc.log(level, line);
}

}  // namespace probegi

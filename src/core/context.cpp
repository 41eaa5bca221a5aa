#include "probegi/context.h"

#include <fmt/format.h>

#include <algorithm>
#include <latch>
#include <new>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "core/context_impl.h"

namespace probegi {

namespace {

/// Whether so many threads can run beside this one. TBB, which starts them later, ends the program where it cannot.
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
                fmt::format("the system starts only {} of {} threads ({}); ask for fewer, or raise its limits on "
                            "processes and memory (ulimit -u, ulimit -v)",
                            threads.size() + 1, count + 1, reason));
}

}  // namespace

Result<Context> Context::create(const ContextDesc& desc) {
    if (desc.threads < 0 || desc.threads > 1024)
        return fail(ErrorCode::invalidArgument, fmt::format("threads is {}; it must be 0 (all) to 1024", desc.threads));
    const int hardware = std::max(1, int(std::thread::hardware_concurrency()));
    const int threads = desc.threads > 0 ? desc.threads : hardware;
    if (auto tried = tryThreads(threads - 1); !tried) return tl::unexpected(tried.error());
    return Context(std::make_shared<Impl>(desc, threads));
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

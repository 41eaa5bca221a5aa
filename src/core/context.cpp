#include "probegi/context.h"

#include <algorithm>
#include <thread>

#include "core/context_impl.h"
#include "core/sentence.h"

namespace probegi {

Result<Context> Context::create(const ContextDesc& desc) {
    if (desc.threads < 0 || desc.threads > 1024)
        return fail(ErrorCode::invalidArgument, sentence("threads is ", desc.threads, "; it must be 0 (all) to 1024"));
    const bool several = desc.parallelFor || workersExist();
    if (desc.threads > 1 && !several)
        return fail(ErrorCode::unsupported, sentence("threads is ", desc.threads,
                                                     ", but this ProbeGI was built without threads of its own; "
                                                     "leave it 0, or give parallelFor"));
    const int all = several ? std::max(1, int(std::thread::hardware_concurrency())) : 1;
    auto impl = std::make_shared<Impl>();
    impl->desc = desc;
    impl->threads = desc.threads > 0 ? desc.threads : all;
    if (!desc.parallelFor) impl->workers = makeWorkers(impl->threads);
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

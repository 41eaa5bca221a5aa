#include "probegi/context.h"

#include <fmt/format.h>

#include <algorithm>
#include <thread>

#include "core/context_impl.h"

namespace probegi {

Result<Context> Context::create(const ContextDesc& desc) {
    if (desc.threads < 0 || desc.threads > 1024)
        return fail(ErrorCode::invalidArgument, fmt::format("threads is {}; it must be 0 (all) to 1024", desc.threads));
    const int hardware = std::max(1, int(std::thread::hardware_concurrency()));
    return Context(std::make_shared<Impl>(desc, desc.threads > 0 ? desc.threads : hardware));
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

#include "vulkan/device/errors.h"
#include "vulkan/device/recorder.h"

namespace probegi::vulkan {

struct Profiler::Impl {
    Impl(const Device& d, int passes) : device(d), maxPasses(passes), pool(nullptr) {
        if (d.impl().timestampBits == 0) return;
        pool = vk::raii::QueryPool(d.impl().device,
                                   vk::QueryPoolCreateInfo({}, vk::QueryType::eTimestamp, 2 * std::uint32_t(passes)));
    }
    bool timed() const { return *pool && int(names.size()) <= maxPasses; }
    void stamp(VkCommandBuffer commands, std::uint32_t query) const {
        vk::CommandBuffer(commands).writeTimestamp2(vk::PipelineStageFlagBits2::eAllCommands, *pool, query,
                                                    *device.impl().device.getDispatcher());
    }

    Device device;
    int maxPasses;
    vk::raii::QueryPool pool;
    std::vector<std::string> names;
};

Profiler::Profiler(std::unique_ptr<Impl> impl) : m_impl(std::move(impl)) {}
Profiler::Profiler(Profiler&&) noexcept = default;
Profiler& Profiler::operator=(Profiler&&) noexcept = default;
Profiler::~Profiler() = default;

Result<Profiler> Profiler::create(const Device& device, int maxPasses) {
    if (maxPasses < 1 || maxPasses > 1024) return fail(ErrorCode::invalidArgument, "maxPasses must be 1 to 1024");
    return guarded("making timestamps", [&] { return Profiler(std::make_unique<Impl>(device, maxPasses)); });
}

void Profiler::recordReset(VkCommandBuffer commands) {
    m_impl->names.clear();
    if (*m_impl->pool)
        vk::CommandBuffer(commands).resetQueryPool(*m_impl->pool, 0, 2 * std::uint32_t(m_impl->maxPasses),
                                                   *m_impl->device.impl().device.getDispatcher());
}

void Profiler::recordBegin(VkCommandBuffer commands, const char* name) {
    m_impl->names.emplace_back(name);
    if (m_impl->timed()) m_impl->stamp(commands, 2 * std::uint32_t(m_impl->names.size() - 1));
}

void Profiler::recordEnd(VkCommandBuffer commands) {
    if (m_impl->timed()) m_impl->stamp(commands, 2 * std::uint32_t(m_impl->names.size() - 1) + 1);
}

Result<std::vector<PassTime>> Profiler::read() const {
    return guarded("reading timestamps", [&] {
        std::vector<PassTime> times;
        const auto count = std::uint32_t(std::min<std::size_t>(m_impl->names.size(), std::size_t(m_impl->maxPasses)));
        if (!*m_impl->pool || count == 0) return times;
        const auto stamps = m_impl->pool.getResults<std::uint64_t>(0, 2 * count, 2 * count * sizeof(std::uint64_t),
                                                                   sizeof(std::uint64_t), vk::QueryResultFlagBits::e64);
        const std::uint32_t bits = m_impl->device.impl().timestampBits;
        const std::uint64_t mask = bits >= 64 ? ~std::uint64_t(0) : (std::uint64_t(1) << bits) - 1;
        const double tick = double(m_impl->device.impl().limits.timestampPeriod) * 1e-6;
        for (std::uint32_t i = 0; i < count; ++i)
            times.push_back(
                {m_impl->names[i], double((stamps.second[2 * i + 1] - stamps.second[2 * i]) & mask) * tick});
        return times;
    });
}

PassScope::PassScope(const Recorder& recorder, const Device::Impl& device, Profiler* profiler, const char* name)
    : m_recorder(recorder), m_device(device), m_profiler(profiler) {
    if (device.debugUtilsEnabled)
        recorder.commands().beginDebugUtilsLabelEXT(vk::DebugUtilsLabelEXT(name), recorder.dispatcher());
    if (profiler) profiler->recordBegin(recorder.commands(), name);
}

PassScope::~PassScope() {
    if (m_profiler) m_profiler->recordEnd(m_recorder.commands());
    if (m_device.debugUtilsEnabled) m_recorder.commands().endDebugUtilsLabelEXT(m_recorder.dispatcher());
}

}  // namespace probegi::vulkan

#include "vulkan/probe_volume_impl.h"

namespace probegi::vulkan {

ProbeVolume::ProbeVolume(std::unique_ptr<Impl> impl) : m_impl(std::move(impl)) {}
ProbeVolume::ProbeVolume(ProbeVolume&&) noexcept = default;
ProbeVolume& ProbeVolume::operator=(ProbeVolume&&) noexcept = default;
ProbeVolume::~ProbeVolume() = default;

Result<ProbeVolume> ProbeVolume::create(const Device& device, const FieldDesc& desc) {
    if (auto ok = validateFieldDesc(desc); !ok) return tl::unexpected(ok.error());
    return guarded("making a volume of probes", [&] { return ProbeVolume(std::make_unique<Impl>(device, desc)); });
}

const FieldDesc& ProbeVolume::desc() const noexcept {
    return m_impl->books.desc();
}
int ProbeVolume::frame() const noexcept {
    return m_impl->books.frame();
}
FieldMemory ProbeVolume::memory() const noexcept {
    return m_impl->passes.memory();
}
std::span<const glm::vec3> ProbeVolume::rayDirections() const noexcept {
    return m_impl->books.rayDirections();
}
void ProbeVolume::notify(FieldEvent event) noexcept {
    m_impl->books.notify(event);
}
void ProbeVolume::setGuard(LeakGuard guard) noexcept {
    m_impl->books.setGuard(guard);
}

void ProbeVolume::recordClear(VkCommandBuffer commands) {
    m_impl->passes.recordClear({m_impl->passes.device().impl(), commands});
    m_impl->books = FrameBooks(m_impl->books.desc());
}

Result<void> ProbeVolume::recordUpdate(VkCommandBuffer commands, const GpuScene& scene, const GpuLighting& lighting,
                                       Profiler* profiler) {
    return m_impl->recorded("recording an update", [&] {
        m_impl->passes.recordUpdate({m_impl->passes.device().impl(), commands}, m_impl->books.comingUpdate(), scene,
                                    lighting, profiler);
        m_impl->books.advance();
    });
}

Result<void> ProbeVolume::recordUpdate(VkCommandBuffer commands, VkDeviceAddress rayData, Profiler* profiler) {
    return m_impl->recorded("recording an update", [&] {
        m_impl->passes.recordUpdate({m_impl->passes.device().impl(), commands}, m_impl->books.comingUpdate(), rayData,
                                    {}, profiler);
        m_impl->books.advance();
    });
}

Result<void> ProbeVolume::recordQuery(VkCommandBuffer commands, VkDeviceAddress queries, VkDeviceAddress irradiance,
                                      std::uint32_t count, Profiler* profiler) {
    return m_impl->recorded("recording a query", [&] {
        m_impl->passes.recordQuery({m_impl->passes.device().impl(), commands}, m_impl->books.desc(), queries,
                                   irradiance, count, profiler);
    });
}

std::array<VkDescriptorSetLayoutBinding, kQueryBindings> ProbeVolume::queryBindings(
    std::uint32_t firstBinding, VkShaderStageFlags stages) noexcept {
    return {{{firstBinding, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 1, stages, nullptr},
             {firstBinding + 1, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1, stages, nullptr},
             {firstBinding + 2, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1, stages, nullptr},
             {firstBinding + 3, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, stages, nullptr}}};
}

void ProbeVolume::writeQueryBindings(VkDescriptorSet set, std::uint32_t firstBinding) const {
    m_impl->passes.writeQueryBindings(set, firstBinding);
}

}  // namespace probegi::vulkan

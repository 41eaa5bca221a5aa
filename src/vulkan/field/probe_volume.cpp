#include "core/sentence.h"
#include "vulkan/field/probe_volume_impl.h"

namespace probegi::vulkan {

namespace {

// Whether a range of the caller's holds `count` values of `size` bytes; `what` names it.
Result<void> checkRange(const BufferRange& range, const char* what, std::size_t count, std::size_t size) {
    const std::size_t needed = count * size;
    if (range.bytes < needed)
        return fail(ErrorCode::invalidArgument,
                    sentence(what, " has ", range.bytes, " bytes; all rays of all probes need ", needed, " of ", size,
                             " each"));
    if (range.address == 0 || range.address % 4 != 0)
        return fail(ErrorCode::invalidArgument,
                    sentence("the address of ", what, " must be a multiple of 4, and not 0"));
    return {};
}

}  // namespace

ProbeVolume::ProbeVolume(std::unique_ptr<Impl> impl) : m_impl(std::move(impl)) {}
ProbeVolume::ProbeVolume(ProbeVolume&&) noexcept = default;
ProbeVolume& ProbeVolume::operator=(ProbeVolume&&) noexcept = default;
ProbeVolume::~ProbeVolume() = default;

Result<ProbeVolume> ProbeVolume::create(const Device& device, const FieldDesc& desc) {
    if (auto ok = validateFieldDesc(desc); !ok) return ok.error();
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
std::span<const glm::vec3> ProbeVolume::fixedRayDirections() const noexcept {
    return m_impl->books.fixedRayDirections();
}
void ProbeVolume::notify(FieldEvent event) noexcept {
    m_impl->books.notify(event);
}
void ProbeVolume::setGuard(LeakGuard guard) noexcept {
    m_impl->books.setGuard(guard);
}

Result<void> ProbeVolume::recordGuard(VkCommandBuffer commands) {
    return m_impl->recorded("recording a leak guard", [&] {
        m_impl->passes.recordGuard({m_impl->passes.device().impl(), commands}, m_impl->books.desc());
    });
}

Result<void> ProbeVolume::recordClear(VkCommandBuffer commands) {
    return m_impl->recorded("recording the clearing of probes", [&] {
        FrameBooks cleared(m_impl->books.desc());
        m_impl->passes.recordClear({m_impl->passes.device().impl(), commands}, m_impl->books.desc().guard);
        m_impl->books = std::move(cleared);
    });
}

Result<void> ProbeVolume::recordUpdate(VkCommandBuffer commands, const GpuScene& scene, const GpuLighting& lighting,
                                       Profiler* profiler) {
    return m_impl->recorded("recording an update", [&] {
        m_impl->passes.recordUpdate({m_impl->passes.device().impl(), commands}, m_impl->books.comingUpdate(), scene,
                                    lighting, profiler);
        m_impl->books.advance();
    });
}

Result<void> ProbeVolume::recordUpdate(VkCommandBuffer commands, const BufferRange& rayData, Profiler* profiler) {
    return recordUpdate(commands, rayData, BufferRange(), profiler);
}

Result<void> ProbeVolume::recordUpdate(VkCommandBuffer commands, const BufferRange& rayData,
                                       const BufferRange& fixedRays, Profiler* profiler) {
    FrameBooks& books = m_impl->books;
    const std::size_t probes = m_impl->passes.layout().probes;
    if (auto ok = checkRange(rayData, "rayData", probes * books.rayDirections().size(), sizeof(RayDatum)); !ok)
        return ok;
    const std::size_t fixed = probes * books.fixedRayDirections().size();
    if (!fixedRays.empty())
        if (auto ok = checkRange(fixedRays, "fixedRays", fixed, sizeof(FixedRayDatum)); !ok) return ok;
    return m_impl->recorded("recording an update", [&] {
        const UpdateFrame frame = fixedRays.empty() ? books.comingUpdateWithoutFixedRays() : books.comingUpdate();
        m_impl->passes.recordUpdate({m_impl->passes.device().impl(), commands}, frame,
                                    RayAddresses{rayData.address, fixedRays.address}, profiler);
        books.advance();
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

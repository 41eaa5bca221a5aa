#include "core/sentence.h"
#include "field/layout.h"
#include "vulkan/field/gpu_field_impl.h"

namespace probegi::vulkan {

namespace {

// Whether the caller's range holds `count` values of `size` bytes; `what` names it in errors.
Result<void> checkRange(const BufferRange& range, const char* what, std::size_t count, std::size_t size) {
    const std::size_t needed = count * size;
    if (range.bytes < needed)
        return fail(
            ErrorCode::invalidArgument,
            sentence(what, " has ", range.bytes, " bytes; all rays of all tasks need ", needed, " of ", size, " each"));
    if (range.address == 0 || range.address % 4 != 0)
        return fail(ErrorCode::invalidArgument,
                    sentence("the address of ", what, " must be a multiple of 4, and not 0"));
    return {};
}

}  // namespace

GpuField::GpuField(std::unique_ptr<Impl> impl) : m_impl(std::move(impl)) {}
GpuField::GpuField(GpuField&&) noexcept = default;
GpuField& GpuField::operator=(GpuField&&) noexcept = default;
GpuField::~GpuField() = default;

Result<GpuField> GpuField::create(const Device& device, const FieldDesc& desc, const FieldSettings& settings) {
    if (auto ok = validateFieldDesc(desc); !ok) return ok.error();
    if (auto ok = validateFieldSettings(settings); !ok) return ok.error();
    if (auto ok = validateGuard(desc, settings); !ok) return ok.error();
    return guarded("making a field", [&] { return GpuField(std::make_unique<Impl>(device, desc, settings)); });
}

FieldControl& GpuField::control() noexcept {
    return m_impl->control;
}
const FieldControl& GpuField::control() const noexcept {
    return m_impl->control;
}
FieldMemory GpuField::memory() const noexcept {
    return m_impl->passes.memory();
}

Result<void> GpuField::recordSettings(VkCommandBuffer commands) {
    return m_impl->recorded("recording a field's settings", [&] {
        m_impl->passes.recordSettings({m_impl->passes.device().impl(), commands}, m_impl->control.settings());
    });
}

Result<void> GpuField::recordClear(VkCommandBuffer commands) {
    return m_impl->recorded("recording the clearing of probes", [&] {
        m_impl->passes.recordClear({m_impl->passes.device().impl(), commands}, m_impl->control.settings(),
                                   m_impl->books().raySet(0));
        m_impl->books().restart();
        m_impl->listedRays = {};
    });
}

Result<void> GpuField::recordScroll(VkCommandBuffer commands, int volume, glm::ivec3 cells) {
    return m_impl->recorded("recording the scrolling of a volume", [&] {
        m_impl->passes.prepareEnter();  // whatever can fail comes first: else the books would have moved alone
        auto placement = orThrow(m_impl->books().scrolledBy(volume, cells));
        m_impl->books().swapPlacement(placement);
        m_impl->passes.place(m_impl->books().volumes);
        m_impl->listedRays = {};
        m_impl->passes.recordEnter({m_impl->passes.device().impl(), commands}, m_impl->control.settings(), volume,
                                   cells);
    });
}

Result<void> GpuField::recordFollowCamera(VkCommandBuffer commands, glm::vec3 camera) {
    const auto cells = m_impl->books().cellsAfter(camera);
    if (!cells) return cells.error();
    for (std::size_t i = 0; i < cells->size(); ++i)
        if ((*cells)[i] != glm::ivec3(0))
            if (auto scrolled = recordScroll(commands, int(i), (*cells)[i]); !scrolled) return scrolled;
    m_impl->books().settings.camera = camera;
    m_impl->books().chooseTasks();
    return recordSettings(commands);
}

Result<void> GpuField::recordUpdate(VkCommandBuffer commands, const GpuScene& scene, const GpuLighting& lighting,
                                    Profiler* profiler) {
    return m_impl->recorded("recording an update", [&] {
        const Recorder recorder{m_impl->passes.device().impl(), commands};
        const UpdateFrame frame = m_impl->books().comingUpdate();
        if (m_impl->passes.watched()) m_impl->passes.recordPlaces(recorder, frame, m_impl->places(), &scene, profiler);
        m_impl->listedRays = {};
        m_impl->passes.recordUpdate(recorder, frame, scene, lighting, profiler);
        m_impl->advance();
    });
}

Result<void> GpuField::recordTasks(VkCommandBuffer commands) {
    if (!m_impl->passes.watched())
        return fail(ErrorCode::invalidArgument,
                    "a field without relocation and probeStates has its tasks in control()");
    return m_impl->recorded("recording the listing of tasks", [&] {
        const Recorder recorder{m_impl->passes.device().impl(), commands};
        const UpdateFrame frame = m_impl->books().comingUpdate();
        m_impl->passes.recordPlaces(recorder, frame, m_impl->places(), nullptr, nullptr);
        m_impl->passes.recordCounts(recorder, frame);
        m_impl->listedRays = {m_impl->books().rayCount(), m_impl->books().fixedRayCount()};
    });
}

VkBuffer GpuField::taskBuffer() const noexcept {
    return m_impl->passes.tasks().handle();
}

Result<void> GpuField::recordUpdate(VkCommandBuffer commands, const BufferRange& rayData, Profiler* profiler) {
    return recordUpdate(commands, rayData, BufferRange(), profiler);
}

Result<void> GpuField::recordUpdate(VkCommandBuffer commands, const BufferRange& rayData, const BufferRange& fixedRays,
                                    Profiler* profiler, RayFormat format) {
    FieldControl::Impl& books = m_impl->books();
    const bool watched = m_impl->passes.watched();
    if (watched && !m_impl->listedRays)
        return fail(ErrorCode::invalidArgument,
                    "with relocation or probeStates the GPU lists the tasks: call recordTasks() first, and trace the "
                    "rays of the tasks in taskBuffer()");
    const std::size_t rays = watched ? m_impl->listedRays->update : books.rayCount(),
                      fixed = watched ? m_impl->listedRays->fixed : books.fixedRayCount();
    const std::size_t size = format == RayFormat::packed ? sizeof(PackedRayDatum) : sizeof(RayDatum);
    if (auto ok = checkRange(rayData, "rayData", rays, size); !ok) return ok;
    if (!fixedRays.empty())
        if (auto ok = checkRange(fixedRays, "fixedRays", fixed, sizeof(FixedRayDatum)); !ok) return ok;
    return m_impl->recorded("recording an update", [&] {
        const UpdateFrame frame = fixedRays.empty() ? books.comingUpdateWithoutFixedRays() : books.comingUpdate();
        const RayAddresses data{.update = rayData.address, .fixed = fixedRays.address, .format = format};
        const Recorder recorder{m_impl->passes.device().impl(), commands};
        m_impl->passes.recordUpdate(recorder, frame, data, profiler);
        if (watched) m_impl->passes.recordLook(recorder, data);
        m_impl->listedRays = {};
        m_impl->advance();
    });
}

Result<void> GpuField::recordQuery(VkCommandBuffer commands, VkDeviceAddress queries, VkDeviceAddress irradiance,
                                   std::uint32_t count, Profiler* profiler) {
    return m_impl->recorded("recording a query", [&] {
        m_impl->passes.recordQuery({m_impl->passes.device().impl(), commands}, m_impl->control.settings(), queries,
                                   irradiance, count, profiler);
    });
}

std::array<VkDescriptorSetLayoutBinding, kQueryBindings> GpuField::queryBindings(std::uint32_t firstBinding,
                                                                                 VkShaderStageFlags stages,
                                                                                 QueryConstants constants) noexcept {
    return {{{firstBinding, VkDescriptorType(constantsType(constants)), 1, stages, nullptr},
             {firstBinding + 1, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1, stages, nullptr},
             {firstBinding + 2, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1, stages, nullptr},
             {firstBinding + 3, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, stages, nullptr}}};
}

void GpuField::writeQueryBindings(VkDescriptorSet set, std::uint32_t firstBinding, QueryConstants constants) const {
    m_impl->passes.writeQueryBindings(set, firstBinding, constants);
}

}  // namespace probegi::vulkan

#include "vulkan/field/vulkan_field.h"

#include <chrono>
#include <cstring>
#include <limits>

#include "field/probe_emitters.h"
#include "vulkan/scene/gpu_lighting_impl.h"

namespace probegi::vulkan {

namespace {

using Clock = std::chrono::steady_clock;

static_assert(sizeof(kernels::EmitterLight) == 24, "shaders/emitter_lights.glsl");

constexpr std::size_t kQueriesPerPiece = std::size_t(1) << 20;
constexpr float kNotANumber = std::numeric_limits<float>::quiet_NaN();

double millisecondsSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

bool sameSky(const Sky& a, const Sky& b) {
    return a.radiance == b.radiance && a.image.width == b.image.width && a.image.height == b.image.height &&
           a.image.pixels == b.image.pixels;
}

bool sameLight(const PlacedLight& a, const PlacedLight& b) {
    return a.type == b.type && a.position == b.position && a.direction == b.direction && a.intensity == b.intensity &&
           a.range == b.range && a.cosInner == b.cosInner && a.cosOuter == b.cosOuter;
}

bool sameLighting(const Lighting& a, const Lighting& b) {
    return std::equal(a.lights.begin(), a.lights.end(), b.lights.begin(), b.lights.end(), sameLight) &&
           sameSky(a.sky, b.sky);
}

double sumOf(const std::vector<PassTime>& passes, const char* name) {
    double sum = 0;
    for (const PassTime& pass : passes)
        if (pass.name == name) sum += pass.milliseconds;
    return sum;
}

}  // namespace

VulkanField::VulkanField(const Context& context, const Device& device, const FieldDesc& desc,
                         const FieldSettings& settings)
    : m_context(context), m_device(device), m_passes(device, desc), m_exchange(device) {
    m_profiler.emplace(orThrow(Profiler::create(device)));
    submitAndWait(device, [&](const Recorder& recorder) { m_passes.recordClear(recorder, settings); });
}

template <class Body>
auto VulkanField::attempted(const char* doing, const Body& body) const {
    auto result = guarded(doing, body);
    if (!result) m_passes.forgetRecorded();
    return result;
}

const GpuLighting& VulkanField::uploaded(const Lighting& lighting) const {
    if (m_lightingSource && sameLighting(*m_lightingSource, lighting)) return *m_lighting;
    m_lightingSource.reset();
    m_lighting.emplace(orThrow(GpuLighting::create(m_device, lighting)));
    submitAndWait(m_device, [&](const Recorder& recorder) { orThrow(m_lighting->recordUpload(recorder.commands())); });
    m_lighting->releaseStaging();
    m_lightingSource = lighting;
    return *m_lighting;
}

UpdateTimes VulkanField::updateFrom(const UpdateFrame& frame, std::span<const RayDatum> rayData,
                                    std::span<const FixedRayDatum> fixedRays,
                                    std::span<const kernels::EmitterLight> lights) {
    const auto start = Clock::now();
    m_mirror.reset();
    m_exchange.begin(rayData.size_bytes() + fixedRays.size_bytes() + lights.size_bytes(), 16);
    RayAddresses addresses{.update = m_exchange.add(rayData)};
    if (!fixedRays.empty()) addresses.fixed = m_exchange.add(fixedRays);
    if (!lights.empty()) {
        addresses.emitterLights = m_exchange.add(lights);
        addresses.looks = int(lights.size() / frame.tasks.size());
    }
    m_exchange.run(
        [&](const Recorder& recorder) {
            m_profiler->recordReset(recorder.commands());
            m_passes.recordUpdate(recorder, frame, addresses, &*m_profiler);
        },
        0);
    m_updatePasses = orThrow(m_profiler->read());
    const double elapsed = millisecondsSince(start);
    return {0, 0, elapsed, elapsed};
}

UpdateTimes VulkanField::updateOnGpu(const UpdateFrame& frame, const GpuTracer& tracer, const Lighting& lighting) {
    const auto start = Clock::now();
    m_mirror.reset();
    const GpuLighting& lights = uploaded(lighting);
    submitAndWait(m_device, [&](const Recorder& recorder) {
        m_profiler->recordReset(recorder.commands());
        m_passes.recordUpdate(recorder, frame, tracer.scene(), lights, &*m_profiler);
    });
    m_updatePasses = orThrow(m_profiler->read());
    return {sumOf(m_updatePasses, "trace"), sumOf(m_updatePasses, "shade") + sumOf(m_updatePasses, "emitters"),
            sumOf(m_updatePasses, "weights") + sumOf(m_updatePasses, "windows") + sumOf(m_updatePasses, "events") +
                sumOf(m_updatePasses, "blend irradiance") + sumOf(m_updatePasses, "blend visibility") +
                sumOf(m_updatePasses, "filter") + sumOf(m_updatePasses, "solid probes"),
            millisecondsSince(start)};
}

Result<UpdateTimes> VulkanField::update(const UpdateFrame& frame, std::span<const RayDatum> rayData,
                                        std::span<const FixedRayDatum> fixedRays) {
    const std::lock_guard lock(m_mutex);
    return attempted("updating the field", [&] { return updateFrom(frame, rayData, fixedRays, {}); });
}

Result<UpdateTimes> VulkanField::update(const UpdateFrame& frame, const Tracer& tracer, const Lighting& lighting) {
    const auto* onGpu = dynamic_cast<const GpuTracer*>(&tracer);
    if (onGpu && &onGpu->device().impl() == &m_device.impl()) {
        const std::lock_guard lock(m_mutex);
        return attempted("updating the field", [&] { return updateOnGpu(frame, *onGpu, lighting); });
    }
    return attempted("updating the field", [&] {
        const auto start = Clock::now();
        const FieldDesc& desc = m_passes.desc();
        m_rayData.resize(frame.tasks.size() * m_passes.layout().rays);
        m_fixedRays.resize(frame.tasks.size() * frame.fixedDirections.size());
        BounceQuery bounces;
        if (frame.bounces)
            bounces = [&](std::span<const FieldQuery> queries, std::span<glm::vec3> out) {
                return irradiance(frame.settings, queries, out);
            };
        TraceTimes sums;
        const EmitterSearch emitters = emitterSearch(desc, tracer, frame.raySeed);
        m_emitterLights.resize(frame.tasks.size() * std::size_t(emitters.looks));
        orThrow(traceProbes(m_context, frame.volumes, frame.tasks, {frame.directions, frame.fixedDirections}, tracer,
                            lighting, bounces, emitters, {m_rayData, m_fixedRays}, sums));
        if (emitters)
            orThrow(lookAtEmitters(m_context, frame.volumes, frame.tasks, emitters, tracer, m_emitterLights, sums));
        const double traced = millisecondsSince(start);
        const double sum = std::max(1.0, double(sums.traceNs + sums.shadeNs));
        const std::lock_guard lock(m_mutex);
        UpdateTimes times = updateFrom(frame, m_rayData, m_fixedRays, m_emitterLights);
        times.trace = traced * double(sums.traceNs) / sum;
        times.shade = traced * double(sums.shadeNs) / sum;
        times.total = millisecondsSince(start);
        return times;
    });
}

Result<void> VulkanField::irradiance(const FieldSettings& settings, std::span<const FieldQuery> queries,
                                     std::span<glm::vec3> out) const {
    const std::lock_guard lock(m_mutex);
    return attempted("querying the field", [&] {
        m_queryPasses.clear();
        for (std::size_t first = 0; first < queries.size(); first += kQueriesPerPiece) {
            const std::size_t count = std::min(kQueriesPerPiece, queries.size() - first);
            m_exchange.begin(count * sizeof(FieldQuery), count * sizeof(glm::vec3));
            const VkDeviceAddress address = m_exchange.add(queries.subspan(first, count));
            m_exchange.run(
                [&](const Recorder& recorder) {
                    m_profiler->recordReset(recorder.commands());
                    m_passes.recordQuery(recorder, settings, address, m_exchange.out(), std::uint32_t(count),
                                         &*m_profiler);
                },
                count * sizeof(glm::vec3));
            std::copy_n(m_exchange.results<glm::vec3>().begin(), count, out.begin() + std::ptrdiff_t(first));
            for (const PassTime& pass : orThrow(m_profiler->read())) m_queryPasses.push_back(pass);
        }
    });
}

glm::vec3 VulkanField::irradiance(const FieldSettings& settings, const FieldQuery& query) const noexcept {
    glm::vec3 result(kNotANumber);
    const auto done = irradiance(settings, {&query, 1}, {&result, 1});
    return done ? result : glm::vec3(kNotANumber);
}

FieldMirror& VulkanField::mirror() const {
    if (!m_mirror) m_mirror.emplace(m_passes);
    return *m_mirror;
}

Result<ProbeLight> VulkanField::light() const {
    const std::lock_guard lock(m_mutex);
    return guarded("reading probes", [&] { return mirror().light(); });
}

void VulkanField::place(std::span<const kernels::Volume> volumes) noexcept {
    const std::lock_guard lock(m_mutex);
    m_passes.place(volumes);
}

Result<void> VulkanField::enter(const FieldSettings& settings, int volume, glm::ivec3 cells) {
    const std::lock_guard lock(m_mutex);
    m_mirror.reset();
    return attempted("scrolling a volume", [&] {
        m_passes.prepareEnter();
        submitAndWait(m_device,
                      [&](const Recorder& recorder) { m_passes.recordEnter(recorder, settings, volume, cells); });
    });
}

Result<void> VulkanField::setPlacements(const FieldSettings& settings, std::span<const std::uint32_t> placements,
                                        std::span<const std::uint32_t> renewed) {
    const std::lock_guard lock(m_mutex);
    m_mirror.reset();
    return attempted("placing probes", [&] {
        std::vector<kernels::GpuPlacement> all;
        all.reserve(placements.size());
        for (const std::uint32_t word : placements) all.push_back({word, 0});
        for (const std::uint32_t slot : renewed) all[slot].renewed = 1;
        m_exchange.begin(all.size() * sizeof(all[0]), 16);
        const VkDeviceAddress address = m_exchange.add(std::span<const kernels::GpuPlacement>(all));
        m_exchange.run([&](const Recorder& recorder) { m_passes.recordPlacements(recorder, settings, address); }, 0);
    });
}

Result<FieldSnapshot> VulkanField::read(SlotRange slots) const {
    const std::lock_guard lock(m_mutex);
    return guarded("reading probes", [&] { return mirror().read(slots); });
}

Result<void> VulkanField::write(const FieldSnapshot& snapshot) {
    const std::lock_guard lock(m_mutex);
    auto written = guarded("writing probes", [&] { mirror().write(snapshot); });
    // It may hold what the GPU does not.
    if (!written) m_mirror.reset();
    return written;
}

std::uint64_t VulkanField::fallbackQueries() const noexcept {
    const std::lock_guard lock(m_mutex);
    // Not from the mirror: that is refreshed by updates only, and queries count without one.
    const auto count = guarded("reading the count of fallbacks", [&] {
        const Buffer word(m_device.impl(), "fallbacks", 4, vk::BufferUsageFlagBits::eTransferDst, MemoryUse::readback);
        submitAndWait(m_device, [&](const Recorder& recorder) {
            recorder.orderAll();
            recorder.copy(m_passes.states(), word, 4);
            recorder.transferToHost();
        });
        return word.mapped<std::uint32_t>()[0];
    });
    return count ? *count : 0;
}

FieldMemory VulkanField::memory() const noexcept {
    const std::lock_guard lock(m_mutex);
    FieldMemory memory = m_passes.memory();
    memory.scratchBytes += m_exchange.bytes();
    return memory;
}

std::vector<PassTime> VulkanField::passTimes() const {
    const std::lock_guard lock(m_mutex);
    std::vector<PassTime> all = m_updatePasses;
    all.insert(all.end(), m_queryPasses.begin(), m_queryPasses.end());
    return all;
}

Result<Field> makeField(const Context& context, const Device& device, const FieldDesc& desc,
                        const FieldSettings& settings) {
    if (auto ok = validateFieldDesc(desc); !ok) return ok.error();
    if (auto ok = validateFieldSettings(settings); !ok) return ok.error();
    if (auto ok = validateGuard(desc, settings); !ok) return ok.error();
    return guarded("making a field", [&] {
        return makeFieldOn(context, desc, settings, std::make_unique<VulkanField>(context, device, desc, settings));
    });
}

std::vector<PassTime> lastPassTimes(const Field& field) {
    const auto* onGpu = dynamic_cast<const VulkanField*>(&backendOf(field));
    return onGpu ? onGpu->passTimes() : std::vector<PassTime>();
}

}  // namespace probegi::vulkan

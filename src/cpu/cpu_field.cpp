#include "cpu/cpu_field.h"

#include <algorithm>
#include <chrono>
#include <new>

#include "core/parallel.h"
#include "cpu/solid_probes.h"
#include "field/probe_emitters.h"
#include "field/snapshot.h"
#include "kernels/probe/irradiance_decoding.h"
#include "kernels/probe/storage.h"
#include "probegi/masks.h"
#include "sdf/sdf_blockers.h"

namespace probegi {

namespace {

using Clock = std::chrono::steady_clock;

// What the query's 32-bit gathers reach (cpu/lane_access-inl.h): 16 GiB of visibility.
constexpr std::size_t kMostVisibilityTexels = std::size_t(1) << 32;

double millisecondsSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

}  // namespace

Result<Field> Field::create(const Context& context, const FieldDesc& desc, const FieldSettings& settings) {
    if (auto ok = validateFieldDesc(desc); !ok) return ok.error();
    if (auto ok = validateFieldSettings(settings); !ok) return ok.error();
    if (auto ok = validateGuard(desc, settings); !ok) return ok.error();
    const FieldLayout layout(desc);
    if (layout.probes * layout.visibilityTexels > kMostVisibilityTexels) return probesDoNotFit(desc);
    try {
        return makeFieldOn(context, desc, settings, std::make_unique<CpuField>(context, desc));
    } catch (const std::bad_alloc&) {
        return probesDoNotFit(desc);
    }
}

CpuField::CpuField(const Context& context, const FieldDesc& desc)
    : m_context(context),
      m_desc(desc),
      m_layout(desc),
      m_volumes(makeVolumes(desc)),
      m_byDensity(volumesByDensity(desc)),
      m_storage(m_layout),
      m_irradianceTaps(makeTapTable(desc.irradianceTexels)),
      m_visibilityTaps(makeTapTable(desc.visibilityTexels)) {}

FieldView CpuField::view(const FieldSettings& settings) const noexcept {
    return {.volumes = m_volumes,
            .order = volumeOrder(m_desc, settings, m_byDensity),
            .slots = int(m_layout.probes),
            .irradianceTexels = m_desc.irradianceTexels,
            .visibilityTexels = m_desc.visibilityTexels,
            .selfShadowBias = settings.selfShadowBias,
            .guard = settings.guard,
            .rules = m_desc.rules,
            .irradiance = m_storage.irradiance.data(),
            .visibility = m_storage.visibility.data(),
            .backfaceShare = m_storage.backfaceShare.data(),
            .placements = m_storage.placements.data(),
            .maskWords = settings.masks ? settings.masks->words().data() : nullptr,
            .maskTexels = settings.masks ? settings.masks->factor() : 2,
            .maskPacked = settings.masks && settings.masks->packed(),
            .blockers = blockersOf(settings.blockers.get()),
            .fallbacks = &m_fallbacks,
            .irradianceTaps = &m_irradianceTaps,
            .visibilityTaps = &m_visibilityTaps};
}

void CpuField::blend(const UpdateFrame& frame, std::span<const RayDatum> rayData,
                     std::span<const FixedRayDatum> fixedRays, std::span<const kernels::EmitterLight> emitters) {
    makeBlendWeights(m_context, m_desc, frame.settings.visibilityExponent, frame.directions, m_weights);
    BlendFrame how{frame.tasks, frame.hysteresis, frame.linear, frame.ditherSeed};
    how.steps = frame.windows ? m_filter.chooseWindows(m_context, frame, m_volumes, rayData, fixedRays, m_storage)
                              : m_filter.keepLessAtEvents(frame, m_storage);
    blendProbes(m_context, m_desc, frame.volumes, frame.settings, m_weights, rayData, how, m_storage, emitters);
    if (frame.windows)
        m_filter.advance(m_context, frame, m_volumes, m_storage);
    else
        forgetFilters(frame.tasks, 1.0f / (1.0f - frame.hysteresis.irradiance), m_storage);
    findSolidProbes(m_context, view(frame.settings), frame.tasks, m_storage.sides);
}

Result<UpdateTimes> CpuField::update(const UpdateFrame& frame, std::span<const RayDatum> rayData,
                                     std::span<const FixedRayDatum> fixedRays) {
    const auto start = Clock::now();
    blend(frame, rayData, fixedRays, {});
    const double elapsed = millisecondsSince(start);
    return UpdateTimes{0, 0, elapsed, elapsed};
}

Result<UpdateTimes> CpuField::update(const UpdateFrame& frame, const Tracer& tracer, const Lighting& lighting) {
    const auto start = Clock::now();
    const std::size_t tasks = frame.tasks.size();
    m_rayData.resize(tasks * m_layout.rays);
    m_fixedRays.resize(tasks * frame.fixedDirections.size());
    TraceTimes sums;
    const FieldView last = view(frame.settings);
    BounceQuery bounces;
    if (frame.bounces)
        bounces = [&](std::span<const FieldQuery> queries, std::span<glm::vec3> out) {
            queryIrradiance(last, queries, out);
            return Result<void>();
        };
    const EmitterSearch emitters = emitterSearch(m_desc, tracer, frame.raySeed);
    m_emitterLights.resize(tasks * std::size_t(emitters.looks));
    auto done = traceProbes(m_context, frame.volumes, frame.tasks, {frame.directions, frame.fixedDirections}, tracer,
                            lighting, bounces, emitters, {m_rayData, m_fixedRays}, sums);
    if (done && emitters)
        done = lookAtEmitters(m_context, frame.volumes, frame.tasks, emitters, tracer, m_emitterLights, sums);
    if (!done) return done.error();
    const double traced = millisecondsSince(start);
    blend(frame, m_rayData, m_fixedRays, m_emitterLights);

    // Stages of different threads overlap: the wall time of tracing and shading is split in their proportion.
    const double sum = std::max(1.0, double(sums.traceNs + sums.shadeNs));
    UpdateTimes times;
    times.trace = traced * double(sums.traceNs) / sum;
    times.shade = traced * double(sums.shadeNs) / sum;
    times.total = millisecondsSince(start);
    times.blend = times.total - traced;
    return times;
}

Result<void> CpuField::irradiance(const FieldSettings& settings, std::span<const FieldQuery> queries,
                                  std::span<glm::vec3> out) const {
    const FieldView all = view(settings);
    parallelFor(m_context, queries.size(), 1024, [&](std::size_t begin, std::size_t end) {
        queryIrradiance(all, queries.subspan(begin, end - begin), out.subspan(begin, end - begin));
    });
    return {};
}

glm::vec3 CpuField::irradiance(const FieldSettings& settings, const FieldQuery& query) const noexcept {
    glm::vec3 result;
    queryIrradiance(view(settings), {&query, 1}, {&result, 1});
    return result;
}

Result<ProbeLight> CpuField::light() const {
    ProbeLight light{std::vector<float>(m_layout.probes), m_storage.backfaceShare};
    const std::size_t values = 3 * m_layout.irradianceTexels;
    parallelFor(m_context, m_layout.probes, 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t probe = begin; probe < end; ++probe) {
            float sum = 0;
            for (std::size_t v = 0; v < values; ++v)
                sum += kernels::decodeIrradiance(kernels::unpackHalf(m_storage.irradiance[probe * values + v]));
            light.brightness[probe] = sum / float(values);
        }
    });
    return light;
}

void CpuField::place(std::span<const kernels::Volume> volumes) noexcept {
    std::copy(volumes.begin(), volumes.end(), m_volumes.begin());
}

Result<void> CpuField::enter(const FieldSettings&, int volume, glm::ivec3 cells) {
    const kernels::Volume& v = m_volumes[std::size_t(volume)];
    parallelFor(m_context, std::size_t(kernels::volumeProbes(v)), 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t slot = std::size_t(v.firstSlot) + begin; slot < std::size_t(v.firstSlot) + end; ++slot)
            if (kernels::hasEntered(v, kernels::probeCell(v, int(slot)), cells)) renew(slot);
    });
    return {};
}

Result<void> CpuField::setPlacements(const FieldSettings&, std::span<const std::uint32_t> placements,
                                     std::span<const std::uint32_t> renewed) {
    std::copy(placements.begin(), placements.end(), m_storage.placements.begin());
    for (const std::uint32_t slot : renewed) renew(slot);
    return {};
}

void CpuField::renew(std::size_t slot) noexcept {
    const auto clear = [slot](auto& values, std::size_t each) {
        std::fill_n(values.begin() + std::ptrdiff_t(slot * each), each, 0);
    };
    clear(m_storage.irradiance, 3 * m_layout.irradianceTexels);
    clear(m_storage.visibility, m_layout.visibilityTexels);
    m_storage.filters[slot] = kernels::newFilter();
    m_storage.sides[slot] = kernels::noSides();
    m_storage.backfaceShare[slot] = kernels::kNeverUpdated;
}

Result<FieldSnapshot> CpuField::read(SlotRange slots) const {
    FieldSnapshot snapshot = emptySnapshot(m_desc, slots);
    const std::size_t first = std::size_t(slots.first);
    std::copy_n(m_storage.irradiance.begin() + std::ptrdiff_t(first * 3 * m_layout.irradianceTexels),
                snapshot.irradiance.size(), snapshot.irradiance.begin());
    std::copy_n(m_storage.visibility.begin() + std::ptrdiff_t(first * m_layout.visibilityTexels),
                snapshot.visibility.size(), snapshot.visibility.begin());
    for (std::size_t i = 0; i < snapshot.states.size(); ++i)
        snapshot.states[i] =
            probeState(m_storage.backfaceShare[first + i], m_storage.sides[first + i], m_storage.filters[first + i]);
    return snapshot;
}

Result<void> CpuField::write(const FieldSnapshot& snapshot) {
    const std::size_t first = std::size_t(snapshot.slots.first);
    std::copy(snapshot.irradiance.begin(), snapshot.irradiance.end(),
              m_storage.irradiance.begin() + std::ptrdiff_t(first * 3 * m_layout.irradianceTexels));
    std::copy(snapshot.visibility.begin(), snapshot.visibility.end(),
              m_storage.visibility.begin() + std::ptrdiff_t(first * m_layout.visibilityTexels));
    for (std::size_t i = 0; i < snapshot.states.size(); ++i) {
        m_storage.backfaceShare[first + i] = snapshot.states[i].backfaceShare;
        m_storage.sides[first + i] = sidesOf(snapshot.states[i]);
        m_storage.filters[first + i] = filterOf(snapshot.states[i]);
        m_storage.placements[first + i] = snapshot.states[i].placement;
    }
    return {};
}

FieldMemory CpuField::memory() const noexcept {
    const auto bytes = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
    return {bytes(m_storage.irradiance), bytes(m_storage.visibility),
            bytes(m_storage.filters) + bytes(m_storage.backfaceShare) + bytes(m_storage.sides) +
                bytes(m_storage.placements) + bytes(m_irradianceTaps) + bytes(m_visibilityTaps) + sizeof(*this),
            bytes(m_rayData) + bytes(m_fixedRays) + bytes(m_emitterLights) + bytes(m_weights.irradiance) +
                bytes(m_weights.visibility) + bytes(m_weights.evidence) + m_filter.bytes()};
}

}  // namespace probegi

#include "probegi/field.h"

#include <fmt/format.h>

#include <cassert>
#include <chrono>
#include <cmath>
#include <new>

#include "core/parallel.h"
#include "core/progress.h"
#include "cpu/probe_blend.h"
#include "cpu/probe_query.h"
#include "cpu/probe_trace.h"
#include "field/hysteresis.h"
#include "kernels/irradiance_decoding.h"
#include "kernels/ray_set.h"
#include "kernels/storage.h"

namespace probegi {

namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* kNoRayDataMemory = "no memory for the update's ray data; use fewer probes or rays";
// Converging compares the field after this many updates, twice as many, and so on.
constexpr int kFirstConvergenceCheck = 8;

// Mean absolute difference over mean.
float relativeChange(std::span<const float> before, std::span<const float> after) {
    double difference = 0, sum = 0;
    for (std::size_t i = 0; i < after.size(); ++i) {
        difference += std::abs(double(after[i]) - before[i]);
        sum += after[i];
    }
    return sum > 0 ? float(difference / sum) : 0.0f;
}

double millisecondsSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

}  // namespace

struct Field::Impl {
    Impl(const Context& c, const FieldDesc& d)
        : context(c),
          desc(d),
          layout(d),
          storage(layout),
          irradianceTaps(makeTapTable(d.irradianceTexels)),
          visibilityTaps(makeTapTable(d.visibilityTexels)),
          directions(layout.rays) {
        prepareRays();
    }

    FieldView view() const {
        const glm::vec3& s = desc.grid.spacing;
        return {.desc = &desc,
                .irradiance = storage.irradiance.data(),
                .visibility = storage.visibility.data(),
                .backfaceShare = storage.backfaceShare.data(),
                .fallbacks = &fallbacks,
                .irradianceTaps = &irradianceTaps,
                .visibilityTaps = &visibilityTaps,
                .inverseSpacing = 1.0f / s,
                .minSpacing = std::min({s.x, s.y, s.z}),
                .inverseMaxDistance = 1.0f / layout.maxDistance};
    }

    std::uint32_t seed() const {
        return kernels::hashCombine(std::uint32_t(desc.seed), std::uint32_t(desc.seed >> 32));
    }

    // Directions of the coming frame.
    void prepareRays() {
        const glm::mat3 rotation = kernels::frameRotation(seed(), std::uint32_t(frame));
        for (std::size_t i = 0; i < directions.size(); ++i)
            directions[i] = rotation * kernels::sphericalFibonacci(std::uint32_t(i), std::uint32_t(layout.rays));
    }

    void blend(std::span<const RayDatum> data, BlendFrame how) {
        how.ditherSeed = kernels::hashCombine(seed() ^ 0x6a09e667u, std::uint32_t(frame));
        makeBlendWeights(context, desc, directions, weights);
        blendProbes(context, desc, layout, weights, data, how, storage);
        events.advance();
        ++frame;
        prepareRays();
    }

    UpdateTimes traceAndBlend(const Tracer& tracer, const Lighting& lighting, const BlendFrame& how) {
        const auto start = Clock::now();
        rayData.resize(layout.probes * layout.rays);
        TraceTimes sums;
        const FieldView last = view();
        traceProbes(context, desc.grid, directions, tracer, lighting, frame > 0 ? &last : nullptr, rayData, sums);
        const double traced = millisecondsSince(start);
        blend(rayData, how);

        // Stages of different threads overlap: the wall time of tracing and shading is split in their proportion.
        const double sum = std::max(1.0, double(sums.traceNs + sums.shadeNs));
        UpdateTimes times;
        times.trace = traced * double(sums.traceNs) / sum;
        times.shade = traced * double(sums.shadeNs) / sum;
        times.total = millisecondsSince(start);
        times.blend = times.total - traced;
        return times;
    }

    // Mean stored radiance of every probe over directions and channels.
    std::vector<float> probeBrightness() const {
        std::vector<float> result(layout.probes);
        const std::size_t values = 3 * layout.irradianceTexels;
        parallelFor(context, layout.probes, 256, [&](std::size_t begin, std::size_t end) {
            for (std::size_t probe = begin; probe < end; ++probe) {
                float sum = 0;
                for (std::size_t v = 0; v < values; ++v)
                    sum += kernels::decodeIrradiance(kernels::unpackHalf(storage.irradiance[probe * values + v]));
                result[probe] = sum / float(values);
            }
        });
        return result;
    }

    BlendFrame paperBlend() const { return {events.current(desc, frame == 0), false, 0}; }

    Context context;
    FieldDesc desc;
    FieldLayout layout;
    FieldStorage storage;
    TapTable irradianceTaps, visibilityTaps;
    std::vector<glm::vec3> directions;
    std::vector<RayDatum> rayData;
    BlendWeights weights;
    HysteresisSchedule events;
    mutable std::atomic<std::uint64_t> fallbacks{0};
    int frame = 0;
};

Field::Field(std::unique_ptr<Impl> impl) : m_impl(std::move(impl)) {}
Field::Field(Field&&) noexcept = default;
Field& Field::operator=(Field&&) noexcept = default;
Field::~Field() = default;

Result<Field> Field::create(const Context& context, const FieldDesc& desc) {
    if (auto ok = validateFieldDesc(desc); !ok) return tl::unexpected(ok.error());
    try {
        return Field(std::make_unique<Impl>(context, desc));
    } catch (const std::bad_alloc&) {
        return fail(ErrorCode::outOfMemory,
                    fmt::format("no memory for {} probes; use fewer or smaller ones", probeCount(desc.grid)));
    }
}

const FieldDesc& Field::desc() const noexcept {
    return m_impl->desc;
}
int Field::frame() const noexcept {
    return m_impl->frame;
}
std::span<const glm::vec3> Field::rayDirections() const noexcept {
    return m_impl->directions;
}
std::uint64_t Field::fallbackQueries() const noexcept {
    return m_impl->fallbacks.load();
}
void Field::notify(FieldEvent event) noexcept {
    m_impl->events.notify(event);
}
void Field::setGuard(LeakGuard guard) noexcept {
    m_impl->desc.guard = guard;
}

FieldMemory Field::memory() const noexcept {
    const Impl& m = *m_impl;
    const auto bytes = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
    return {bytes(m.storage.irradiance), bytes(m.storage.visibility),
            bytes(m.storage.backfaceShare) + bytes(m.irradianceTaps) + bytes(m.visibilityTaps) + bytes(m.directions) +
                sizeof(Impl),
            bytes(m.rayData) + bytes(m.weights.irradiance) + bytes(m.weights.visibility)};
}

Result<UpdateTimes> Field::update(std::span<const RayDatum> rayData) try {
    const std::size_t expected = m_impl->layout.probes * m_impl->layout.rays;
    if (rayData.size() != expected)
        return fail(
            ErrorCode::invalidArgument,
            fmt::format("rayData has {} entries; it must have probes x raysPerProbe = {}", rayData.size(), expected));
    const auto start = Clock::now();
    m_impl->blend(rayData, m_impl->paperBlend());
    const double elapsed = millisecondsSince(start);
    return UpdateTimes{0, 0, elapsed, elapsed};
} catch (const std::bad_alloc&) {
    return fail(ErrorCode::outOfMemory, kNoRayDataMemory);
}

Result<UpdateTimes> Field::update(const Tracer& tracer, const Lighting& lighting) try {
    return m_impl->traceAndBlend(tracer, lighting, m_impl->paperBlend());
} catch (const std::bad_alloc&) {
    return fail(ErrorCode::outOfMemory, kNoRayDataMemory);
}

Result<int> Field::converge(const Tracer& tracer, const Lighting& lighting, float tolerance, int maxFrames,
                            const std::function<void(const UpdateTimes&)>& onUpdate) try {
    if (!(tolerance > 0)) return fail(ErrorCode::invalidArgument, "tolerance must be greater than 0");
    if (maxFrames < 1) return fail(ErrorCode::invalidArgument, "maxFrames must be at least 1");
    Impl& m = *m_impl;
    Progress progress(m.context, "converging probes", maxFrames);
    std::vector<float> earlier;
    int nextCheck = kFirstConvergenceCheck;
    for (int k = 1; k <= maxFrames; ++k) {
        const float kept = k == 1 ? 0.0f : 1.0f - 3.0f / float(k + 2);
        const UpdateTimes times = m.traceAndBlend(tracer, lighting, {{kept, kept}, true, 0});
        if (onUpdate) onUpdate(times);
        if (!progress.advance()) return fail(ErrorCode::cancelled, "cancelled while converging probes");
        if (k < nextCheck) continue;
        nextCheck *= 2;
        std::vector<float> now = m.probeBrightness();
        if (!earlier.empty() && relativeChange(earlier, now) < tolerance) return k;
        earlier = std::move(now);
    }
    return maxFrames;
} catch (const std::bad_alloc&) {
    return fail(ErrorCode::outOfMemory, kNoRayDataMemory);
}

glm::vec3 Field::irradiance(const FieldQuery& query) const noexcept {
    glm::vec3 result;
    queryIrradiance(m_impl->view(), {&query, 1}, {&result, 1});
    return result;
}

void Field::irradiance(std::span<const FieldQuery> queries, std::span<glm::vec3> out) const {
    assert(queries.size() == out.size());
    const FieldView view = m_impl->view();
    parallelFor(m_impl->context, queries.size(), 1024, [&](std::size_t begin, std::size_t end) {
        queryIrradiance(view, queries.subspan(begin, end - begin), out.subspan(begin, end - begin));
    });
}

glm::vec3 Field::probeIrradiance(int probe, glm::vec3 normal) const noexcept {
    return probegi::probeIrradiance(m_impl->view(), probe, normal);
}

float Field::probeBackfaceShare(int probe) const noexcept {
    return m_impl->storage.backfaceShare[std::size_t(probe)];
}

glm::vec2 Field::probeDistanceMoments(int probe, glm::vec3 direction) const noexcept {
    const float d = m_impl->layout.maxDistance;
    return probeMoments(m_impl->view(), probe, direction) * glm::vec2(d, d * d);
}

}  // namespace probegi

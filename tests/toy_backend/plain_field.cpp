#include "toy_backend/plain_field.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "field/guard_number.h"
#include "field/probe_emitters.h"
#include "field/snapshot.h"
#include "field/volume_access.h"
#include "kernels/lookup/access.h"
#include "kernels/lookup/volume_blend.h"
#include "kernels/probe/octahedral_texel.h"
#include "kernels/probe/probe_texel.h"
#include "probegi/masks.h"
#include "sdf/sdf_blockers.h"

namespace probegi::test {

namespace {

/// How the look-up's kernels read a snapshot.
struct SnapshotAccess : VolumeAccess {
    using MapPoint = glm::vec3;
    int rules;
    int guard;
    float selfShadowBias;
    int maskTexels, maskPacked;
    std::span<const std::uint32_t> masks;
    int blockers;
    std::span<const kernels::SdfBlocker> solids;
    const FieldSnapshot& probes;
    std::span<const kernels::Volume> volumes;
    std::atomic<std::uint64_t>& fallbacks;

    friend glm::vec3 visibilityPoint(const SnapshotAccess&, glm::vec3 direction) { return glm::normalize(direction); }
    friend glm::vec3 irradiancePoint(const SnapshotAccess&, glm::vec3 normal) { return normal; }
    friend glm::vec3 axisPoint(const SnapshotAccess&, const kernels::Volume& v, int axis, bool up) {
        return kernels::axisDirection(v, axis, up);
    }
    friend void storedMoments(const SnapshotAccess& a, int slot, glm::vec3 at, float& mean, float& meanSquare) {
        const float range = a.volumes[volumeOf(a.volumes, slot)].maxDistance;
        const glm::vec2 moments = a.probes.probeDistanceMoments(slot, at);
        mean = moments.x / range;
        meanSquare = moments.y / (range * range);
    }
    friend void momentsOnAxis(const SnapshotAccess& a, const kernels::Volume&, int slot, glm::vec3 at, float& mean,
                              float& meanSquare) {
        storedMoments(a, slot, at, mean, meanSquare);
    }
    friend float storedBackfaceShare(const SnapshotAccess& a, int slot) { return a.probes.state(slot).backfaceShare; }
    friend int storedPlacement(const SnapshotAccess& a, int slot) { return int(a.probes.state(slot).placement); }
    friend glm::vec3 storedIrradiance(const SnapshotAccess& a, int slot, glm::vec3 at) {
        const glm::vec3 e = a.probes.probeIrradiance(slot, at) / kernels::kPi;
        return {kernels::encodeIrradiance(e.x), kernels::encodeIrradiance(e.y), kernels::encodeIrradiance(e.z)};
    }
    friend int maskWord(const SnapshotAccess& a, int number) { return int(a.masks[std::size_t(number)]); }
    friend kernels::SdfBlocker blockerAt(const SnapshotAccess& a, int number) { return a.solids[std::size_t(number)]; }
    friend float givenVisibility(const SnapshotAccess&, int) { return 1.0f; }
    friend void countFallback(const SnapshotAccess& a) { ++a.fallbacks; }
};

}  // namespace

PlainField::PlainField(const Context& context, const FieldDesc& desc)
    : m_context(context),
      m_volumes(makeVolumes(desc)),
      m_byDensity(volumesByDensity(desc)),
      m_probes(emptySnapshot(desc, {0, probeCount(desc)})) {}

// A probe that has had no update keeps nothing of what it holds.
FrameHysteresis PlainField::keptBy(const UpdateFrame& frame, const ProbeTask& task) const {
    return kernels::isNew(filterOf(m_probes.states[task.slot])) ? FrameHysteresis{0.0f, 0.0f} : frame.hysteresis;
}

std::uint32_t PlainField::numberOf(const ProbeTask& task) const {
    return std::uint32_t(kernels::probeNumber(m_volumes[task.volume], int(task.slot)));
}

void PlainField::blendIrradiance(const UpdateFrame& frame, const ProbeTask& task, std::span<const RayDatum> rays) {
    const int size = m_probes.desc.irradianceTexels, texels = size * size;
    const kernels::BlendRule rule{keptBy(frame, task).irradiance, frame.settings.significantChange,
                                  frame.settings.newDistribution};
    for (int t = 0; t < texels; ++t) {
        const glm::vec3 n = kernels::octTexelDirection(t % size, t / size, size);
        glm::dvec3 sum(0);
        double weights = 0;
        for (std::size_t r = 0; r < rays.size(); ++r) {
            const double weight = kernels::irradianceWeight(n, frame.directions[r]);
            sum += weight *
                   glm::dvec3(kernels::arrivingRadiance(kernels::safeDistance(rays[r].distance), rays[r].radiance));
            weights += weight;
        }
        std::uint16_t* stored =
            m_probes.irradiance.data() + 3 * (std::size_t(task.slot) * std::size_t(texels) + std::size_t(t));
        const glm::vec3 old(kernels::unpackHalf(stored[0]), kernels::unpackHalf(stored[1]),
                            kernels::unpackHalf(stored[2]));
        const glm::uvec3 bits =
            kernels::blendIrradianceTexel(old, glm::vec3(sum / weights), rule, frame.linear, frame.ditherSeed,
                                          numberOf(task) * std::uint32_t(texels) + std::uint32_t(t));
        for (int c = 0; c < 3; ++c) stored[c] = std::uint16_t(bits[c]);
    }
}

void PlainField::blendVisibility(const UpdateFrame& frame, const ProbeTask& task, std::span<const RayDatum> rays) {
    const int size = m_probes.desc.visibilityTexels, texels = size * size;
    const float farthest = m_volumes[task.volume].maxDistance;
    for (int t = 0; t < texels; ++t) {
        const glm::vec3 n = kernels::octTexelDirection(t % size, t / size, size);
        glm::dvec2 sum(0);
        double weights = 0;
        for (std::size_t r = 0; r < rays.size(); ++r) {
            const double weight =
                std::pow(std::max(0.0, double(glm::dot(n, frame.directions[r]))), frame.settings.visibilityExponent);
            const double d = kernels::visibilityDistance(kernels::safeDistance(rays[r].distance), farthest);
            sum += weight * glm::dvec2(d, d * d);
            weights += weight;
        }
        std::uint32_t& stored = m_probes.visibility[std::size_t(task.slot) * std::size_t(texels) + std::size_t(t)];
        stored = kernels::blendVisibilityTexel(stored, glm::vec2(sum / std::max(weights, 1e-300)),
                                               keptBy(frame, task).visibility, frame.ditherSeed,
                                               numberOf(task) * std::uint32_t(texels) + std::uint32_t(t));
    }
}

void PlainField::blendSides(const UpdateFrame& frame, const ProbeTask& task, std::span<const RayDatum> rays) {
    const auto hits =
        std::ranges::count_if(rays, [](const RayDatum& d) { return d.distance < kernels::kMissDistance; });
    const auto backs = std::ranges::count_if(rays, [](const RayDatum& d) { return kernels::hitBack(d.distance); });
    float& share = m_probes.states[task.slot].backfaceShare;
    share = glm::mix(kernels::backfaceShareOf(int(backs), int(hits)), share, keptBy(frame, task).visibility);
}

void PlainField::blend(const UpdateFrame& frame, const ProbeTask& task, std::span<const RayDatum> rays) {
    blendIrradiance(frame, task, rays);
    blendVisibility(frame, task, rays);
    blendSides(frame, task, rays);
    m_probes.states[task.slot].filter = std::to_array(kernels::forgottenFilter(1.0f).words);  // no longer new
}

Result<UpdateTimes> PlainField::update(const UpdateFrame& frame, std::span<const RayDatum> rayData,
                                       std::span<const FixedRayDatum>) {
    const std::size_t rays = frame.directions.size();
    for (std::size_t i = 0; i < frame.tasks.size(); ++i) blend(frame, frame.tasks[i], rayData.subspan(i * rays, rays));
    return UpdateTimes{};
}

Result<UpdateTimes> PlainField::update(const UpdateFrame& frame, const Tracer& tracer, const Lighting& lighting) {
    std::vector<RayDatum> rayData(frame.tasks.size() * frame.directions.size());
    BounceQuery bounces;
    if (frame.bounces)
        bounces = [&](std::span<const FieldQuery> queries, std::span<glm::vec3> out) {
            return irradiance(frame.settings, queries, out);
        };
    TraceTimes times;
    const auto traced = traceProbes(m_context, frame.volumes, frame.tasks, {frame.directions, {}}, tracer, lighting,
                                    bounces, {}, {rayData, {}}, times);
    if (!traced) return traced.error();
    return update(frame, rayData, {});
}

glm::vec3 PlainField::irradiance(const FieldSettings& settings, const FieldQuery& query) const noexcept {
    const SnapshotAccess access{{m_volumes, volumeOrder(m_probes.desc, settings, m_byDensity)},
                                kernels::kRulesPaper,
                                guardNumber(settings.guard),
                                settings.selfShadowBias,
                                settings.masks ? settings.masks->factor() : 2,
                                settings.masks && settings.masks->packed() ? 1 : 0,
                                settings.masks ? settings.masks->words() : std::span<const std::uint32_t>(),
                                int(blockersOf(settings.blockers.get()).size()),
                                blockersOf(settings.blockers.get()),
                                m_probes,
                                m_volumes,
                                m_fallbacks};
    return kernels::blendedIrradiance(access, query.position, query.normal, query.toViewer);
}

Result<void> PlainField::irradiance(const FieldSettings& settings, std::span<const FieldQuery> queries,
                                    std::span<glm::vec3> out) const {
    for (std::size_t i = 0; i < queries.size(); ++i) out[i] = irradiance(settings, queries[i]);
    return {};
}

Result<ProbeLight> PlainField::light() const {
    ProbeLight light;
    const std::size_t values = m_probes.irradiance.size() / m_probes.states.size();
    for (std::size_t probe = 0; probe < m_probes.states.size(); ++probe) {
        float sum = 0;
        for (std::size_t v = 0; v < values; ++v)
            sum += kernels::decodeIrradiance(kernels::unpackHalf(m_probes.irradiance[probe * values + v]));
        light.brightness.push_back(sum / float(values));
        light.backfaceShares.push_back(m_probes.states[probe].backfaceShare);
    }
    return light;
}

void PlainField::place(std::span<const kernels::Volume> volumes) noexcept {
    std::copy(volumes.begin(), volumes.end(), m_volumes.begin());
}

Result<void> PlainField::enter(const FieldSettings&, int volume, glm::ivec3 cells) {
    const kernels::Volume& v = m_volumes[std::size_t(volume)];
    for (int slot = v.firstSlot; slot < v.firstSlot + kernels::volumeProbes(v); ++slot)
        if (kernels::hasEntered(v, kernels::probeCell(v, slot), cells)) renew(slot);
    return {};
}

void PlainField::renew(int slot) {
    FieldSnapshot fresh = emptySnapshot(m_probes.desc, {slot, 1});
    fresh.states[0].backfaceShare = kernels::kNeverUpdated;
    fresh.states[0].placement = m_probes.state(slot).placement;
    write(fresh).value();
}

Result<void> PlainField::setPlacements(const FieldSettings&, std::span<const std::uint32_t> placements,
                                       std::span<const std::uint32_t> renewed) {
    for (std::size_t slot = 0; slot < placements.size(); ++slot) m_probes.states[slot].placement = placements[slot];
    for (const std::uint32_t slot : renewed) renew(int(slot));
    return {};
}

Result<FieldSnapshot> PlainField::read(SlotRange slots) const {
    FieldSnapshot some = emptySnapshot(m_probes.desc, slots);
    const auto copy = [&](const auto& from, auto& to) {
        const std::size_t each = from.size() / m_probes.states.size();
        std::copy_n(from.begin() + std::ptrdiff_t(std::size_t(slots.first) * each), to.size(), to.begin());
    };
    copy(m_probes.irradiance, some.irradiance);
    copy(m_probes.visibility, some.visibility);
    copy(m_probes.states, some.states);
    return some;
}

Result<void> PlainField::write(const FieldSnapshot& snapshot) {
    const auto copy = [&](const auto& from, auto& to) {
        const std::size_t each = to.size() / m_probes.states.size();
        std::copy(from.begin(), from.end(), to.begin() + std::ptrdiff_t(std::size_t(snapshot.slots.first) * each));
    };
    copy(snapshot.irradiance, m_probes.irradiance);
    copy(snapshot.visibility, m_probes.visibility);
    copy(snapshot.states, m_probes.states);
    return {};
}

FieldMemory PlainField::memory() const noexcept {
    return {m_probes.irradiance.size() * sizeof(std::uint16_t), m_probes.visibility.size() * sizeof(std::uint32_t),
            m_probes.states.size() * sizeof(ProbeState), 0};
}

}  // namespace probegi::test

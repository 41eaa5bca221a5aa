#include "field/update_schedule.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include "core/sentence.h"
#include "field/layout.h"
#include "field/probe_emitters.h"
#include "field/probe_importance.h"
#include "kernels/probe/probe_state.h"
#include "kernels/random.h"
#include "kernels/volume/placed_probe.h"

namespace probegi {

namespace {

// One probe in so many that the budget pays for is the one that waited longest.
constexpr std::size_t kReserve = 4;
// Updates after which a probe's noise is known well enough, and bounces have arrived (kernels::kYoungGrowth).
constexpr std::uint8_t kYoungUpdates = 8;
// How far the light of a young probe may be off, over the root of its updates, whatever it says itself.
constexpr float kYoungError = 0.5f;
// Floor of a probe's brightness relative to the mean of all: in the dark a large share is little light, but not
// nothing.
constexpr float kDarkest = 0.05f;
// Noise left in a converged average.
constexpr float kConvergedNoise = 0.01f;
// Lag below it may be the storage's rounding.
constexpr float kLeastLag = 0.005f;
// A window that is as good as the longest: storage rounds.
constexpr float kConvergedConfidence = 0.98f;
// Priorities: paused probes have none, and announced changes and new probes come before all that is measured.
constexpr float kPaused = -1.0f, kAnnounced = 1e10f, kNew = 1e20f;
constexpr float kMostSquare = 1e4f;

// Its next update keeps nothing. (A GpuField's books have all probes as not placed yet, always.)
bool isFresh(std::uint32_t placement) {
    const std::uint32_t state = kernels::stateOf(placement);
    return state == kernels::kNewlyAwake || state == kernels::kNewlyVigilant;
}

bool isIn(const Bounds& box, glm::vec3 p) {
    return glm::all(glm::greaterThanEqual(p, box.lower)) && glm::all(glm::lessThanEqual(p, box.upper));
}

bool isFinite(glm::vec3 v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool isUnit(glm::vec3 v) {
    return std::abs(glm::dot(v, v) - 1.0f) <= 1e-3f;
}

std::size_t raysOfProbe(const FieldDesc& desc) {
    const int fixed = desc.rules == FieldRules::paper ? 0 : desc.fixedRays;
    return std::size_t(desc.raysPerProbe + fixed + emitterLooks(desc));
}

}  // namespace

// A candidate's claims.
struct UpdateSchedule::Rank {
    std::uint32_t index;
    std::uint32_t age;
    std::uint32_t shuffled;  // decides between equals: else rows of neighbours would be chosen
    float priority;

    bool isOlder(const Rank& than) const noexcept {
        return age != than.age ? age > than.age : shuffled < than.shuffled;
    }
};

UpdateSchedule::UpdateSchedule(const FieldDesc& desc)
    : m_raysPerProbe(raysOfProbe(desc)), m_probes(std::size_t(probeCount(desc))) {}

void UpdateSchedule::setBudget(const UpdateBudget& budget) {
    if (!budget.limits()) m_cost = {};
    if (budget.limits()) m_limits.resize(m_probes.size());
    m_budget = budget;
}

std::size_t UpdateSchedule::affordable() const noexcept {
    std::size_t most = m_probes.size();
    if (m_budget.rays > 0) most = std::min(most, std::size_t(m_budget.rays) / m_raysPerProbe);
    if (m_budget.milliseconds > 0) most = std::min(most, m_cost.affordable(m_budget.milliseconds));
    return std::max(most, std::size_t(1));
}

bool UpdateSchedule::seesChange(const Probe& probe) noexcept {
    return probe.noise >= 0 && probe.lag > std::max(probe.noise, kLeastLag);
}

// By slot: the largest lag that a neighbour has seen since the probe's own last update.
std::vector<float> UpdateSchedule::heardLags(std::span<const ProbeTask> candidates,
                                             std::span<const kernels::Volume> volumes) const {
    std::vector<float> heard(m_probes.size(), 0.0f);
    for (const ProbeTask& task : candidates) {
        const Probe& probe = m_probes[task.slot];
        if (!seesChange(probe)) continue;
        const kernels::Volume& volume = volumes[task.volume];
        const glm::ivec3 cell = kernels::probeCell(volume, int(task.slot));
        const glm::ivec3 lowest = glm::max(cell - 1, glm::ivec3(0)), highest = glm::min(cell + 1, volume.counts - 1);
        for (int z = lowest.z; z <= highest.z; ++z)
            for (int y = lowest.y; y <= highest.y; ++y)
                for (int x = lowest.x; x <= highest.x; ++x) {
                    const auto slot = std::size_t(kernels::probeSlot(volume, {x, y, z}));
                    // Who was updated since, or with it, has looked for itself: else news would pass through walls.
                    if (m_clock - m_probes[slot].since > m_clock - probe.since)
                        heard[slot] = std::max(heard[slot], kernels::kSpreadLag * probe.lag);
                }
    }
    return heard;
}

float UpdateSchedule::meanLevel(std::span<const ProbeTask> candidates) const noexcept {
    double sum = 0;
    int count = 0;
    for (const ProbeTask& task : candidates)
        if (const Probe& probe = m_probes[task.slot]; probe.noise >= 0 && probe.level > 0) {
            sum += double(probe.level);
            ++count;
        }
    return count > 0 ? float(sum / count) : 0.0f;
}

// Grows with the expected square of the error of the probe's light, beside the light of all, and with the time that it
// has waited.
float UpdateSchedule::priority(const Probe& probe, bool isNew, float heardLag, float meanLevel) const noexcept {
    if (isNew) return kNew;
    if (!probe.events.over()) return kAnnounced;
    const float waited = float(1 + (m_clock - probe.since));
    if (probe.noise < 0) return waited;
    const float lag = std::max(probe.lag, heardLag);
    const bool young = probe.updates < kYoungUpdates;
    const bool still = lag <= std::max(probe.noise, kLeastLag);
    const float brightness = meanLevel > 0 ? std::max(probe.level / meanLevel, kDarkest) : 1.0f;
    if (!young && still && (brightness * probe.noise <= kConvergedNoise || probe.confidence >= kConvergedConfidence))
        return kPaused;
    float square = lag * lag + probe.noise * probe.noise;
    if (young) square = std::max(square, kYoungError * kYoungError / float(probe.updates));
    square *= brightness * brightness;
    return waited * (square <= kMostSquare ? square : kMostSquare);  // and of what is not a number
}

std::vector<ProbeTask> UpdateSchedule::choose(std::vector<ProbeTask> candidates,
                                              std::span<const kernels::Volume> volumes, const ProbeStates& states,
                                              const FieldSettings& settings) const {
    const std::size_t most = affordable(), reserve = (most + kReserve - 1) / kReserve;
    if (candidates.size() <= reserve) return candidates;
    const ProbeImportance importance(m_budget.view, settings);
    const std::vector<float> heard = heardLags(candidates, volumes);
    const float level = meanLevel(candidates);
    std::vector<Rank> ranks(candidates.size());
    for (std::size_t i = 0; i < ranks.size(); ++i) {
        const ProbeTask& task = candidates[i];
        const Probe& probe = m_probes[task.slot];
        const bool isNew = probe.updates == 0 || isFresh(states.placements()[task.slot]);
        const float first = priority(probe, isNew, heard[task.slot], level);
        ranks[i] = {std::uint32_t(i), m_clock - probe.since, kernels::hashUint(task.slot),
                    first > 0 ? first * importance.at(volumes[task.volume], task.origin) : first};
    }
    const auto older = [](const Rank& a, const Rank& b) { return a.isOlder(b); };
    const auto wanted = [](const Rank& a, const Rank& b) {
        return a.priority != b.priority ? a.priority > b.priority : a.isOlder(b);
    };
    const auto others = ranks.begin() + std::ptrdiff_t(reserve);
    std::nth_element(ranks.begin(), others, ranks.end(), older);
    const auto end = std::partition(others, ranks.end(), [](const Rank& r) { return r.priority >= 0; });
    auto chosen = end;
    if (end - ranks.begin() > std::ptrdiff_t(most)) {
        chosen = ranks.begin() + std::ptrdiff_t(most);
        std::nth_element(others, chosen, end, wanted);
    }
    std::vector<std::uint32_t> indices;
    for (auto rank = ranks.begin(); rank != chosen; ++rank) indices.push_back(rank->index);
    std::sort(indices.begin(), indices.end());
    for (std::size_t i = 0; i < indices.size(); ++i) candidates[i] = candidates[indices[i]];
    candidates.resize(indices.size());
    return candidates;
}

void UpdateSchedule::tell(Probe& probe, const kernels::ProbeProgress& told) noexcept {
    probe.lag = told.lag, probe.noise = told.noise, probe.confidence = told.confidence, probe.level = told.level;
}

void UpdateSchedule::updated(std::span<const ProbeTask> tasks,
                             std::span<const kernels::ProbeProgress> progress) noexcept {
    ++m_clock;
    for (const ProbeTask& task : tasks) {
        Probe& probe = m_probes[task.slot];
        probe.since = m_clock;
        if (probe.updates < kYoungUpdates) ++probe.updates;
        probe.events.advance();
        probe.noise = -1;
        if (progress.empty()) continue;
        tell(probe, progress[task.slot]);
    }
}

void UpdateSchedule::hear(std::span<const kernels::ProbeProgress> progress) noexcept {
    for (std::size_t slot = 0; slot < progress.size(); ++slot)
        if (m_probes[slot].updates > 0) tell(m_probes[slot], progress[slot]);
}

void UpdateSchedule::enter(const kernels::Volume& volume, glm::ivec3 cells) noexcept {
    for (int slot = volume.firstSlot; slot < volume.firstSlot + kernels::volumeProbes(volume); ++slot)
        if (kernels::hasEntered(volume, kernels::probeCell(volume, slot), cells))
            m_probes[std::size_t(slot)] = {.since = m_clock};
}

void UpdateSchedule::replace(SlotRange slots) noexcept {
    for (int slot = slots.first; slot < slots.first + slots.count; ++slot)
        m_probes[std::size_t(slot)] = {.since = m_clock, .updates = 1};
}

void UpdateSchedule::restart() noexcept {
    std::fill(m_probes.begin(), m_probes.end(), Probe{});
    m_clock = 0;
}

void UpdateSchedule::notify(FieldEvent event, const Bounds& box, std::span<const kernels::Volume> volumes,
                            const ProbeStates& states) noexcept {
    for (const kernels::Volume& volume : volumes)
        for (int slot = volume.firstSlot; slot < volume.firstSlot + kernels::volumeProbes(volume); ++slot) {
            const std::uint32_t placement = states.placements()[std::size_t(slot)];
            if (isIn(box, kernels::placedPosition(volume, kernels::probeCell(volume, slot), placement)))
                m_probes[std::size_t(slot)].events.add(event);
        }
}

std::span<const kernels::EventLimit> UpdateSchedule::limits(std::span<const ProbeTask> tasks,
                                                            const FieldSettings& settings) const noexcept {
    if (m_limits.empty() ||
        std::all_of(tasks.begin(), tasks.end(), [&](const ProbeTask& t) { return m_probes[t.slot].events.over(); }))
        return {};
    for (const ProbeTask& task : tasks) m_limits[task.slot] = m_probes[task.slot].events.limit(settings);
    return m_limits;
}

Result<void> validateBudget(const FieldDesc& desc, const UpdateBudget& budget) {
    const auto wrong = [](auto&&... words) { return fail(ErrorCode::invalidArgument, sentence(words...)); };
    const std::int64_t each = std::int64_t(raysOfProbe(desc));
    if (budget.rays < 0 || (budget.rays > 0 && budget.rays < each))
        return wrong("the budget of ", budget.rays, " rays does not pay for one probe; it must be 0 (no limit) or at ",
                     "least ", each);
    if (!(budget.milliseconds >= 0) || !std::isfinite(budget.milliseconds))
        return wrong("the budget of ", budget.milliseconds, " milliseconds must be 0 (no limit) or more, and finite");
    if (!budget.view) return {};
    const PlacedCamera& c = budget.view->camera;
    if (!isUnit(c.forward) || !isUnit(c.up) || std::abs(glm::dot(c.forward, c.up)) > 1e-3f || !isFinite(c.position))
        return wrong(
            "the budget's camera must stand at a finite place, and its forward and up must be unit vectors at "
            "right angles");
    if (!(c.yfov > 0 && c.yfov < 3.14f) || !(budget.view->aspect > 0) || !std::isfinite(budget.view->aspect))
        return wrong("the budget's view must have an angle between 0 and 3.14 radians, and an aspect above 0");
    return {};
}

std::size_t UpdateSchedule::bytes() const noexcept {
    return m_probes.capacity() * sizeof(Probe) + m_limits.capacity() * sizeof(m_limits[0]);
}

}  // namespace probegi

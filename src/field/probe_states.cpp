#include "field/probe_states.h"

#include <algorithm>
#include <glm/common.hpp>

#include "kernels/probe/placing.h"

namespace probegi {

namespace {

static_assert(std::uint32_t(ProbeActivity::uninitialized) == kernels::kUninitialized &&
              std::uint32_t(ProbeActivity::off) == kernels::kOff &&
              std::uint32_t(ProbeActivity::sleeping) == kernels::kSleeping &&
              std::uint32_t(ProbeActivity::newlyAwake) == kernels::kNewlyAwake &&
              std::uint32_t(ProbeActivity::newlyVigilant) == kernels::kNewlyVigilant &&
              std::uint32_t(ProbeActivity::awake) == kernels::kAwake &&
              std::uint32_t(ProbeActivity::vigilant) == kernels::kVigilant);

}  // namespace

ProbeStates::ProbeStates(const FieldDesc& desc)
    : m_relocation(desc.relocation), m_states(desc.probeStates), m_placements(std::size_t(probeCount(desc))) {
    restart();
}

void ProbeStates::restart() {
    std::fill(m_placements.begin(), m_placements.end(), watched() ? kernels::kUninitialized : kernels::kVigilant);
    m_new = watched() ? m_placements.size() : 0;
    if (m_states) m_near.assign(m_placements.size(), 0);
    // Of a probe that was never updated look-ups must know that it was not.
    m_forgets.assign(watched() ? m_placements.size() : 0, kForgets);
    m_changed = watched();
}

bool ProbeStates::isNew(std::size_t slot) const noexcept {
    return kernels::stateOf(m_placements[slot]) == kernels::kUninitialized;
}

bool ProbeStates::isTask(std::size_t slot) const noexcept {
    return isNew(slot) || kernels::isActive(kernels::stateOf(m_placements[slot]));
}

bool ProbeStates::allAreTasks() const noexcept {
    if (!watched()) return true;
    for (std::size_t slot = 0; slot < m_placements.size(); ++slot)
        if (!isTask(slot)) return false;
    return true;
}

std::vector<std::uint32_t> ProbeStates::renewed() const {
    std::vector<std::uint32_t> slots;
    for (std::size_t slot = 0; slot < m_forgets.size(); ++slot)
        if (m_forgets[slot] != kKeeps) slots.push_back(std::uint32_t(slot));
    return slots;
}

bool ProbeStates::happen(std::size_t slot, std::uint32_t event) noexcept {
    const std::uint32_t before = kernels::stateOf(m_placements[slot]);
    std::uint32_t after = kernels::nextProbeState(before, event);
    if (after == before) return false;
    if (before == kernels::kUninitialized) --m_new;
    std::uint8_t& forgets = m_forgets[slot];
    if (kernels::isUnused(after)) {
        if (forgets == kKeeps) forgets = kFellAsleep;
    } else if (forgets == kFellAsleep) {
        // It slept between two updates only, and knows all it knew.
        forgets = kKeeps;
        if (after == kernels::kNewlyAwake) after = kernels::kAwake;
    }
    m_placements[slot] = kernels::withState(m_placements[slot], after);
    m_changed = true;
    return true;
}

void ProbeStates::enter(const kernels::Volume& volume, glm::ivec3 cells) {
    if (!watched()) return;
    for (int slot = volume.firstSlot; slot < volume.firstSlot + kernels::volumeProbes(volume); ++slot) {
        if (!kernels::hasEntered(volume, kernels::probeCell(volume, slot), cells)) continue;
        std::uint32_t& placement = m_placements[std::size_t(slot)];
        if (!isNew(std::size_t(slot))) ++m_new;
        placement = kernels::kUninitialized;
        m_forgets[std::size_t(slot)] = kForgets;
        m_changed = true;
    }
}

void ProbeStates::watch(std::span<const Bounds> moving, std::span<const Bounds> media) {
    m_moving.assign(moving.begin(), moving.end());
    m_media.assign(media.begin(), media.end());
}

bool ProbeStates::wake(std::span<const kernels::Volume> volumes, const FieldSettings& settings,
                       FieldRules rules) noexcept {
    if (!m_states || m_new == m_placements.size()) return false;
    std::fill(m_near.begin(), m_near.end(), std::uint8_t(0));
    const int number = rules == FieldRules::paper ? kernels::kRulesPaper : kernels::kRulesMeasured;
    for (const kernels::Volume& volume : volumes) {
        const glm::vec3 reach = kernels::moverReach(volume, settings.selfShadowBias, number);
        for (const auto* boxes : {&m_moving, &m_media})
            for (const Bounds& box : *boxes)
                markNear(volume, kernels::boxInVolume(volume, box.lower, box.upper), reach);
    }
    bool changed = false;
    for (std::size_t slot = 0; slot < m_placements.size(); ++slot)
        changed |= happen(slot, m_near[slot] ? kernels::kMoverNear : kernels::kMoverGone);
    return changed;
}

// Of the cells around the box, those that kernels::isNearBox() says.
void ProbeStates::markNear(const kernels::Volume& volume, const kernels::Box& box, glm::vec3 reach) noexcept {
    const glm::vec3 last(volume.counts - 1);
    const glm::vec3 from = glm::floor((box.lower - reach - volume.origin) * volume.inverseSpacing);
    const glm::vec3 to = glm::ceil((box.upper + reach - volume.origin) * volume.inverseSpacing);
    const glm::ivec3 lowest(glm::clamp(from, glm::vec3(0), last + 1.0f));
    const glm::ivec3 highest(glm::clamp(to, glm::vec3(-1), last));
    for (int z = lowest.z; z <= highest.z; ++z)
        for (int y = lowest.y; y <= highest.y; ++y)
            for (int x = lowest.x; x <= highest.x; ++x)
                if (kernels::isNearBox(volume, {x, y, z}, box, reach))
                    m_near[std::size_t(kernels::probeSlot(volume, {x, y, z}))] = 1;
}

void ProbeStates::placed(std::span<const std::uint32_t> placements, std::span<const std::uint8_t> surfaces) noexcept {
    for (std::size_t slot = 0; slot < m_placements.size(); ++slot) {
        if (!isNew(slot)) {
            if (surfaces[slot]) happen(slot, kernels::kSurfaceFound);
            continue;
        }
        const std::uint32_t word = placements[slot];
        const bool looked = word != m_placements[slot];  // else it was no task of this update
        const bool used = surfaces[slot] || (word & kernels::kSurfaceBit) != 0;
        m_placements[slot] = used ? word | kernels::kSurfaceBit : word;
        m_changed = true;
        if (!looked) continue;
        m_forgets[slot] = kForgets;  // what it knows, it saw from elsewhere
        if (!kernels::isPlaced(word, m_relocation)) continue;
        m_placements[slot] &= ~kernels::kPlacingBits;
        happen(slot, kernels::placedEvent(word, used, m_states));
    }
}

void ProbeStates::updated(std::span<const ProbeTask> tasks) noexcept {
    if (!watched()) return;
    for (const ProbeTask& task : tasks) {
        std::uint32_t& placement = m_placements[task.slot];
        placement =
            kernels::withState(placement, kernels::nextProbeState(kernels::stateOf(placement), kernels::kUpdated));
    }
}

void ProbeStates::replace(SlotRange slots, std::span<const std::uint32_t> placements) {
    if (!watched()) return;
    const auto first = std::size_t(slots.first);
    for (std::size_t i = 0; i < placements.size(); ++i) {
        std::uint32_t word = placements[i];
        // Who never sleeps has no one who would wake it.
        if (!m_states && kernels::stateOf(word) != kernels::kUninitialized)
            word = kernels::withState(word, kernels::kVigilant);
        m_placements[first + i] = word;
        m_forgets[first + i] = kKeeps;
    }
    m_new = 0;
    for (std::size_t slot = 0; slot < m_placements.size(); ++slot) m_new += isNew(slot) ? 1 : 0;
    m_changed = true;
}

void ProbeStates::told() noexcept {
    std::fill(m_forgets.begin(), m_forgets.end(), kKeeps);
    m_changed = false;
}

std::size_t ProbeStates::bytes() const noexcept {
    return m_placements.capacity() * sizeof(m_placements[0]) + m_near.capacity() +
           (m_moving.capacity() + m_media.capacity()) * sizeof(Bounds) + m_forgets.capacity();
}

}  // namespace probegi

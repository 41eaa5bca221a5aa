#pragma once

#include <span>
#include <vector>

#include "field/hysteresis.h"
#include "field/probe_cost.h"
#include "field/probe_states.h"
#include "probegi/update_budget.h"

namespace probegi {

/// When each probe was updated and what it saw then, and from it, with a budget, which probes the coming update has
/// (UpdateBudget): a part of a field's books, the same on every backend.
class UpdateSchedule {
public:
    explicit UpdateSchedule(const FieldDesc& desc);

    /// A budget that is valid, or one without limits: none.
    void setBudget(const UpdateBudget& budget);
    const UpdateBudget& budget() const noexcept { return m_budget; }
    bool limited() const noexcept { return m_budget.limits(); }
    /// Rays of one probe's update.
    std::size_t raysPerProbe() const noexcept { return m_raysPerProbe; }
    /// Probes that the coming update may have, at least 1.
    std::size_t affordable() const noexcept;
    void reportTime(double milliseconds, std::size_t probes) noexcept { m_cost.report(milliseconds, probes); }

    /// Those of the candidates that the budget pays for, in their order.
    std::vector<ProbeTask> choose(std::vector<ProbeTask> candidates, std::span<const kernels::Volume> volumes,
                                  const ProbeStates& states, const FieldSettings& settings) const;

    /// After an update of these probes; `progress`, by slot, is what they told, or empty.
    void updated(std::span<const ProbeTask> tasks, std::span<const kernels::ProbeProgress> progress) noexcept;
    /// The volume was scrolled by so many cells, and stands as `volume` now: probes that entered are new.
    void enter(const kernels::Volume& volume, glm::ivec3 cells) noexcept;
    /// Probes of a snapshot, of whose progress nothing is known.
    void replace(SlotRange slots) noexcept;
    /// All probes are new.
    void restart() noexcept;
    /// Of the GPU, which is read while it works ahead: what the probes saw when they were last heard of.
    void hear(std::span<const kernels::ProbeProgress> progress) noexcept;
    /// Updates of the field since the last one of the probe, or since it entered.
    int age(std::size_t slot) const noexcept { return int(m_clock - m_probes[slot].since); }

    /// A change was announced for probes in the box: each of them has the event's number of updates.
    void notify(FieldEvent event, const Bounds& box, std::span<const kernels::Volume> volumes,
                const ProbeStates& states) noexcept;
    /// By slot, what events leave the tasks' probes; empty if there are none. Valid until the next call.
    std::span<const kernels::EventLimit> limits(std::span<const ProbeTask> tasks,
                                                const FieldSettings& settings) const noexcept;

    std::size_t bytes() const noexcept;

private:
    struct Probe {
        std::uint32_t since = 0;                               // m_clock of its last update
        float lag = 0, noise = -1, confidence = 0, level = 0;  // kernels::ProbeProgress; noise below 0: not known
        std::uint8_t updates = 0;                              // counted up to a few
        EventUpdates events{};
    };
    struct Rank;

    static bool seesChange(const Probe& probe) noexcept;
    std::vector<float> heardLags(std::span<const ProbeTask> candidates, std::span<const kernels::Volume> volumes) const;
    float meanLevel(std::span<const ProbeTask> candidates) const noexcept;
    float priority(const Probe& probe, bool isNew, float heardLag, float meanLevel) const noexcept;
    static void tell(Probe& probe, const kernels::ProbeProgress& told) noexcept;

    UpdateBudget m_budget;
    std::size_t m_raysPerProbe;
    ProbeCost m_cost;
    std::vector<Probe> m_probes;                        // [slot]
    std::uint32_t m_clock = 0;                          // updates so far
    mutable std::vector<kernels::EventLimit> m_limits;  // [slot], from the first budget on
};

/// Errors: invalidArgument (the message names the member and its range).
Result<void> validateBudget(const FieldDesc& desc, const UpdateBudget& budget);

}  // namespace probegi

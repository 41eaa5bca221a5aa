#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "kernels/lookup/used_probes.h"
#include "probegi/control.h"
#include "probegi/scene.h"
#include "probegi/snapshot.h"

namespace probegi {

/// Where each probe of a field stands and which are updated (sections 5 and 6), by slot: the part of a field's books
/// that relocation and probe states fill, the same on every backend. A field without either has all of its probes on
/// the lattice, and vigilant.
class ProbeStates {
public:
    explicit ProbeStates(const FieldDesc& desc);

    /// Placement words (kernels/volume/probe_offset.h, kernels/probe/probe_state.h).
    std::span<const std::uint32_t> placements() const noexcept { return m_placements; }
    /// Whether the field has relocation or states at all.
    bool watched() const noexcept { return m_relocation || m_states; }
    /// Whether some probes await their placement.
    bool hasNew() const noexcept { return m_new > 0; }
    bool isNew(std::size_t slot) const noexcept;
    /// Whether an update has the probe among its tasks. New ones are: their rays place them, where the caller traces.
    bool isTask(std::size_t slot) const noexcept;
    bool allAreTasks() const noexcept;

    /// Back to the beginning: all probes are new.
    void restart();
    /// The volume was scrolled by so many cells, and stands as `volume` now.
    void enter(const kernels::Volume& volume, glm::ivec3 cells);
    /// Bounds of what moves and of media, in the world; they hold until they are replaced.
    void watch(std::span<const Bounds> moving, std::span<const Bounds> media);
    std::span<const Bounds> moving() const noexcept { return m_moving; }
    std::span<const Bounds> media() const noexcept { return m_media; }
    /// After watch(), a scroll or a placement: wakes probes near moving things and puts others to sleep (Listing 5).
    /// Returns whether any did.
    bool wake(std::span<const kernels::Volume> volumes, const FieldSettings& settings, FieldRules rules) noexcept;
    /// After placeProbes(): takes over the words, and ends the placement of probes whose iterations are done.
    /// `surfaces`: by slot, whether a ray found a static surface that uses the probe.
    void placed(std::span<const std::uint32_t> placements, std::span<const std::uint8_t> surfaces) noexcept;
    /// Probes were updated.
    void updated(std::span<const ProbeTask> tasks) noexcept;
    /// Words of a snapshot.
    void replace(SlotRange slots, std::span<const std::uint32_t> placements);

    /// What the backend has not been told yet: whether words have changed, and which probes forget all they know.
    bool changed() const noexcept { return m_changed; }
    std::vector<std::uint32_t> renewed() const;
    void told() noexcept;

    std::size_t bytes() const noexcept;

private:
    /// What a probe will have forgotten once the backend is told.
    enum Forgetting : std::uint8_t { kKeeps, kFellAsleep, kForgets };

    bool happen(std::size_t slot, std::uint32_t event) noexcept;
    void markNear(const kernels::Volume& volume, const kernels::Box& box, glm::vec3 reach) noexcept;

    bool m_relocation, m_states;
    std::vector<std::uint32_t> m_placements;
    std::vector<std::uint8_t> m_near;  // by slot: something that moves is near
    std::vector<Bounds> m_moving, m_media;
    std::vector<std::uint8_t> m_forgets;  // Forgetting, by slot
    std::size_t m_new = 0;
    bool m_changed = false;
};

}  // namespace probegi

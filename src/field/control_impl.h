#pragma once

#include <cstdint>
#include <vector>

#include "field/probe_states.h"
#include "field/update_frame.h"
#include "field/update_schedule.h"
#include "field/volume_access.h"
#include "kernels/trace/ray_set.h"
#include "probegi/control.h"
#include "probegi/snapshot.h"

namespace probegi {

/// What a field keeps from frame to frame besides its probes, the same on every backend: how many updates there were,
/// the coming one's probes, ray directions and dither, and the hysteresis that events lower.
struct FieldControl::Impl {
    /// Both must be valid.
    Impl(const FieldDesc& desc, const FieldSettings& settings);

    /// The coming update by the described rules: with windows, or, by the paper, in encoded space with the settings'
    /// hysteresis. Valid until advance() or a change of the settings or tasks.
    UpdateFrame comingUpdate() const noexcept;
    /// The same for ray data that come without fixed rays.
    UpdateFrame comingUpdateWithoutFixedRays() const noexcept;
    /// The coming update as part of an average in linear space, of whose old values `kept` survive.
    UpdateFrame comingAverage(FrameHysteresis kept) const noexcept;
    /// The coming update as one that only looks, after an average: later ones go on from there, at the pace that the
    /// average had. They need to know what its fixed rays see and how much its light scatters. Settles nothing if the
    /// rules have no windows.
    UpdateFrame comingSettled() const noexcept;
    /// Whether the coming updates are part of an average. Their rays are turned, not shifted: an average follows
    /// bounces with one and the same set, which is best as it was published.
    void setAveraging(bool averaging);
    /// The directions of update `number`, in a few numbers.
    kernels::RaySet raySet(int number) const noexcept;
    /// The coming update's rays are those of this frame's update.
    void turnRaysAt(int number) noexcept;
    /// Ends the frame: after the update. Without `turn`, the coming update has the same rays again. `progress`:
    /// FieldBackend::progress(). With a budget the coming update has other tasks, or, without memory, the same.
    void advance(bool turn = true, std::span<const kernels::ProbeProgress> progress = {}) noexcept;
    /// With a budget, after what it goes by has changed: the coming update's tasks.
    void chooseTasks() noexcept;
    /// FieldControl::notify. With a budget, updates have some probes only: for how many updates a probe is to follow
    /// faster is then counted for each.
    void notify(FieldEvent event) noexcept;
    void notify(FieldEvent event, const Bounds& box) noexcept;
    /// Back to frame 0, for probes that were cleared. Desc, settings and tasks stay.
    void restart();
    /// Fills in what a snapshot says of the books.
    void describe(FieldSnapshot& snapshot) const noexcept;
    /// After the probes were written: Field::write.
    void goOnFrom(const FieldSnapshot& snapshot) noexcept;
    std::size_t bytes() const noexcept;
    std::size_t rayCount() const noexcept { return tasks.size() * directions.size(); }
    std::size_t fixedRayCount() const noexcept { return tasks.size() * fixedDirections.size(); }

    /// Where the volumes stand, and what follows from it.
    struct Placement {
        std::vector<glm::ivec3> scrolled;      // by volume, cells
        std::vector<kernels::Volume> volumes;  // as they stand
        ProbeStates states;
        UpdateSchedule schedule;
        std::vector<ProbeTask> tasks;
        std::uint32_t taskList;
    };
    /// The placement after a volume was scrolled by so many cells more. Errors: invalidArgument (no such volume, too
    /// far away, in the middle of an average).
    Result<Placement> scrolledBy(int volume, glm::ivec3 cells) const;
    /// The placement of a snapshot's field. Errors: invalidArgument.
    Result<Placement> placementOf(const FieldSnapshot& snapshot) const;
    /// After the states have changed: the coming updates' tasks. May throw std::bad_alloc; the tasks are then those
    /// before.
    void listTasks();
    /// The volumes and how they answer together, as they are now.
    VolumeAccess volumeAccess() const noexcept { return {volumes, volumeOrder(desc, settings, byDensity)}; }
    /// By how far each volume is to be scrolled after a camera. Errors: invalidArgument (not finite).
    Result<std::vector<glm::ivec3>> cellsAfter(glm::vec3 camera) const;
    /// Exchanges the placement with another one.
    void swapPlacement(Placement& other) noexcept;

    FieldDesc desc;
    FieldSettings settings;
    std::vector<glm::ivec3> scrolled;      // by volume, cells
    std::vector<kernels::Volume> volumes;  // as they stand now
    ProbeStates states;
    UpdateSchedule schedule;
    std::vector<std::uint32_t> chosen;  // slots that setTasks chose; empty: all
    std::vector<int> byDensity;         // of the volumes
    std::vector<ProbeTask> tasks;
    std::uint32_t taskList = 0;           // number of the list; 0: all probes
    mutable std::uint32_t taskLists = 0;  // so far
    std::vector<glm::vec3> directions, fixedDirections;
    HysteresisSchedule events;
    int frame = 0;
    int turns = 0;     // of the rays
    int rayFrame = 0;  // whose rays the coming update has
    bool averaging = false;

private:
    void turnRays() noexcept { turnRaysAt(frame); }
    Result<void> watch(std::span<const Bounds> moving, std::span<const Bounds> media);
    Result<Placement> placedAt(std::vector<glm::ivec3> cells, const ProbeStates& now) const;
    /// The tasks of a coming update, and the number of their list.
    struct TaskList {
        std::vector<ProbeTask> tasks;
        std::uint32_t number;
    };
    TaskList listed(std::span<const kernels::Volume> where, const ProbeStates& of, std::span<const std::uint32_t> among,
                    const UpdateSchedule& by) const;
    void take(TaskList list) noexcept;
    void listTasks(Placement& placed) const;
    friend class FieldControl;
};

/// Those of the chosen probes that an update has among its tasks, in their order; none chosen: of all, by slot.
std::vector<ProbeTask> tasksOf(std::span<const kernels::Volume> volumes, const ProbeStates& states,
                               std::span<const std::uint32_t> chosen);

/// The desc and settings must be valid.
FieldControl makeFieldControl(const FieldDesc& desc, const FieldSettings& settings);

}  // namespace probegi

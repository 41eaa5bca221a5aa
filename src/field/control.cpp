#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <new>

#include "core/sentence.h"
#include "field/control_impl.h"
#include "field/layout.h"
#include "kernels/blend/temporal_filter.h"
#include "kernels/probe/probe_state.h"
#include "kernels/trace/ray_set.h"
#include "kernels/volume/placed_probe.h"

namespace probegi {

namespace {

constexpr const char* kNoListMemory = "no memory for the list of probes";
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr Bounds kEverywhere{glm::vec3(-kInfinity), glm::vec3(kInfinity)};

std::uint32_t seedOf(const FieldDesc& desc) {
    return kernels::hashCombine(std::uint32_t(desc.seed), std::uint32_t(desc.seed >> 32));
}

std::uint32_t ditherSeedOf(const FieldDesc& desc, int frame) {
    return kernels::hashCombine(seedOf(desc) ^ 0x6a09e667u, std::uint32_t(frame));
}

// Of the probe in a slot, wherever its volume's window is.
glm::vec3 positionOf(const kernels::Volume& volume, const ProbeStates& states, std::size_t slot) {
    return kernels::placedPosition(volume, kernels::probeCell(volume, int(slot)), states.placements()[slot]);
}

Result<void> checkBounds(std::span<const Bounds> bounds) {
    for (const Bounds& b : bounds)
        for (int axis = 0; axis < 3; ++axis)
            if (!std::isfinite(b.lower[axis]) || !std::isfinite(b.upper[axis]) || b.lower[axis] > b.upper[axis])
                return fail(ErrorCode::invalidArgument,
                            "bounds must be finite, and their lower corner not above the upper one");
    return {};
}

}  // namespace

std::vector<ProbeTask> tasksOf(std::span<const kernels::Volume> volumes, const ProbeStates& states,
                               std::span<const std::uint32_t> chosen) {
    std::vector<ProbeTask> tasks;
    const auto add = [&](std::uint32_t slot, std::uint32_t volume) {
        if (states.isTask(slot)) tasks.push_back({positionOf(volumes[volume], states, slot), slot, volume});
    };
    for (const std::uint32_t slot : chosen) add(slot, std::uint32_t(volumeOf(volumes, int(slot))));
    if (!chosen.empty()) return tasks;
    for (std::uint32_t volume = 0; volume < volumes.size(); ++volume)
        for (int i = 0; i < kernels::volumeProbes(volumes[volume]); ++i)
            add(std::uint32_t(volumes[volume].firstSlot + i), volume);
    return tasks;
}

FieldControl::Impl::Impl(const FieldDesc& d, const FieldSettings& s)
    : desc(d),
      settings(s),
      scrolled(d.volumes.size()),
      volumes(makeVolumes(d)),
      states(d),
      schedule(d),
      byDensity(volumesByDensity(d)),
      tasks(tasksOf(volumes, states, {})),
      directions(std::size_t(d.raysPerProbe)) {
    if (desc.rules == FieldRules::measured) fixedDirections.resize(std::size_t(desc.fixedRays));
    const kernels::RaySet set = raySet(0);
    for (int i = 0; i < set.fixedCount; ++i) fixedDirections[std::size_t(i)] = kernels::fixedRayOfSet(set, i);
    turnRays();
}

kernels::RaySet FieldControl::Impl::raySet(int number) const noexcept {
    const bool shifted = desc.rules == FieldRules::measured && !averaging;
    const std::uint32_t count = std::uint32_t(directions.size()), n = std::uint32_t(number);
    const glm::mat3 rotation = kernels::frameRotation(seedOf(desc), shifted ? 0u : n);
    return {.turned = {rotation[0], rotation[1], rotation[2]},
            .shift = shifted ? kernels::frameShift(seedOf(desc), n, count) : glm::vec2(0.5f, 0.0f),
            .count = int(count),
            .fixedCount = int(fixedDirections.size())};
}

void FieldControl::Impl::turnRaysAt(int number) noexcept {
    rayFrame = number;
    const kernels::RaySet set = raySet(number);
    for (int i = 0; i < set.count; ++i) directions[std::size_t(i)] = kernels::rayOfSet(set, i);
}

std::size_t FieldControl::Impl::bytes() const noexcept {
    return sizeof(*this) + (directions.capacity() + fixedDirections.capacity()) * sizeof(directions[0]) +
           tasks.capacity() * sizeof(tasks[0]) + chosen.capacity() * sizeof(chosen[0]) +
           byDensity.capacity() * sizeof(byDensity[0]) + states.bytes() + schedule.bytes();
}

FieldControl::Impl::TaskList FieldControl::Impl::listed(std::span<const kernels::Volume> where, const ProbeStates& of,
                                                        std::span<const std::uint32_t> among,
                                                        const UpdateSchedule& by) const {
    TaskList list{tasksOf(where, of, among), 0};
    const std::size_t candidates = list.tasks.size();
    if (by.limited()) list.tasks = by.choose(std::move(list.tasks), where, of, settings);
    const bool all = among.empty() && of.allAreTasks() && list.tasks.size() == candidates;
    list.number = all ? 0 : ++taskLists;
    return list;
}

void FieldControl::Impl::take(TaskList list) noexcept {
    tasks.swap(list.tasks);
    taskList = list.number;
}

void FieldControl::Impl::listTasks() {
    take(listed(volumes, states, chosen, schedule));
}

void FieldControl::Impl::listTasks(Placement& placed) const {
    TaskList list = listed(placed.volumes, placed.states, chosen, placed.schedule);
    placed.tasks = std::move(list.tasks);
    placed.taskList = list.number;
}

void FieldControl::Impl::chooseTasks() noexcept try {
    if (!averaging && schedule.limited()) listTasks();
} catch (const std::bad_alloc&) {
    // Those before are as good a choice.
}

Result<void> FieldControl::Impl::watch(std::span<const Bounds> moving, std::span<const Bounds> media) try {
    if (auto ok = checkBounds(moving).and_then([&] { return checkBounds(media); }); !ok) return ok;
    ProbeStates next = states;
    next.watch(moving, media);
    if (next.wake(volumes, settings, desc.rules)) {
        take(listed(volumes, next, chosen, schedule));
    }
    std::swap(states, next);
    return {};
} catch (const std::bad_alloc&) {
    return fail(ErrorCode::outOfMemory, "no memory for the bounds of what moves");
}

UpdateFrame FieldControl::Impl::comingUpdate() const noexcept {
    UpdateFrame coming{.desc = desc,
                       .settings = settings,
                       .volumes = volumes,
                       .tasks = tasks,
                       .taskList = taskList,
                       .directions = directions,
                       .hysteresis = events.current(settings, frame == 0),
                       .events = events.regions(settings, frame == 0),
                       .ditherSeed = ditherSeedOf(desc, frame),
                       .raySeed = ditherSeedOf(desc, turns) ^ 0x85ebca6bu,
                       .bounces = frame > 0,
                       .nextRays = raySet(frame + 1)};
    coming.limits = schedule.limits(tasks, settings);
    if (desc.rules == FieldRules::paper) return coming;
    coming.reportsProgress = schedule.limited();
    coming.linear = coming.windows = true;
    coming.fixedDirections = fixedDirections;
    // Where nothing would tell of a change, old light must fade all the same.
    coming.longestWindow = events.irradianceEvent() || fixedDirections.empty()
                               ? kernels::windowOfHysteresis(coming.hysteresis.irradiance)
                               : kernels::kLongestWindow;
    coming.longestVisibilityWindow = events.visibilityEvent() || fixedDirections.empty()
                                         ? kernels::windowOfHysteresis(coming.hysteresis.visibility)
                                         : kernels::kLongestVisibilityWindow;
    return coming;
}

UpdateFrame FieldControl::Impl::comingUpdateWithoutFixedRays() const noexcept {
    UpdateFrame coming = comingUpdate();
    coming.fixedDirections = {};
    coming.longestWindow = kernels::windowOfHysteresis(coming.hysteresis.irradiance);
    coming.longestVisibilityWindow = kernels::windowOfHysteresis(coming.hysteresis.visibility);
    return coming;
}

UpdateFrame FieldControl::Impl::comingAverage(FrameHysteresis kept) const noexcept {
    UpdateFrame coming = comingUpdate();
    coming.hysteresis = kept;
    coming.events = {};
    coming.limits = {};
    coming.linear = true;
    coming.windows = coming.reportsProgress = false;
    coming.fixedDirections = {};
    return coming;
}

UpdateFrame FieldControl::Impl::comingSettled() const noexcept {
    UpdateFrame coming = comingUpdate();
    coming.events = {};
    coming.limits = {};
    coming.settles = coming.windows;
    return coming;
}

void FieldControl::Impl::setAveraging(bool isAverage) {
    averaging = isAverage;
    turnRays();
}

void FieldControl::Impl::advance(bool turn, std::span<const kernels::ProbeProgress> progress) noexcept {
    events.advance();
    states.updated(tasks);
    schedule.updated(tasks, progress);
    ++frame;
    chooseTasks();
    if (!turn) return;
    ++turns;
    turnRays();
}

void FieldControl::Impl::notify(FieldEvent event, const Bounds& box) noexcept {
    if (!schedule.limited()) return events.notify(event, box);
    schedule.notify(event, isNumber(box) ? box : kEverywhere, volumes, states);
    chooseTasks();
}

void FieldControl::Impl::notify(FieldEvent event) noexcept {
    if (!schedule.limited()) return events.notify(event);
    notify(event, kEverywhere);
}

void FieldControl::Impl::restart() {
    events = {};
    frame = turns = 0;
    states.restart();
    schedule.restart();
    listTasks();
    turnRays();
}

void FieldControl::Impl::describe(FieldSnapshot& snapshot) const noexcept {
    snapshot.frame = frame;
    snapshot.rayTurns = turns;
    snapshot.scrolled = scrolled;
    for (std::size_t i = 0; i < snapshot.states.size(); ++i)
        snapshot.states[i].placement = states.placements()[std::size_t(snapshot.slots.first) + i];
}

Result<FieldControl::Impl::Placement> FieldControl::Impl::placedAt(std::vector<glm::ivec3> cells,
                                                                   const ProbeStates& now) const {
    if (averaging) return fail(ErrorCode::invalidArgument, "a field cannot be moved or written while it converges");
    for (std::size_t i = 0; i < cells.size(); ++i)
        if (auto ok = validateVolumePlace(sentence("volumes[", i, "]"), scrolledVolume(desc.volumes[i], cells[i])); !ok)
            return ok.error();
    if (auto ok = validateGuard(desc, settings, cells); !ok) return ok.error();
    Placement placed{std::move(cells), {}, now, schedule, {}, 0};
    placed.volumes = makeVolumes(desc, placed.scrolled);
    for (std::size_t i = 0; i < placed.volumes.size(); ++i)
        placed.states.enter(placed.volumes[i], placed.scrolled[i] - scrolled[i]);
    for (std::size_t i = 0; i < placed.volumes.size(); ++i)
        placed.schedule.enter(placed.volumes[i], placed.scrolled[i] - scrolled[i]);
    placed.states.wake(placed.volumes, settings, desc.rules);
    listTasks(placed);
    return placed;
}

Result<FieldControl::Impl::Placement> FieldControl::Impl::scrolledBy(int volume, glm::ivec3 cells) const {
    if (volume < 0 || std::size_t(volume) >= desc.volumes.size())
        return fail(ErrorCode::invalidArgument,
                    sentence("there is no volume ", volume, "; the field has ", desc.volumes.size()));
    std::vector<glm::ivec3> moved = scrolled;
    for (int axis = 0; axis < 3; ++axis) {
        const std::int64_t sum = std::int64_t(moved[std::size_t(volume)][axis]) + cells[axis];
        if (std::abs(sum) > kMostScrolled)
            return fail(ErrorCode::invalidArgument,
                        sentence("a volume can be scrolled by ", kMostScrolled, " cells from where it was made"));
        moved[std::size_t(volume)][axis] = int(sum);
    }
    return placedAt(std::move(moved), states);
}

Result<FieldControl::Impl::Placement> FieldControl::Impl::placementOf(const FieldSnapshot& snapshot) const {
    const bool whole = snapshot.slots.count == probeCount(desc);
    if (!whole && snapshot.slots.count > 0 && snapshot.scrolled != scrolled)
        return fail(ErrorCode::invalidArgument,
                    "the snapshot's volumes were scrolled elsewhere; scroll the field's alike, or write all slots");
    std::vector<std::uint32_t> placements;
    for (const ProbeState& state : snapshot.states) placements.push_back(state.placement);
    auto placed = placedAt(whole ? snapshot.scrolled : scrolled, states);
    if (!placed) return placed;
    placed->states.replace(snapshot.slots, placements);
    placed->schedule.replace(snapshot.slots);
    listTasks(*placed);
    return placed;
}

Result<std::vector<glm::ivec3>> FieldControl::Impl::cellsAfter(glm::vec3 camera) const {
    FieldSettings there = settings;
    there.camera = camera;
    if (auto ok = validateFieldSettings(there); !ok) return ok.error();
    std::vector<glm::ivec3> cells(desc.volumes.size());
    for (std::size_t i = 0; i < cells.size(); ++i)
        if (desc.volumes[i].tracksCamera)
            cells[i] = cellsToFollow(scrolledVolume(desc.volumes[i], scrolled[i]), camera);
    return cells;
}

void FieldControl::Impl::swapPlacement(Placement& other) noexcept {
    scrolled.swap(other.scrolled);
    volumes.swap(other.volumes);
    std::swap(states, other.states);
    std::swap(schedule, other.schedule);
    tasks.swap(other.tasks);
    std::swap(taskList, other.taskList);
}

void FieldControl::Impl::goOnFrom(const FieldSnapshot& snapshot) noexcept {
    const bool whole = snapshot.slots.count == probeCount(desc);
    if (whole) events = {};
    if (!whole && (snapshot.slots.count == 0 || snapshot.frame <= frame)) return;
    frame = snapshot.frame;
    turns = snapshot.rayTurns;
    turnRays();
}

FieldControl makeFieldControl(const FieldDesc& desc, const FieldSettings& settings) {
    return FieldControl(std::make_unique<FieldControl::Impl>(desc, settings));
}

FieldControl::FieldControl(std::unique_ptr<Impl> impl) : m_impl(std::move(impl)) {}
FieldControl::~FieldControl() = default;

const FieldDesc& FieldControl::desc() const noexcept {
    return m_impl->desc;
}
const FieldSettings& FieldControl::settings() const noexcept {
    return m_impl->settings;
}
int FieldControl::frame() const noexcept {
    return m_impl->frame;
}
VolumeDesc FieldControl::place(int volume) const noexcept {
    return scrolledVolume(m_impl->desc.volumes[std::size_t(volume)], m_impl->scrolled[std::size_t(volume)]);
}
float FieldControl::coverage(glm::vec3 point) const noexcept {
    return kernels::coverageAt(m_impl->volumeAccess(), point);
}
Result<void> FieldControl::coverage(std::span<const glm::vec3> points, std::span<float> out) const {
    if (points.size() != out.size())
        return fail(ErrorCode::invalidArgument, sentence("there are ", points.size(), " points and room for ",
                                                         out.size(), " answers; both spans must be equally long"));
    const VolumeAccess access = m_impl->volumeAccess();
    for (std::size_t i = 0; i < points.size(); ++i) out[i] = kernels::coverageAt(access, points[i]);
    return {};
}
Result<std::vector<float>> FieldControl::volumeShares(glm::vec3 point) const try {
    return sharesOfVolumes(m_impl->volumeAccess(), point);
} catch (const std::bad_alloc&) {
    return fail(ErrorCode::outOfMemory, "no memory for the shares of the volumes");
}
void FieldControl::notify(FieldEvent event) noexcept {
    m_impl->notify(event);
}
void FieldControl::notify(FieldEvent event, const Bounds& region) noexcept {
    m_impl->notify(event, region);
}
std::span<const ProbeTask> FieldControl::tasks() const noexcept {
    return m_impl->tasks;
}
std::span<const glm::vec3> FieldControl::rayDirections() const noexcept {
    return m_impl->directions;
}
std::span<const glm::vec3> FieldControl::fixedRayDirections() const noexcept {
    return m_impl->fixedDirections;
}

ProbeActivity FieldControl::activity(int slot) const noexcept {
    return ProbeActivity(kernels::stateOf(m_impl->states.placements()[std::size_t(slot)]));
}
glm::vec3 FieldControl::probePosition(int slot) const noexcept {
    const std::span<const kernels::Volume> volumes = m_impl->volumes;
    return positionOf(volumes[volumeOf(volumes, slot)], m_impl->states, std::size_t(slot));
}

Result<void> FieldControl::setMoving(std::span<const Bounds> bounds) {
    return m_impl->watch(bounds, m_impl->states.media());
}
Result<void> FieldControl::setMedia(std::span<const Bounds> bounds) {
    return m_impl->watch(m_impl->states.moving(), bounds);
}

Result<void> FieldControl::setSettings(const FieldSettings& settings) {
    if (auto ok = validateFieldSettings(settings); !ok) return ok;
    if (auto ok = validateGuard(m_impl->desc, settings, m_impl->scrolled); !ok) return ok;
    m_impl->settings = settings;
    m_impl->chooseTasks();  // the camera may have moved
    return {};
}

Result<void> FieldControl::setTasks(std::span<const std::uint32_t> slots) try {
    std::vector<bool> taken(std::size_t(probeCount(m_impl->desc)));
    for (const std::uint32_t slot : slots) {
        if (slot >= taken.size())
            return fail(ErrorCode::invalidArgument,
                        sentence("there is no probe in slot ", slot, "; the field has ", taken.size(), " slots"));
        if (taken[slot])
            return fail(ErrorCode::invalidArgument,
                        sentence("slot ", slot, " is listed twice; an update has each probe once"));
        taken[slot] = true;
    }
    std::vector<std::uint32_t> chosen(slots.begin(), slots.end());
    m_impl->take(m_impl->listed(m_impl->volumes, m_impl->states, chosen, m_impl->schedule));
    m_impl->chosen.swap(chosen);
    return {};
} catch (const std::bad_alloc&) {
    return fail(ErrorCode::outOfMemory, kNoListMemory);
}

Result<void> FieldControl::setBudget(const UpdateBudget& budget) try {
    if (auto ok = validateBudget(m_impl->desc, budget); !ok) return ok;
    UpdateSchedule schedule = m_impl->schedule;
    schedule.setBudget(budget);
    m_impl->take(m_impl->listed(m_impl->volumes, m_impl->states, m_impl->chosen, schedule));
    std::swap(m_impl->schedule, schedule);
    return {};
} catch (const std::bad_alloc&) {
    return fail(ErrorCode::outOfMemory, kNoListMemory);
}
const UpdateBudget& FieldControl::budget() const noexcept {
    return m_impl->schedule.budget();
}
void FieldControl::reportTime(double milliseconds, int probes) noexcept {
    m_impl->schedule.reportTime(milliseconds, std::size_t(std::max(0, probes)));
}
int FieldControl::updateAge(int slot) const noexcept {
    return m_impl->schedule.age(std::size_t(slot));
}

}  // namespace probegi

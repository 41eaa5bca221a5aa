#include <algorithm>
#include <cstdlib>
#include <new>

#include "core/sentence.h"
#include "field/control_impl.h"
#include "field/layout.h"
#include "kernels/blend/temporal_filter.h"
#include "kernels/trace/ray_set.h"
#include "kernels/volume/volume_frame.h"

namespace probegi {

namespace {

std::uint32_t seedOf(const FieldDesc& desc) {
    return kernels::hashCombine(std::uint32_t(desc.seed), std::uint32_t(desc.seed >> 32));
}

std::uint32_t ditherSeedOf(const FieldDesc& desc, int frame) {
    return kernels::hashCombine(seedOf(desc) ^ 0x6a09e667u, std::uint32_t(frame));
}

// Of the probe in a slot, wherever its volume's window is.
glm::vec3 positionOf(const kernels::Volume& volume, int slot) {
    return kernels::probePosition(volume, kernels::probeCell(volume, slot));
}

}  // namespace

std::vector<ProbeTask> allTasks(std::span<const kernels::Volume> volumes) {
    std::vector<ProbeTask> tasks;
    for (std::uint32_t volume = 0; volume < volumes.size(); ++volume)
        for (int i = 0; i < kernels::volumeProbes(volumes[volume]); ++i)
            tasks.push_back({positionOf(volumes[volume], int(tasks.size())), std::uint32_t(tasks.size()), volume});
    return tasks;
}

FieldControl::Impl::Impl(const FieldDesc& d, const FieldSettings& s)
    : desc(d),
      settings(s),
      scrolled(d.volumes.size()),
      volumes(makeVolumes(d)),
      tasks(allTasks(volumes)),
      directions(std::size_t(d.raysPerProbe)) {
    turnRays();
    const std::uint32_t fixed = desc.rules == FieldRules::measured ? std::uint32_t(desc.fixedRays) : 0u;
    for (std::uint32_t i = 0; i < fixed; ++i) fixedDirections.push_back(kernels::sphericalFibonacci(i, fixed));
}

void FieldControl::Impl::turnRays() noexcept {
    const bool shifted = desc.rules == FieldRules::measured && !averaging;
    const std::uint32_t count = std::uint32_t(directions.size()), number = std::uint32_t(frame);
    const glm::mat3 rotation = kernels::frameRotation(seedOf(desc), shifted ? 0u : number);
    const glm::vec2 shift = shifted ? kernels::frameShift(seedOf(desc), number, count) : glm::vec2(0.5f, 0.0f);
    for (std::uint32_t i = 0; i < count; ++i) directions[i] = rotation * kernels::shiftedFibonacci(i, count, shift);
}

std::size_t FieldControl::Impl::bytes() const noexcept {
    return sizeof(*this) + (directions.capacity() + fixedDirections.capacity()) * sizeof(directions[0]) +
           tasks.capacity() * sizeof(tasks[0]);
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
                       .bounces = frame > 0};
    if (desc.rules == FieldRules::paper) return coming;
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
    coming.linear = true;
    coming.windows = false;
    coming.fixedDirections = {};
    return coming;
}

void FieldControl::Impl::setAveraging(bool isAverage) {
    averaging = isAverage;
    turnRays();
}

void FieldControl::Impl::advance(bool turn) {
    events.advance();
    ++frame;
    if (!turn) return;
    ++turns;
    turnRays();
}

void FieldControl::Impl::restart() {
    events = {};
    frame = turns = 0;
    turnRays();
}

void FieldControl::Impl::describe(FieldSnapshot& snapshot) const noexcept {
    snapshot.frame = frame;
    snapshot.rayTurns = turns;
    snapshot.scrolled = scrolled;
}

Result<FieldControl::Impl::Placement> FieldControl::Impl::placedAt(std::vector<glm::ivec3> cells) const {
    if (averaging) return fail(ErrorCode::invalidArgument, "a field cannot be moved or written while it converges");
    for (std::size_t i = 0; i < cells.size(); ++i)
        if (auto ok = validateVolumePlace(sentence("volumes[", i, "]"), scrolledVolume(desc.volumes[i], cells[i])); !ok)
            return ok.error();
    Placement placed{std::move(cells), {}, tasks};
    placed.volumes = makeVolumes(desc, placed.scrolled);
    for (ProbeTask& task : placed.tasks) task.origin = positionOf(placed.volumes[task.volume], int(task.slot));
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
    return placedAt(std::move(moved));
}

Result<FieldControl::Impl::Placement> FieldControl::Impl::placementOf(const FieldSnapshot& snapshot) const {
    const bool whole = snapshot.slots.count == probeCount(desc);
    if (!whole && snapshot.slots.count > 0 && snapshot.scrolled != scrolled)
        return fail(ErrorCode::invalidArgument,
                    "the snapshot's volumes were scrolled elsewhere; scroll the field's alike, or write all slots");
    return placedAt(whole ? snapshot.scrolled : scrolled);
}

void FieldControl::Impl::swapPlacement(Placement& other) noexcept {
    scrolled.swap(other.scrolled);
    volumes.swap(other.volumes);
    tasks.swap(other.tasks);
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
void FieldControl::notify(FieldEvent event) noexcept {
    m_impl->events.notify(event);
}
void FieldControl::notify(FieldEvent event, const Bounds& region) noexcept {
    m_impl->events.notify(event, region);
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

Result<void> FieldControl::setSettings(const FieldSettings& settings) {
    if (auto ok = validateFieldSettings(settings); !ok) return ok;
    m_impl->settings = settings;
    return {};
}

Result<void> FieldControl::setTasks(std::span<const std::uint32_t> slots) try {
    const FieldDesc& desc = m_impl->desc;
    if (slots.empty()) {
        m_impl->tasks = allTasks(m_impl->volumes);
        m_impl->taskList = 0;
        return {};
    }
    const std::span<const kernels::Volume> volumes = m_impl->volumes;
    std::vector<bool> taken(std::size_t(probeCount(desc)));
    std::vector<ProbeTask> chosen;
    chosen.reserve(slots.size());
    for (const std::uint32_t slot : slots) {
        if (slot >= taken.size())
            return fail(ErrorCode::invalidArgument,
                        sentence("there is no probe in slot ", slot, "; the field has ", taken.size(), " slots"));
        if (taken[slot])
            return fail(ErrorCode::invalidArgument,
                        sentence("slot ", slot, " is listed twice; an update has each probe once"));
        taken[slot] = true;
        const std::size_t volume = volumeOf(volumes, int(slot));
        chosen.push_back({positionOf(volumes[volume], int(slot)), slot, std::uint32_t(volume)});
    }
    m_impl->tasks = std::move(chosen);
    m_impl->taskList = ++m_impl->taskLists;
    return {};
} catch (const std::bad_alloc&) {
    return fail(ErrorCode::outOfMemory, "no memory for the list of probes");
}

}  // namespace probegi

#include "cpu/filter_passes.h"

#include <algorithm>
#include <glm/common.hpp>

#include "core/parallel.h"
#include "kernels/volume/volume.h"

namespace probegi {

namespace {

constexpr std::size_t kProbesPerTask = 256;

// The lag of a probe and the up to 26 around it in its volume.
kernels::LagAround lagAround(const kernels::Volume& volume, std::span<const kernels::ProbeLag> lags, int slot) {
    const glm::ivec3 at = kernels::probeCell(volume, slot);
    const glm::ivec3 lowest = glm::max(at - 1, glm::ivec3(0)), highest = glm::min(at + 1, volume.counts - 1);
    const auto each = [&](const auto& visit) {
        for (int z = lowest.z; z <= highest.z; ++z)
            for (int y = lowest.y; y <= highest.y; ++y)
                for (int x = lowest.x; x <= highest.x; ++x) visit(kernels::probeSlot(volume, {x, y, z}));
    };
    float brightest = 0;
    each([&](int other) { brightest = std::max(brightest, lags[std::size_t(other)].level); });
    kernels::LagAround around = kernels::noLag();
    each([&](int other) { kernels::addLag(around, lags[std::size_t(other)], brightest, other == slot); });
    return around;
}

kernels::ProbeSight sightOf(std::span<const FixedRayDatum> rays, std::span<const glm::vec3> directions,
                            float maxDistance) {
    kernels::SightSum sum = kernels::noSight();
    for (std::size_t i = 0; i < rays.size(); ++i)
        kernels::addToSight(sum, directions[i], rays[i].direct, rays[i].bounced, rays[i].distance, maxDistance);
    return kernels::sightOf(sum);
}

kernels::ProbeSight sightOf(std::span<const RayDatum> ownRays) {
    kernels::SightSum sum = kernels::noSight();
    for (const RayDatum& d : ownRays) kernels::addOwnRayToSight(sum, d.radiance, d.distance);
    return kernels::sightOf(sum);
}

// Announced changes near a probe shorten its windows.
void limitWindows(const kernels::EventLimit& limit, kernels::ProbeFilter& filter, FrameHysteresis& kept) {
    filter.window = kernels::limitedWindow(filter.window, limit.irradianceKept);
    filter.visibilityWindow = kernels::limitedWindow(filter.visibilityWindow, limit.visibilityKept);
    kept.irradiance = kernels::limitedKept(kept.irradiance, limit.irradianceKept);
    kept.visibility = kernels::limitedKept(kept.visibility, limit.visibilityKept);
}

}  // namespace

void TemporalFilter::measureLag(const Context& context, const UpdateFrame& frame,
                                std::span<const kernels::Volume> volumes, std::span<const RayDatum> rayData,
                                std::span<const FixedRayDatum> fixedRays, const FieldStorage& storage) {
    const std::size_t rays = frame.directions.size(), fixed = frame.fixedDirections.size();
    m_sights.resize(frame.tasks.size());
    m_lags.resize(storage.filters.size());
    if (!frame.whole()) std::fill(m_lags.begin(), m_lags.end(), kernels::ProbeLag{});
    parallelFor(context, frame.tasks.size(), kProbesPerTask, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const ProbeTask& task = frame.tasks[i];
            m_sights[i] = fixed > 0 ? sightOf(fixedRays.subspan(i * fixed, fixed), frame.fixedDirections,
                                              volumes[task.volume].maxDistance)
                                    : sightOf(rayData.subspan(i * rays, rays));
            m_lags[task.slot] =
                kernels::lagHeard(kernels::probeLag(m_sights[i], kernels::unpackFilter(storage.filters[task.slot])),
                                  storage.backfaceShare[task.slot]);
        }
    });
}

std::span<ProbeStep> TemporalFilter::chooseWindows(const Context& context, const UpdateFrame& frame,
                                                   std::span<const kernels::Volume> volumes,
                                                   std::span<const RayDatum> rayData,
                                                   std::span<const FixedRayDatum> fixedRays, FieldStorage& storage) {
    measureLag(context, frame, volumes, rayData, fixedRays, storage);
    m_steps.resize(frame.tasks.size());
    parallelFor(context, frame.tasks.size(), kProbesPerTask, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const ProbeTask& task = frame.tasks[i];
            kernels::PackedProbeFilter& packed = storage.filters[task.slot];
            kernels::ProbeFilter filter = kernels::unpackFilter(packed);
            const kernels::LagAround around = lagAround(volumes[task.volume], m_lags, int(task.slot));
            const float lag = kernels::filterLag(around, filter.noise, filter.window, frame.fixedDirections.empty());
            const float own = kernels::ownLag(around, filter.noise, filter.window, frame.fixedDirections.empty());
            m_steps[i] = {{1.0f, 1.0f}, lag, 0.0f, own};
            if (!frame.settles) {
                filter.window = kernels::nextWindow(filter.window, filter.noise, lag, frame.longestWindow);
                filter.visibilityWindow = kernels::nextVisibilityWindow(filter.visibilityWindow, around.distance,
                                                                        frame.longestVisibilityWindow);
                m_steps[i].hysteresis = {kernels::keptBy(filter.window), kernels::keptBy(filter.visibilityWindow)};
            }
            if (frame.hasEvents()) limitWindows(frame.limitOf(task), filter, m_steps[i].hysteresis);
            packed.words[5] = kernels::packWindows(filter.window, filter.visibilityWindow);
        }
    });
    return m_steps;
}

std::span<ProbeStep> TemporalFilter::keepLessAtEvents(const UpdateFrame& frame, const FieldStorage& storage) {
    if (!frame.hasEvents()) return {};
    m_steps.resize(frame.tasks.size());
    for (std::size_t i = 0; i < frame.tasks.size(); ++i) {
        const ProbeTask& task = frame.tasks[i];
        const kernels::EventLimit limit = frame.limitOf(task);
        const bool isNew = kernels::isNew(storage.filters[task.slot]);
        m_steps[i] = {{isNew ? 0.0f : std::min(frame.hysteresis.irradiance, limit.irradianceKept),
                       isNew ? 0.0f : std::min(frame.hysteresis.visibility, limit.visibilityKept)},
                      0.0f,
                      0.0f,
                      0.0f};
    }
    return m_steps;
}

void TemporalFilter::advance(const Context& context, const UpdateFrame& frame, std::span<const kernels::Volume> volumes,
                             FieldStorage& storage) {
    if (frame.reportsProgress) m_progress.resize(storage.filters.size());
    parallelFor(context, m_steps.size(), kProbesPerTask, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const ProbeTask& task = frame.tasks[i];
            kernels::ProbeFilter filter = kernels::unpackFilter(storage.filters[task.slot]);
            const ProbeStep& step = m_steps[i];
            filter.noise = kernels::nextNoise(filter.noise, step.change, step.lag, filter.window,
                                              !frame.settles && kernels::isUnknown(filter));
            kernels::advanceFilter(filter, m_sights[i]);
            if (frame.reportsProgress)
                m_progress[task.slot] = kernels::probeProgress(step.ownLag, filter, storage.backfaceShare[task.slot]);
            const std::uint32_t number = std::uint32_t(kernels::probeNumber(volumes[task.volume], int(task.slot)));
            storage.filters[task.slot] = kernels::packFilter(filter, kernels::storageDither(frame.ditherSeed, number));
        }
    });
}

void forgetFilters(std::span<const ProbeTask> tasks, float window, FieldStorage& storage) {
    const kernels::PackedProbeFilter forgotten = kernels::forgottenFilter(window);
    for (const ProbeTask& task : tasks) storage.filters[task.slot] = forgotten;
}

std::size_t TemporalFilter::bytes() const noexcept {
    return m_sights.capacity() * sizeof(m_sights[0]) + m_lags.capacity() * sizeof(m_lags[0]) +
           m_steps.capacity() * sizeof(m_steps[0]) + m_progress.capacity() * sizeof(m_progress[0]);
}

}  // namespace probegi

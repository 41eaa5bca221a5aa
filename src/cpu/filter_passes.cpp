#include "cpu/filter_passes.h"

#include <algorithm>
#include <glm/common.hpp>

#include "core/parallel.h"
#include "kernels/volume/gpu_volume.h"
#include "kernels/volume/probe_cage.h"

namespace probegi {

namespace {

constexpr std::size_t kProbesPerTask = 256;

// The lag of a probe and the up to 26 around it.
kernels::LagAround lagAround(const GridDesc& grid, std::span<const kernels::ProbeLag> lags, int probe) {
    const glm::ivec3 at = kernels::gpuProbeCell(probe, grid.counts);
    const glm::ivec3 lowest = glm::max(at - 1, glm::ivec3(0)), highest = glm::min(at + 1, grid.counts - 1);
    const auto each = [&](const auto& visit) {
        for (int z = lowest.z; z <= highest.z; ++z)
            for (int y = lowest.y; y <= highest.y; ++y)
                for (int x = lowest.x; x <= highest.x; ++x) visit(kernels::probeNumber({x, y, z}, grid.counts));
    };
    float brightest = 0;
    each([&](int other) { brightest = std::max(brightest, lags[std::size_t(other)].level); });
    kernels::LagAround around = kernels::noLag();
    each([&](int other) { kernels::addLag(around, lags[std::size_t(other)], brightest, other == probe); });
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

}  // namespace

void TemporalFilter::measureLag(const Context& context, const UpdateFrame& frame, const FieldLayout& layout,
                                std::span<const RayDatum> rayData, std::span<const FixedRayDatum> fixedRays,
                                const FieldStorage& storage) {
    const std::size_t rays = layout.rays, fixed = frame.fixedDirections.size();
    m_sights.resize(layout.probes);
    m_lags.resize(layout.probes);
    parallelFor(context, layout.probes, kProbesPerTask, [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p) {
            m_sights[p] = fixed > 0
                              ? sightOf(fixedRays.subspan(p * fixed, fixed), frame.fixedDirections, layout.maxDistance)
                              : sightOf(rayData.subspan(p * rays, rays));
            m_lags[p] = kernels::lagHeard(kernels::probeLag(m_sights[p], kernels::unpackFilter(storage.filters[p])),
                                          storage.backfaceShare[p]);
        }
    });
}

std::span<ProbeStep> TemporalFilter::chooseWindows(const Context& context, const UpdateFrame& frame,
                                                   const FieldLayout& layout, std::span<const RayDatum> rayData,
                                                   std::span<const FixedRayDatum> fixedRays, FieldStorage& storage) {
    measureLag(context, frame, layout, rayData, fixedRays, storage);
    m_steps.resize(layout.probes);
    parallelFor(context, layout.probes, kProbesPerTask, [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p) {
            kernels::ProbeFilter filter = kernels::unpackFilter(storage.filters[p]);
            const kernels::LagAround around = lagAround(frame.desc.grid, m_lags, int(p));
            const float lag = kernels::filterLag(around, filter.noise, filter.window, frame.fixedDirections.empty());
            filter.window = kernels::nextWindow(filter.window, filter.noise, lag, frame.longestWindow);
            filter.visibilityWindow =
                kernels::nextVisibilityWindow(filter.visibilityWindow, around.distance, frame.longestVisibilityWindow);
            m_steps[p] = {{kernels::keptBy(filter.window), kernels::keptBy(filter.visibilityWindow)}, lag, 0.0f};
            storage.filters[p].words[5] = kernels::packWindows(filter.window, filter.visibilityWindow);
        }
    });
    return m_steps;
}

void TemporalFilter::advance(const Context& context, const UpdateFrame& frame, FieldStorage& storage) {
    parallelFor(context, m_steps.size(), kProbesPerTask, [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p) {
            kernels::ProbeFilter filter = kernels::unpackFilter(storage.filters[p]);
            const ProbeStep& step = m_steps[p];
            filter.noise =
                kernels::nextNoise(filter.noise, step.change, step.lag, filter.window, kernels::isUnknown(filter));
            kernels::advanceFilter(filter, m_sights[p]);
            storage.filters[p] =
                kernels::packFilter(filter, kernels::storageDither(frame.ditherSeed, std::uint32_t(p)));
        }
    });
}

void forgetFilters(FieldStorage& storage, float window) {
    std::fill(storage.filters.begin(), storage.filters.end(), kernels::forgottenFilter(window));
}

std::size_t TemporalFilter::bytes() const noexcept {
    return m_sights.capacity() * sizeof(m_sights[0]) + m_lags.capacity() * sizeof(m_lags[0]) +
           m_steps.capacity() * sizeof(m_steps[0]);
}

}  // namespace probegi

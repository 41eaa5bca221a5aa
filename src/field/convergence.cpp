#include "field/convergence.h"

#include <algorithm>
#include <cmath>

#include "field/layout.h"
#include "kernels/lookup/probe_query.h"
#include "kernels/shade/bounce.h"

namespace probegi {

namespace {

constexpr int kRegionSide = 4;  // probes
constexpr int kFirstCheck = 8;  // averaged updates
// A probe's light relative to the mean probe's: below the first it is ignored, below the second its noise counts as if
// it had that much (a leak into a sealed room stays noisy, but invisible).
constexpr double kBlack = 1e-4;
constexpr double kDim = 1e-2;
// Bounces are followed until the missing light is this share of the tolerance; the rest is for noise.
constexpr double kShareOfBounces = 0.5;
// An update extrapolates if that should leave at most this share of the missing light.
constexpr double kWorthStepping = 0.4;
// Upper bound on the relative standard deviation of a probe's change due to dithered storage, times the side of its
// map: half a step of a half float to the fifth power, from update to update, over the map's texels.
constexpr double kStorageNoise = 3.5e-3;
// Changes are significant from this many of these on.
constexpr double kSignificant = 3;
// A rate is known if its noise, two of these over a change, is below a quarter of its distance to 1.
constexpr double kNoiseInRate = 8;
// While light still spreads into dark rooms, rates are too large: older ones are discounted by this factor each time.
constexpr double kForgetSlowest = 0.7;
constexpr double kMaxRate = double(kernels::kMaxBounceAlbedo);

// Confidence bound on the worst region's noise, in standard errors. Noise that a region shares with all that it sees is
// fed back by the bounces; that is detected only if all regions share it (see checkAverage).
constexpr double kStandardErrors = 1.5;
// Squared standard error of the average, relative to an update's variance over n, for weights 3 / (k + 2).
constexpr double kAverageVariance = 9.0 / 5.0;

}  // namespace

Convergence::Convergence(const FieldDesc& desc, std::span<const kernels::Volume> volumes, float tolerance,
                         int maxUpdates)
    : m_volumes(volumes.begin(), volumes.end()),
      m_probeNoise(kStorageNoise / desc.irradianceTexels),
      m_tolerance(tolerance),
      m_maxUpdates(maxUpdates) {}

FrameHysteresis Convergence::kept() const noexcept {
    if (m_now.averaged > 0) {
        const float n = float(m_now.averaged);
        return {1.0f - 3.0f / (n + 2), 1.0f - 1.0f / (n + float(m_now.turned))};
    }
    if (m_now.updates < kTurnedUpdates) return {0.0f, 1.0f - 1.0f / float(m_now.updates + 1)};
    return {float(-m_now.ahead), 1.0f};
}

// At least half of the updates are for the average.
bool Convergence::lastBeforeAverage() const noexcept {
    return 2 * (m_now.updates + 1) >= m_maxUpdates;
}

void Convergence::advance(std::span<const float> brightness, std::span<const float> backfaceShares) {
    const bool observed = observes(), last = lastBeforeAverage();
    if (m_now.averaged == 0) m_now.turned = std::min(m_now.turned + 1, kTurnedUpdates);
    ++m_now.updates;
    if (observed) observe(brightness, backfaceShares);
    if (m_now.averaged > 0)
        ++m_now.averaged;
    else if (m_now.followed || last)
        m_now.averaged = 1;
}

void Convergence::observe(std::span<const float> brightness, std::span<const float> backfaceShares) {
    if (m_last.empty()) {
        makeRegions(backfaceShares);
        if (m_regions.empty()) {
            // No probe counts: all stand in walls, or no surface uses one.
            m_now.converged = true;
            m_now.remaining = 0;
        }
    } else if (!m_regions.empty()) {
        measureChanges(brightness, m_now.averaged > 0 ? kDim : kBlack);
        m_now.averaged > 0 ? checkAverage() : followBounces();
    }
    m_before = std::move(m_last);
    m_last.assign(brightness.begin(), brightness.end());
}

void Convergence::makeRegions(std::span<const float> backfaceShares) {
    for (const kernels::Volume& volume : m_volumes) {
        const glm::ivec3 blocks = (volume.counts + kRegionSide - 1) / kRegionSide;
        const std::size_t first = m_regions.size();
        m_regions.resize(first + std::size_t(blocks.x * blocks.y * blocks.z));
        for (int i = 0; i < kernels::volumeProbes(volume); ++i) {
            const int slot = volume.firstSlot + i;
            if (backfaceShares[std::size_t(slot)] > kernels::kInsideShare) continue;
            const glm::ivec3 block = kernels::probeCell(volume, slot) / kRegionSide;
            m_regions[first + std::size_t(block.x + blocks.x * (block.y + blocks.y * block.z))].probes.push_back(slot);
        }
    }
    std::erase_if(m_regions, [](const Region& region) { return region.probes.empty(); });
}

void Convergence::measureChanges(std::span<const float> now, double floor) {
    double mean = 0, probes = 0;
    for (const Region& region : m_regions) {
        for (const int probe : region.probes) mean += now[std::size_t(probe)];
        probes += double(region.probes.size());
    }
    mean /= std::max(probes, 1.0);
    for (Region& region : m_regions) {
        region.change = region.earlier = 0;
        region.counting = 0;
        for (const int probe : region.probes) {
            const auto p = std::size_t(probe);
            if (!(now[p] > kBlack * mean)) continue;
            const double light = std::max(0.5 * (double(now[p]) + m_last[p]), floor * mean);
            region.change += (double(now[p]) - m_last[p]) / light;
            if (!m_before.empty()) region.earlier += (double(m_last[p]) - m_before[p]) / light;
            ++region.counting;
        }
        if (!region.counts()) continue;
        region.change /= region.counting;
        region.earlier /= region.counting;
    }
}

double Convergence::storageNoise(const Region& region) const noexcept {
    return m_probeNoise / std::sqrt(double(std::max(region.counting, 1)));
}

// Rate of two successive changes, each with storage noise `noise`.
double Convergence::rateOf(double change, double earlier, double noise) const noexcept {
    const double known = 1 - kNoiseInRate * noise / std::max(std::abs(earlier), 1e-30);
    if (known <= 0) return m_now.rate;
    const double rate = std::clamp(change / earlier, 0.0, kMaxRate);
    return rate <= known ? rate : std::min(rate, std::max(known, m_now.rate));
}

void Convergence::measureRate() noexcept {
    double now = 0, earlier = 0, noise2 = 0;
    for (const Region& region : m_regions) {
        now += std::abs(region.change);
        earlier += std::abs(region.earlier);
        noise2 += std::pow(storageNoise(region), 2);
    }
    m_now.rate = rateOf(now, earlier, std::sqrt(noise2));
    m_now.slowest = std::max(m_now.rate / (1 - m_now.rate), kForgetSlowest * m_now.slowest);
}

// A region's distance from its limit, in units of its last change.
double Convergence::updatesAhead(const Region& region) const noexcept {
    const double rate = rateOf(region.change, region.earlier, storageNoise(region));
    return rate / (1 - rate);
}

void Convergence::followBounces() {
    m_now.ahead = 0;
    if (++m_now.differences < 2) return;
    measureRate();
    // One number of steps for all regions, by least squares of the remainder.
    double product = 0, square = 0, left = 0;
    m_now.missing = 0;
    for (const Region& region : m_regions) {
        const double seen = std::max(std::abs(region.change) - kSignificant * storageNoise(region), 0.0);
        const double ahead = updatesAhead(region);
        product += seen * seen * ahead;
        square += seen * seen;
        m_now.missing = std::max(m_now.missing, seen * std::max(ahead, m_now.slowest));
    }
    const double ahead = square > 0 ? product / square : 0;
    for (const Region& region : m_regions) {
        const double seen = std::max(std::abs(region.change) - kSignificant * storageNoise(region), 0.0);
        left = std::max(left, seen * std::abs(ahead - updatesAhead(region)));
    }
    m_now.remaining = float(m_now.missing);
    m_now.followed = m_now.missing < kShareOfBounces * m_tolerance;
    if (!m_now.followed && m_now.differences >= 3 && ahead > 1 && left < kWorthStepping * m_now.missing) {
        m_now.ahead = ahead;
        m_now.differences = -1;  // the differences of the next two updates are meaningless
    }
}

void Convergence::checkAverage() {
    const double n = m_now.averaged, weight = 3 / (n + 2);
    double worst = 0, common = 0, counting = 0;
    for (Region& region : m_regions) {
        if (!region.counts()) continue;
        common += region.change;
        ++counting;
        if (m_now.averaged == 1) continue;  // the average is still a single update
        // The update against the average of its predecessors, which has noise of its own.
        region.residual2 += std::pow(region.change / weight, 2) / (1 + kAverageVariance / (n - 1));
        worst = std::max(worst, region.residual2 / (n - 1));
    }
    m_common.push_back((m_common.empty() ? 0.0 : m_common.back()) + common / std::max(counting, 1.0));
    if (m_now.averaged < kFirstCheck) return;
    // The part common to all regions is what bounces feed back: it has fallen by this factor since half as many
    // updates.
    const double power = 3 / (1 + m_now.slowest);
    const double lately = std::abs(m_common.back() - m_common[m_common.size() / 2 - 1]);
    m_now.remaining = float(kStandardErrors * std::sqrt(kAverageVariance * worst / n) +
                            lately / (std::pow(2.0, power) - 1) + m_now.missing * std::pow(n, -power));
    m_now.converged = m_now.remaining < m_tolerance;
}

}  // namespace probegi

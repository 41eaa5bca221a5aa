#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "field/hysteresis.h"
#include "kernels/volume/volume.h"

namespace probegi {

/// State of Field::converge: how much of the old values the next update keeps, and whether every region has converged.
///
/// First the bounces. Every update replaces the previous light and uses the same rays, so that only the bounces'
/// missing share changes, shrinking by a factor each time: its limit follows from two differences (Aitken). If that
/// would take many updates, one extrapolates, with a negative weight of the old light. Then the noise. Rays rotate
/// again, and update n of the average has weight 3 / (n + 2): the noise of the single ray set left in the bounces
/// decays like 1 / n^3 while noise falls like 1 / sqrt(n), with a standard error estimated from the updates' scatter.
///
/// Regions are blocks of 4 x 4 x 4 probes, and changes are relative to each probe's own light, so that a dark room
/// counts as much as a sunlit one. Probes in walls and almost unlit probes are ignored.
class Convergence {
public:
    Convergence(const FieldDesc& desc, std::span<const kernels::Volume> volumes, float tolerance, int maxUpdates);

    /// Shares of the old values that the next update keeps; a negative one extrapolates beyond the new values.
    FrameHysteresis kept() const noexcept;
    /// Whether the next update's rays are rotated relative to the last one's.
    bool turnsRays() const noexcept { return m_now.averaged > 0 || m_now.updates < kTurnedUpdates; }
    /// Whether advance() needs the probes after the next update.
    bool observes() const noexcept { return m_now.updates + 1 >= kTurnedUpdates; }
    /// Call after every update. If observes() was true: mean stored radiance of every probe, and the share of its rays
    /// that hit backfaces; else empty.
    void advance(std::span<const float> brightness, std::span<const float> backfaceShares);

    int updates() const noexcept { return m_now.updates; }
    bool converged() const noexcept { return m_now.converged; }
    /// Whether the probes hold an average.
    bool averages() const noexcept { return m_now.averaged > 1; }
    /// Largest estimate of a region's remaining relative error; infinite while unknown.
    float remaining() const noexcept { return m_now.remaining; }

    /// All that the updates so far have changed, as words, and from them: false if they are not of the same probes.
    void save(std::vector<std::uint32_t>& state) const;
    bool restore(std::span<const std::uint32_t> state);

private:
    /// Updates before the bounces are followed, with rotating rays, so that the stored distances use more than one set.
    static constexpr int kTurnedUpdates = 3;

    struct Region {
        std::vector<int> probes;  ///< candidates
        double residual2 = 0;     ///< sum over averaged updates of (update - average)^2, relative
        double change = 0;        ///< relative, mean over the counted probes, since the last update
        double earlier = 0;       ///< the same from the update before to the last one
        int counting = 0;         ///< probes that count
        bool counts() const { return counting > 0; }
    };
    bool lastBeforeAverage() const noexcept;
    bool isSound() const noexcept;
    void observe(std::span<const float> brightness, std::span<const float> backfaceShares);
    void makeRegions(std::span<const float> backfaceShares);
    /// `floor`: lower limit of the light that changes are relative to, in shares of the mean probe's.
    void measureChanges(std::span<const float> now, double floor);
    void followBounces();
    void checkAverage();
    double storageNoise(const Region& region) const noexcept;
    double rateOf(double change, double earlier, double noise) const noexcept;
    void measureRate() noexcept;
    double updatesAhead(const Region& region) const noexcept;

    std::vector<kernels::Volume> m_volumes;
    double m_probeNoise;
    float m_tolerance;
    int m_maxUpdates;
    struct Numbers {
        int updates = 0;
        int turned = 0;       ///< ray sets in the distances before the average
        int averaged = 0;     ///< updates of the average, the next one included; 0 while bounces are followed
        int differences = 0;  ///< between plain updates, since the last extrapolation
        double ahead = 0;     ///< how many of its changes the next update extrapolates
        double rate = 0;      ///< factor by which changes shrink from update to update
        double slowest = 0;   ///< slowest recent bounces: how many of their last changes are still missing
        /// Missing share of the light in the worst region, from missing bounces, before the average.
        double missing = std::numeric_limits<double>::infinity();
        bool followed = false;  ///< whether the bounces were followed far enough
        bool converged = false;
        float remaining = std::numeric_limits<float>::infinity();
    };
    Numbers m_now;
    std::vector<Region> m_regions;
    std::vector<double> m_common;  ///< common part of all regions' changes, cumulative up to each update
    std::vector<float> m_last;     ///< brightness after the last update
    std::vector<float> m_before;   ///< and the one before
};

}  // namespace probegi

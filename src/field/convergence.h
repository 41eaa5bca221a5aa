#pragma once

#include <limits>
#include <span>
#include <vector>

#include "field/hysteresis.h"
#include "kernels/volume/volume.h"

namespace probegi {

/// The books of Field::converge: what the coming update keeps of the old values, and whether every region has arrived.
///
/// First the bounces. Every update replaces the light of the last one and has the same rays, so that nothing changes
/// but the bounces' missing share, which shrinks by a factor each time: what it will come to follows from two
/// differences (Aitken). Where that would take many updates, one steps as far ahead: it keeps less than nothing of the
/// old light. Then the noise. Rays turn again, and update n of the average has weight 3 / (n + 2): what the single ray
/// set's noise left in the bounces is forgotten like 1 / n^3 while noise falls like 1 / sqrt(n), at a standard error
/// that the updates' own scatter tells.
///
/// Regions are blocks of 4 x 4 x 4 probes, and changes are relative to each probe's own light, so that a dark room
/// counts as much as a sunlit one. Probes in walls and probes that next to no light reaches do not count.
class Convergence {
public:
    Convergence(const FieldDesc& desc, float tolerance, int maxUpdates);

    /// Shares of the old values that survive the coming update; a negative one steps beyond the new values.
    FrameHysteresis kept() const noexcept;
    /// Whether the coming update's rays are turned against those of the last one.
    bool turnsRays() const noexcept { return m_averaged > 0 || m_updates < kTurnedUpdates; }
    /// Whether advance() wants to see the probes after the coming update.
    bool observes() const noexcept { return m_updates + 1 >= kTurnedUpdates; }
    /// After every update. Where observes() was true: mean stored radiance of every probe, and the share of its rays
    /// that hit backfaces; else empty.
    void advance(std::span<const float> brightness, std::span<const float> backfaceShares);

    int updates() const noexcept { return m_updates; }
    bool converged() const noexcept { return m_converged; }
    /// Largest estimate of what a region's light still lacks or has too much, relative; infinite while unknown.
    float remaining() const noexcept { return m_remaining; }

private:
    /// Updates before the bounces are followed: their rays turn, so that the stored distances rest on more than one
    /// set.
    static constexpr int kTurnedUpdates = 3;

    struct Region {
        std::vector<int> probes;  ///< that may count
        double residual2 = 0;     ///< sum over averaged updates of (update - average)^2, relative
        double change = 0;        ///< relative, mean over the probes that count, since the last update
        double earlier = 0;       ///< the same from the update before to the last one
        int counting = 0;         ///< probes that count
        bool counts() const { return counting > 0; }
    };
    bool lastBeforeAverage() const noexcept;
    void observe(std::span<const float> brightness, std::span<const float> backfaceShares);
    void makeRegions(std::span<const float> backfaceShares);
    /// `floor`: light that the changes of darker probes are relative to, in shares of the mean probe's.
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
    int m_updates = 0;
    int m_turned = 0;       ///< ray sets in the distances before the average
    int m_averaged = 0;     ///< updates of the average, the coming one included; 0 while bounces are followed
    int m_differences = 0;  ///< between plain updates, since the last one that stepped ahead
    double m_ahead = 0;     ///< how many of its changes the coming update steps ahead
    double m_rate = 0;      ///< by which changes shrink from update to update
    double m_slowest = 0;   ///< the slowest bounces lately: how many of their last changes are still to come
    /// Of the light, for want of bounces, in the worst region, before the average.
    double m_missing = std::numeric_limits<double>::infinity();
    bool m_followed = false;  ///< whether the bounces were followed far enough
    bool m_converged = false;
    float m_remaining = std::numeric_limits<float>::infinity();
    std::vector<Region> m_regions;
    std::vector<double> m_common;  ///< what all regions have in common of their changes, summed up to each update
    std::vector<float> m_last;     ///< brightness after the last update
    std::vector<float> m_before;   ///< and the one before
};

}  // namespace probegi

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>

#include "measure/input_checks.h"
#include "measure/luminance.h"
#include "probegi/measure.h"

namespace probegi {

namespace {

constexpr double kWallShare = 0.25;  ///< of backfaces among a probe's rays: the probe stands in a wall
constexpr int kWallRays = 64;
constexpr double kDarkShare = 1e-3;   ///< of the mean irradiance
constexpr double kNoiseLimit = 0.15;  ///< standard error over mean

constexpr std::array<glm::vec3, 6> kAxes{glm::vec3(1, 0, 0),  glm::vec3(-1, 0, 0), glm::vec3(0, 1, 0),
                                         glm::vec3(0, -1, 0), glm::vec3(0, 0, 1),  glm::vec3(0, 0, -1)};

/// Probes in an order any beginning of which is spread evenly (golden ratio sequence), without repetition.
std::vector<int> spreadProbes(int count, int wanted) {
    std::vector<int> probes;
    std::set<int> seen;
    for (int i = 0; i < 4 * wanted && int(probes.size()) < wanted; ++i) {
        const double position = std::fmod((i + 0.5) * (std::numbers::phi - 1), 1.0);
        const int probe = std::min(int(position * count), count - 1);
        if (seen.insert(probe).second) probes.push_back(probe);
    }
    return probes;
}

Result<bool> standsInWall(const Tracer& tracer, glm::vec3 position) {
    std::vector<Ray> rays(kWallRays);
    for (int i = 0; i < kWallRays; ++i) {
        const double z = 1 - (2.0 * i + 1) / kWallRays;
        const double radius = std::sqrt(1 - z * z);
        const double angle = 2 * std::numbers::pi * std::fmod(i * std::numbers::phi, 1.0);
        rays[i].origin = position;
        rays[i].direction = glm::vec3(radius * std::cos(angle), radius * std::sin(angle), z);
    }
    std::vector<Hit> hits(kWallRays);
    std::vector<Surface> surfaces(kWallRays);
    if (auto hit = tracer.closestHits(rays, hits); !hit) return hit.error();
    if (auto found = tracer.surfaces(rays, hits, surfaces); !found) return found.error();
    int backs = 0;
    for (int i = 0; i < kWallRays; ++i) backs += hits[i].valid() && surfaces[i].backface;
    return backs > kWallShare * kWallRays;
}

ProbeTruth::Probe sumOverAxes(int probe, std::span<const ReferenceIrradiance> axes) {
    ProbeTruth::Probe sum{probe, 0, 0};
    double variance = 0;
    for (const ReferenceIrradiance& axis : axes) {
        sum.irradiance += luminance(axis.mean);
        variance += std::pow(luminance(axis.standardError), 2);
    }
    sum.standardError = std::sqrt(variance);
    return sum;
}

/// Moves the probes that count into `truth` and counts the others.
void keepMeaningful(const std::vector<ProbeTruth::Probe>& all, ProbeTruth& truth) {
    double mean = 0;
    for (const auto& probe : all) mean += probe.irradiance / double(std::max<std::size_t>(all.size(), 1));
    std::vector<double> noise;
    for (const auto& probe : all) {
        if (!(probe.irradiance > kDarkShare * mean) || probe.standardError > kNoiseLimit * probe.irradiance) {
            ++truth.dark;
            continue;
        }
        truth.probes.push_back(probe);
        noise.push_back(probe.standardError / probe.irradiance);
    }
    truth.noise = percentiles(std::move(noise)).median;
}

/// Up to `wanted` probes that stand in no wall; counts the others.
Result<std::vector<int>> openProbes(const Tracer& tracer, const VolumeDesc& grid, int wanted, ProbeTruth& truth) {
    std::vector<int> probes;
    for (const int probe : spreadProbes(probeCount(grid), 4 * wanted)) {
        if (int(probes.size()) == wanted) break;
        const auto inWall = standsInWall(tracer, probePosition(grid, probe));
        if (!inWall) return inWall.error();
        if (*inWall)
            ++truth.inWalls;
        else
            probes.push_back(probe);
    }
    return probes;
}

}  // namespace

Result<ProbeTruth> traceProbeTruth(const Tracer& tracer, const PathTracer& pathTracer, const VolumeDesc& grid,
                                   int maxProbes, int samples, bool diffuseOnly) {
    return withinMemory("trace the truth at the probes", [&]() -> Result<ProbeTruth> {
        ProbeTruth truth;
        const auto probes = openProbes(tracer, grid, maxProbes, truth);
        if (!probes) return probes.error();
        std::vector<FieldQuery> points;
        for (const int probe : *probes)
            for (const glm::vec3& axis : kAxes) points.push_back({probePosition(grid, probe), axis, axis});
        const auto irradiance = pathTracer.irradiance(points, samples, 1, diffuseOnly);
        if (!irradiance) return irradiance.error();

        std::vector<ProbeTruth::Probe> all;
        for (std::size_t i = 0; i < probes->size(); ++i)
            all.push_back(sumOverAxes((*probes)[i], std::span(*irradiance).subspan(i * kAxes.size(), kAxes.size())));
        keepMeaningful(all, truth);
        return truth;
    });
}

std::vector<double> probeRatios(const FieldSnapshot& snapshot, const ProbeTruth& truth) {
    std::vector<double> ratios;
    for (const ProbeTruth::Probe& probe : truth.probes) {
        double irradiance = 0;
        for (const glm::vec3& axis : kAxes)
            irradiance += luminance(snapshot.probeIrradiance(snapshot.slotOf(0, probe.index), axis));
        ratios.push_back(irradiance / probe.irradiance);
    }
    return ratios;
}

}  // namespace probegi

#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "scene_setup.h"

namespace probegi::tool {

/// What `probegi bench` measures, and how many times.
struct BenchPlan {
    int threads = 2;
    int raysPerProbe = 144;
    int rounds = 5;  ///< measured; one more precedes them
    int width = 1920, height = 1080;
    struct Volume {
        glm::ivec3 counts{0};
        int raysPerProbe = 32;
    };
    std::vector<Volume> growth;  ///< of the growth table; few rays per probe, since the largest has a million
};

/// Wall-clock milliseconds of everything that is compared, measured one after the other within a round, so that a
/// machine that is slow for a while slows all of them.
struct BenchRound {
    double floor = 0;           ///< raw Embree, the rays of the update
    double robustFloor = 0;     ///< the same with the flag that ProbeGI's tracer sets
    UpdateTimes update;         ///< all threads
    double updateAlone = 0;     ///< whole update on one thread
    double updateOfActive = 0;  ///< whole update of a field with probe states (section 6)
    double query = 0;           ///< the field at every point of the picture
    double fallbacks = 0;       ///< of them, looked up beyond their eight probes (Field::fallbackQueries)
    double primaryFloor = 0;    ///< raw Embree, the rays of the picture
    double picture = 0;
};

struct BenchGrowth {
    int probes = 0;
    int rays = 0;
    std::vector<double> ms;  ///< of one update, by round
};

struct BenchResult {
    int threads = 0;  ///< as requested
    int probes = 0, raysPerProbe = 0;
    int activeProbes = 0;                   ///< of the field with probe states
    int fixedRays = 0;                      ///< per probe, in addition: the temporal filter's
    std::size_t triangles = 0, points = 0;  ///< of the scene; hit by the picture's rays
    std::size_t pixels = 0;
    std::size_t persistentBytes = 0, scratchBytes = 0;
    std::vector<BenchRound> rounds;
    std::vector<BenchGrowth> growth;

    /// Rays of one update.
    double rays() const { return double(probes) * (raysPerProbe + fixedRays); }
    /// Median of `value` over the rounds.
    double median(const std::function<double(const BenchRound&)>& value) const;
};

/// Called before each round with what is measured, the round's number (0: warm-up) and the number of rounds.
using BenchProgress = std::function<void(std::string_view, int, int)>;

/// Errors: those of the measured passes.
Result<BenchResult> runBench(const LoadedSetup& setup, const BenchPlan& plan, const BenchProgress& progress);

}  // namespace probegi::tool

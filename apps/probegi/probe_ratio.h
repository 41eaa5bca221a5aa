#pragma once

#include <vector>

#include "probegi/field.h"
#include "probegi/reference.h"

namespace probegi::tool {

/// The truth at a spread of a grid's probes: E summed over the six axis directions, as luminance.
struct ProbeTruth {
    struct Probe {
        int index = 0;
        double irradiance = 0;
        double standardError = 0;
    };
    std::vector<Probe> probes;  ///< those that count
    int inWalls = 0;            ///< left out: more than a quarter of what they see are backs of walls
    int dark = 0;               ///< left out: too little light, or too noisy a truth, for a ratio to mean anything
    double noise = 0;           ///< median of standardError / irradiance over the probes that count
};

/// Path traces at up to `maxProbes` probes in free space, `samples` paths a direction. Errors: those of both
/// tracers.
Result<ProbeTruth> traceProbeTruth(const Tracer& tracer, const PathTracer& pathTracer, const VolumeDesc& grid,
                                   int maxProbes, int samples, bool diffuseOnly);

struct Percentiles {
    double low = 0;  ///< 5th
    double median = 0;
    double high = 0;  ///< 95th
};
Percentiles percentiles(std::vector<double> values);  ///< 0 of nothing

/// Field over truth, probe by probe.
std::vector<double> probeRatios(const Field& field, const ProbeTruth& truth);

}  // namespace probegi::tool

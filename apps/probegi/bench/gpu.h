#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "backend.h"
#include "bench/rounds.h"

namespace probegi::tool {

/// One round on a Vulkan device, milliseconds.
struct GpuBenchRound {
    std::vector<std::pair<std::string, double>> passes;  ///< by the device's clock, in order; empty: it has none
    double update = 0;                                   ///< wall clock, with recording, submitting and waiting
    double query = 0;                                    ///< the same, also with the transfer of points and results
    double picture = 0;                                  ///< the same

    /// Sum over the passes that satisfy `chosen`.
    double sum(const std::function<bool(const std::string&)>& chosen) const;
};

struct GpuBenchResult {
    std::string device, driver, api, type;  ///< as DeviceInfo has them
    std::string tracer;                     ///< "BVH" or "ray query"
    int probes = 0, raysPerProbe = 0;
    int width = 0, height = 0;              ///< of the picture
    std::size_t triangles = 0, points = 0;  ///< of the scene; hit by the picture's rays
    std::size_t persistentBytes = 0, scratchBytes = 0;
    std::vector<GpuBenchRound> rounds;

    double median(const std::function<double(const GpuBenchRound&)>& value) const;
};

/// Errors: those of the measured passes; unsupported in a program built without Vulkan.
Result<GpuBenchResult> runGpuBench(const LoadedSetup& setup, const BackendOptions& backend, const BenchPlan& plan,
                                   const BenchProgress& progress);

/// Passes and their sums as a table.
std::string gpuBenchMarkdown(const GpuBenchResult& result, const std::string& sceneName);

std::string gpuBenchJson(const GpuBenchResult& result, const std::string& sceneName);

}  // namespace probegi::tool

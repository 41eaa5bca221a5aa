#include "reference/irradiance_estimate.h"

#include <cmath>

#include "core/parallel.h"
#include "core/progress.h"
#include "reference/path_batch.h"
#include "reference/running_stats.h"

namespace probegi {

namespace {

constexpr std::size_t kPathsPerChunk = 1024;

/// One chunk's result for one point.
struct Part {
    std::size_t point = 0;
    RunningStats stats;
};

/// Paths are numbered point by point; a chunk is a range of them, so it may hold many points or a share of one.
Result<std::vector<Part>> traceChunk(const Transport& transport, const PathSettings& settings,
                                     std::span<const FieldQuery> points, std::size_t samples, std::uint64_t seed,
                                     std::size_t begin, std::size_t end) {
    std::vector<FieldQuery> starts;
    std::vector<Random> random;
    for (std::size_t path = begin; path < end; ++path) {
        starts.push_back(points[path / samples]);
        random.emplace_back(seed, path);
    }
    std::vector<PathResult> results(end - begin);
    if (auto traced = PathBatch(transport, settings).fromPoints(starts, random, results); !traced)
        return traced.error();

    std::vector<Part> parts;
    for (std::size_t path = begin; path < end; ++path) {
        const std::size_t point = path / samples;
        if (parts.empty() || parts.back().point != point) parts.push_back({point, {}});
        const glm::vec3 e = results[path - begin].irradiance;
        parts.back().stats.add(std::isfinite(e.x + e.y + e.z) ? glm::dvec3(e) : glm::dvec3(0.0));
    }
    return parts;
}

}  // namespace

Result<std::vector<ReferenceIrradiance>> estimateIrradiance(const Context& context, const Transport& transport,
                                                            const PathSettings& settings,
                                                            std::span<const FieldQuery> points, int samples,
                                                            std::uint64_t seed) {
    const std::size_t total = points.size() * std::size_t(samples);
    std::vector<std::vector<Part>> chunks((total + kPathsPerChunk - 1) / kPathsPerChunk);
    Progress progress(context, "reference irradiance", double(total));
    const auto trace = [&](std::size_t begin, std::size_t end) -> Result<void> {
        if (progress.cancelled()) return {};
        auto chunk = traceChunk(transport, settings, points, std::size_t(samples), seed, begin, end);
        if (!chunk) return chunk.error();
        chunks[begin / kPathsPerChunk] = std::move(*chunk);
        progress.advance(double(end - begin));
        return {};
    };
    if (auto traced = tryParallelFor(context, total, kPathsPerChunk, trace); !traced) return traced.error();
    if (progress.cancelled()) return fail(ErrorCode::cancelled, "The reference irradiance was cancelled.");

    // Merged in path order, independent of threads.
    std::vector<RunningStats> stats(points.size());
    for (const auto& parts : chunks)
        for (const Part& part : parts) stats[part.point].merge(part.stats);
    std::vector<ReferenceIrradiance> out(points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
        out[i] = {glm::vec3(stats[i].mean), glm::vec3(stats[i].standardError())};
    return out;
}

}  // namespace probegi

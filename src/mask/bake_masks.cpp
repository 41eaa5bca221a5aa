#include "mask/mask_bake.h"

#include <chrono>
#include <cmath>
#include <new>

#include "core/sentence.h"
#include "field/layout.h"
#include "field/masks_impl.h"

namespace probegi {

namespace {

/// Texels that a bake may hold: a byte each, twice.
constexpr double kMostTexels = double(std::uint64_t(1) << 32);
/// Words that look-ups reach with 31 bits.
constexpr std::size_t kMostWords = std::size_t(1) << 31;

Result<void> outOfRange(const char* name, double value, double lowest, double highest) {
    return fail(ErrorCode::invalidArgument, sentence(name, " is ", value, "; it must be ", lowest, " to ", highest));
}

Result<void> checkPlaces(const FieldDesc& field, const MaskDesc& d) {
    for (const VolumeDesc& volume : field.volumes)
        if (volume.tracksCamera)
            return fail(ErrorCode::invalidArgument, "volumes that track a camera scroll, which masks do not");
    const std::size_t probes = std::size_t(probeCount(field));
    if (!d.positions.empty() && d.positions.size() != probes)
        return fail(ErrorCode::invalidArgument, sentence("there are ", d.positions.size(), " positions for ", probes,
                                                         " probes; give all of them, or none"));
    for (const glm::vec3& p : d.positions)
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
            return fail(ErrorCode::invalidArgument, "a probe's position is not finite");
    for (const Bounds& b : d.occluders)
        for (int axis = 0; axis < 3; ++axis)
            if (std::isnan(b.lower[axis]) || std::isnan(b.upper[axis]))
                return fail(ErrorCode::invalidArgument, "an occluder's bounds are not numbers");
    return {};
}

Result<void> checkDesc(const FieldDesc& field, const MaskDesc& d) {
    if (auto ok = validateFieldDesc(field); !ok) return ok;
    if (d.clusters < 1 || d.clusters > 8) return outOfRange("clusters", d.clusters, 1, 8);
    if (d.factor < 2 || d.factor > 16) return outOfRange("factor", d.factor, 2, 16);
    if (d.sweeps < 0 || d.sweeps > 100'000) return outOfRange("sweeps", d.sweeps, 0, 100'000);
    if (!(d.sparsity >= 0 && d.sparsity <= 1)) return outOfRange("sparsity", double(d.sparsity), 0, 1);
    return checkPlaces(field, d);
}

/// Seconds since the last call.
class Stopwatch {
public:
    double lap() {
        const auto now = std::chrono::steady_clock::now();
        const double seconds = std::chrono::duration<double>(now - m_last).count();
        m_last = now;
        return seconds;
    }

private:
    std::chrono::steady_clock::time_point m_last = std::chrono::steady_clock::now();
};

Result<Clusters> findClusters(const Context& context, const ProbeGraph& graph, const MaskDesc& desc,
                              MaskReport& report) {
    const bool parity = desc.clusters == 8;
    Clusters start = parity ? parityClusters(graph) : convexDivision(graph, desc.clusters);
    report.startLoss = colouringLoss(graph, start, desc.sparsity);
    // Nothing is better than no loss.
    auto found = parity ? Result<Clusters>(std::move(start))
                        : annealColours(context, graph, std::move(start),
                                        {desc.clusters, desc.sweeps, desc.sparsity, desc.seed});
    if (found) report.loss = colouringLoss(graph, *found, desc.sparsity);
    return found;
}

void describe(const MaskTexels& texels, const MaskCells& cells, std::size_t cellTexels, MaskReport& report) {
    const MaskSums& sums = texels.sums;
    report.cells = cells.count;
    report.blocked = cells.blocked.size();
    report.residual = sums.leaking > 0 ? sums.residual / sums.leaking : 0;
    const double looked = double(texels.texels.size());
    report.meanClusters = looked > 0 ? double(sums.seenClusters) / looked : 0;
    report.blindTexels = double(sums.blind) / double(cells.count * cellTexels);
}

}  // namespace

MaskBake::MaskBake(const FieldDesc& field, const MaskDesc& d)
    : volumes(field.volumes), desc(d), cubes(d.factor, d.clusters <= 4) {
    desc.positions = {}, desc.occluders = {};
}

std::shared_ptr<const Masks> MaskBake::publish() {
    const std::size_t slots = clusters.size();
    const auto firstWord = [&](std::uint32_t cube) { return std::uint32_t(2 * slots + cube * cubes.cubeWords()); };
    auto impl = std::make_unique<Masks::Impl>();
    std::vector<std::uint32_t>& words = impl->words;
    words.resize(2 * slots);
    for (std::size_t slot = 0; slot < slots; ++slot) {
        words[2 * slot] = firstWord(openCube);
        words[2 * slot + 1] = std::uint32_t(clusters[slot]) | std::uint32_t(sight.links[slot]) << 8;
    }
    for (std::size_t c = 0; c < cells.blocked.size(); ++c)
        words[2 * std::size_t(cells.blocked[c].slot[0])] = firstWord(cubeOf[c]);
    words.insert(words.end(), cubes.words().begin(), cubes.words().end());
    report.cubes = cubes.count();
    report.bytes = words.size() * sizeof(std::uint32_t);
    impl->volumes = volumes;
    impl->clusters = desc.clusters;
    impl->factor = desc.factor;
    impl->report = report;
    return std::make_shared<const Masks>(std::move(impl));
}

Result<MaskBake> bakeMaskParts(const Context& context, const Tracer& tracer, const FieldDesc& field,
                               const MaskDesc& desc) {
    if (auto ok = checkDesc(field, desc); !ok) return ok.error();
    const std::size_t cellTexels = std::size_t(desc.factor * desc.factor * desc.factor);
    MaskBake bake(field, desc);
    MaskReport& report = bake.report;
    Stopwatch watch;
    bake.cells = findMaskCells(field, desc, tracer.bounds());
    if (double(bake.cells.blocked.size()) * double(cellTexels) > kMostTexels) return noMemoryForMasks();
    auto sight = traceProbeSight(context, tracer, field, bake.cells, desc.factor);
    if (!sight) return sight.error();
    bake.sight = std::move(*sight);
    bake.graph.emplace(context, field, bake.cells, bake.sight, desc.factor);
    report.visibilitySeconds = watch.lap();
    auto clusters = findClusters(context, *bake.graph, desc, report);
    if (!clusters) return clusters.error();
    bake.clusters = std::move(*clusters);
    report.clusterSeconds = watch.lap();
    const auto texels = solveMasks(context, tracer, bake.cells, bake.sight, bake.clusters, {desc.factor, desc.strict});
    if (!texels) return texels.error();
    report.maskSeconds = watch.lap();
    for (std::size_t c = 0; c < bake.cells.blocked.size(); ++c)
        bake.cubeOf.push_back(bake.cubes.add(std::span(texels->texels).subspan(c * cellTexels, cellTexels)));
    bake.openCube = bake.cubes.add(std::vector<std::uint32_t>(cellTexels, kOpenTexel));
    if (2 * bake.clusters.size() + bake.cubes.words().size() > kMostWords) return noMemoryForMasks();
    report.compressSeconds = watch.lap();
    describe(*texels, bake.cells, cellTexels, report);
    report.rays = bake.sight.rays + texels->sums.rays;
    report.denseBytes = bake.cells.count * cellTexels * std::size_t(desc.clusters);
    return bake;
}

Error noMemoryForMasks() {
    return {ErrorCode::outOfMemory, "no memory to bake masks; use a smaller factor or fewer probes"};
}

Result<std::shared_ptr<const Masks>> bakeMasks(const Context& context, const Tracer& tracer, const FieldDesc& field,
                                               const MaskDesc& desc) try {
    auto bake = bakeMaskParts(context, tracer, field, desc);
    if (!bake) return bake.error();
    return bake->publish();
} catch (const std::bad_alloc&) {
    return noMemoryForMasks();
}

}  // namespace probegi

#include "mask/probe_sight.h"

#include <atomic>
#include <glm/geometric.hpp>

#include "core/parallel.h"
#include "core/progress.h"

namespace probegi {

namespace {

constexpr std::size_t kLinkGrain = 1024;

/// One cell's rays and what they met, kept from cell to cell.
struct CellRays {
    std::vector<Ray> rays;
    std::vector<std::uint8_t> blocked;
};

Result<void> seeCell(const Tracer& tracer, const MaskCell& cell, int factor, CellRays& work,
                     std::span<std::uint8_t> seen) {
    const std::size_t texels = seen.size();
    work.rays.clear();
    for (const glm::vec3& probe : cell.probe)
        for (int z = 0; z < factor; ++z)
            for (int y = 0; y < factor; ++y)
                for (int x = 0; x < factor; ++x)
                    work.rays.push_back(sightRay(probe, cell.texel(x, y, z), kReachBeyond * cell.texelSize));
    work.blocked.resize(work.rays.size());
    if (auto traced = tracer.occluded(work.rays, work.blocked); !traced) return traced;
    for (std::size_t t = 0; t < texels; ++t) {
        unsigned bits = 0;
        for (std::size_t i = 0; i < 8; ++i) bits |= work.blocked[i * texels + t] ? 0u : 1u << i;
        const std::size_t own = ownProbe(cell, cell.texel(t, factor));
        seen[t] = own < 8 ? withOwnProbe(std::uint8_t(bits), own) : std::uint8_t(bits);
    }
    return {};
}

/// Both ends' bits of the links from each probe to the next along an axis.
Result<void> traceLinks(const Context& context, const Tracer& tracer, const FieldDesc& field, const MaskCells& cells,
                        ProbeSight& sight) {
    sight.links.assign(cells.probes.size(), 0);
    struct Link {
        std::size_t from, to;
        unsigned axis;
    };
    std::vector<Link> links;
    std::size_t slot = 0;
    for (const VolumeDesc& volume : field.volumes) {
        const std::array<std::size_t, 3> stride{1, std::size_t(volume.counts.x),
                                                std::size_t(volume.counts.x) * std::size_t(volume.counts.y)};
        for (int z = 0; z < volume.counts.z; ++z)
            for (int y = 0; y < volume.counts.y; ++y)
                for (int x = 0; x < volume.counts.x; ++x, ++slot) {
                    const glm::ivec3 at(x, y, z);
                    for (unsigned axis = 0; axis < 3; ++axis)
                        if (at[int(axis)] + 1 < volume.counts[int(axis)])
                            links.push_back({slot, slot + stride[axis], axis});
                }
    }
    std::vector<std::uint8_t> blocked(links.size());
    auto traced = tryParallelFor(context, links.size(), kLinkGrain, [&](std::size_t begin, std::size_t end) {
        std::vector<Ray> rays;
        for (std::size_t i = begin; i < end; ++i)
            rays.push_back(sightRay(cells.probes[links[i].from], cells.probes[links[i].to], 0.0f));
        return tracer.occluded(rays, std::span(blocked).subspan(begin, end - begin));
    });
    if (!traced) return traced;
    for (std::size_t i = 0; i < links.size(); ++i) {
        if (blocked[i]) continue;
        sight.links[links[i].from] |= std::uint8_t(1u << (2 * links[i].axis + 1));
        sight.links[links[i].to] |= std::uint8_t(1u << (2 * links[i].axis));
    }
    sight.rays += links.size();
    return {};
}

}  // namespace

Ray sightRay(glm::vec3 from, glm::vec3 to, float beyond) {
    const glm::vec3 way = to - from;
    const float length = glm::length(way);
    if (!(length > 0.0f)) return {.origin = from, .near = 0.0f, .direction = {0, 0, 1}, .far = 0.0f};
    return {.origin = from, .near = 0.0f, .direction = way / length, .far = length + beyond};
}

std::size_t ownProbe(const MaskCell& cell, glm::vec3 texel) {
    const float reach = kReachBeyond * cell.texelSize;
    std::size_t own = 8;
    for (std::size_t i = 0; i < 8; ++i) {
        const glm::vec3 way = cell.probe[i] - texel;
        if (!(glm::dot(way, way) > reach * reach)) own = i;
    }
    return own;
}

std::uint8_t withOwnProbe(std::uint8_t seen, std::size_t own) {
    const unsigned others = seen & ~(1u << own);
    return std::uint8_t(others != 0 ? seen : 0);
}

Result<ProbeSight> traceProbeSight(const Context& context, const Tracer& tracer, const FieldDesc& field,
                                   const MaskCells& cells, int factor) {
    ProbeSight sight;
    if (auto traced = traceLinks(context, tracer, field, cells, sight); !traced) return traced.error();
    const std::size_t texels = std::size_t(factor * factor * factor);
    sight.seen.resize(cells.blocked.size() * texels);
    sight.rays += cells.blocked.size() * texels * 8;
    Progress progress(context, "seeing probes", double(cells.blocked.size()));
    auto traced = tryParallelFor(context, cells.blocked.size(), 4, [&](std::size_t begin, std::size_t end) {
        CellRays work;
        Result<void> done;
        for (std::size_t c = begin; done && c < end; ++c)
            done = seeCell(tracer, cells.blocked[c], factor, work, std::span(sight.seen).subspan(c * texels, texels));
        if (done && !progress.advance(double(end - begin)))
            return Result<void>(fail(ErrorCode::cancelled, "cancelled while baking masks"));
        return done;
    });
    if (!traced) return traced.error();
    return sight;
}

}  // namespace probegi

#include "sdf/clusters.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

#include "sdf/solid.h"

namespace probegi {

namespace {

using kernels::SdfCluster;
using kernels::SdfSolid;
using Numbers = std::vector<std::int32_t>;

constexpr int kRounds = 16;  // of K-means: few primitives settle soon

std::size_t nearestOf(std::span<const glm::vec3> centres, glm::vec3 point) {
    std::size_t best = 0;
    for (std::size_t c = 1; c < centres.size(); ++c) {
        const glm::vec3 a = centres[c] - point, b = centres[best] - point;
        if (glm::dot(a, a) < glm::dot(b, b)) best = c;
    }
    return best;
}

/// The first centre is the first solid's, each further one that of the solid farthest from those before.
std::vector<glm::vec3> firstCentres(std::span<const SdfSolid> solids, const Numbers& bounded, std::size_t count) {
    std::vector<glm::vec3> centres;
    while (centres.size() < count) {
        float farthest = -1;
        glm::vec3 next(0.0f);
        for (const std::int32_t i : bounded) {
            const glm::vec3 at = solids[std::size_t(i)].centre;
            const float distance = centres.empty() ? 0.0f : glm::distance(centres[nearestOf(centres, at)], at);
            if (distance <= farthest) continue;
            farthest = distance;
            next = at;
        }
        centres.push_back(next);
    }
    return centres;
}

std::vector<Numbers> assigned(std::span<const SdfSolid> solids, const Numbers& bounded,
                              std::span<const glm::vec3> centres) {
    std::vector<Numbers> groups(centres.size());
    for (const std::int32_t i : bounded) groups[nearestOf(centres, solids[std::size_t(i)].centre)].push_back(i);
    return groups;
}

std::vector<Numbers> kMeans(std::span<const SdfSolid> solids, const Numbers& bounded, std::size_t count) {
    std::vector<glm::vec3> centres = firstCentres(solids, bounded, count);
    std::vector<Numbers> groups = assigned(solids, bounded, centres);
    for (int round = 0; round < kRounds; ++round) {
        for (std::size_t c = 0; c < centres.size(); ++c) {
            if (groups[c].empty()) continue;
            glm::vec3 sum(0.0f);
            for (const std::int32_t i : groups[c]) sum += solids[std::size_t(i)].centre;
            centres[c] = sum / float(groups[c].size());
        }
        std::vector<Numbers> next = assigned(solids, bounded, centres);
        if (next == groups) break;
        groups = std::move(next);
    }
    return groups;
}

void add(SdfClusters& to, std::span<const SdfSolid> solids, const Numbers& group, glm::vec3 centre, float radius) {
    if (group.empty()) return;
    SdfCluster cluster;
    cluster.centre = centre;
    cluster.radius = radius;
    cluster.first = int(to.solids.size());
    cluster.count = int(group.size());
    to.clusters.push_back(cluster);
    for (const std::int32_t i : group) {
        to.solids.push_back(solids[std::size_t(i)]);
        to.numbers.push_back(i);
    }
}

void addBounded(SdfClusters& to, std::span<const SdfSolid> solids, const Numbers& group) {
    glm::vec3 sum(0.0f);
    for (const std::int32_t i : group) sum += solids[std::size_t(i)].centre;
    const glm::vec3 centre = sum / float(std::max<std::size_t>(group.size(), 1));
    float radius = 0;
    for (const std::int32_t i : group) {
        const SdfSolid& solid = solids[std::size_t(i)];
        radius = std::max(radius, glm::distance(centre, solid.centre) + glm::length(halfExtents(solid)));
    }
    add(to, solids, group, centre, radius * 1.00001f);
}

}  // namespace

SdfClusters clusterSolids(std::span<const SdfSolid> solids, int count) {
    Numbers bounded, planes;
    for (std::size_t i = 0; i < solids.size(); ++i)
        (solids[i].shape == kernels::kSdfPlane ? planes : bounded).push_back(std::int32_t(i));
    SdfClusters result;
    add(result, solids, planes, glm::vec3(0.0f), kernels::kSdfFar);
    if (bounded.empty()) return result;
    const auto wanted = std::size_t(count > 0 ? count : std::lround(std::sqrt(double(bounded.size()))));
    for (const Numbers& group : kMeans(solids, bounded, std::min(wanted, bounded.size())))
        addBounded(result, solids, group);
    return result;
}

SdfClusters oneCluster(std::span<const SdfSolid> solids) {
    Numbers all(solids.size());
    std::iota(all.begin(), all.end(), 0);
    SdfClusters result;
    add(result, solids, all, glm::vec3(0.0f), kernels::kSdfFar);
    return result;
}

}  // namespace probegi

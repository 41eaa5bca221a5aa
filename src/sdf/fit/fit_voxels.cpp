#include "sdf/fit/fit_voxels.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/parallel.h"
#include "kernels/random.h"

namespace probegi {

namespace {

/// What stopping a ray costs in a cube, in rays that end there.
constexpr float kStopped = 0.5f;
constexpr int kMostSteps = 400;  ///< of growth of a box
constexpr int kStrides[] = {1, 2, 4, 8, 16};

}  // namespace

FitVoxels::FitVoxels(std::span<const FitRay> rays, int resolution, int frame) : m_frame(frame) {
    glm::vec3 lower(1e30f), upper(-1e30f);
    for (const FitRay& ray : rays) {
        const glm::vec3 end = ray.distance < kFitSky ? ray.origin + ray.direction * ray.distance : ray.origin;
        lower = glm::min(lower, glm::min(ray.origin, end));
        upper = glm::max(upper, glm::max(ray.origin, end));
    }
    if (rays.empty()) lower = upper = glm::vec3(0.0f);
    const glm::vec3 size = upper - lower;
    m_cell = std::max({size.x, size.y, size.z, 1e-6f}) / float(resolution);
    m_origin = lower - 2.0f * m_cell;
    m_counts = glm::ivec3(glm::ceil(size / m_cell)) + 4;
    clear();
}

void FitVoxels::clear() {
    const std::size_t count = std::size_t(m_counts.x) * std::size_t(m_counts.y) * std::size_t(m_counts.z);
    m_worth.assign(count, 0.0f);
    m_ends.assign(count, 0.0f);
}

void FitVoxels::add(const FitRay& ray, float to, float at, float weight) {
    const glm::vec3 start = (ray.origin - m_origin) / m_cell;
    glm::ivec3 v(glm::floor(start));
    const auto inside = [&](glm::ivec3 c) {
        return glm::all(glm::greaterThanEqual(c, glm::ivec3(0))) && glm::all(glm::lessThan(c, m_counts));
    };
    glm::ivec3 endVoxel(-1);
    if (weight > 0) {
        endVoxel =
            glm::ivec3(glm::floor((ray.origin + ray.direction * at - m_origin) / m_cell + ray.direction * 0.05f));
        if (inside(endVoxel)) {
            m_ends[index(endVoxel)] += weight;
            m_worth[index(endVoxel)] += weight;
        }
    }
    // A walk from cube to cube (Amanatides and Woo 1987).
    glm::vec3 next, delta;
    glm::ivec3 step;
    for (int axis = 0; axis < 3; ++axis) {
        const float d = ray.direction[axis];
        step[axis] = d > 0 ? 1 : -1;
        delta[axis] = d != 0 ? m_cell / std::abs(d) : 1e30f;
        const float ahead = d > 0 ? float(v[axis]) + 1 - start[axis] : start[axis] - float(v[axis]);
        next[axis] = d != 0 ? ahead * delta[axis] : 1e30f;
    }
    while (inside(v)) {
        const int axis = next.x < next.y ? (next.x < next.z ? 0 : 2) : (next.y < next.z ? 1 : 2);
        const float leave = next[axis];
        if (leave > to || v == endVoxel) return;
        m_worth[index(v)] -= kStopped;
        v[axis] += step[axis];
        next[axis] += delta[axis];
    }
}

void FitVoxels::sum() {
    const glm::ivec3 n = m_counts + 1;
    m_sums.assign(std::size_t(n.x) * std::size_t(n.y) * std::size_t(n.z), 0.0);
    const std::size_t row = std::size_t(n.x), layer = row * std::size_t(n.y);
    for (int z = 0; z < m_counts.z; ++z)
        for (int y = 0; y < m_counts.y; ++y) {
            double line = 0;
            std::size_t at = layer * std::size_t(z + 1) + row * std::size_t(y + 1) + 1;
            const float* worth = m_worth.data() + index({0, y, z});
            for (int x = 0; x < m_counts.x; ++x, ++at) {
                line += double(worth[x]);
                m_sums[at] = line + m_sums[at - row] + m_sums[at - layer] - m_sums[at - row - layer];
            }
        }
    m_endsSoFar.resize(m_ends.size());
    double sum = 0;
    for (std::size_t i = 0; i < m_ends.size(); ++i) m_endsSoFar[i] = sum += double(m_ends[i]);
}

float FitVoxels::worth(const Range& b) const noexcept {
    const std::size_t row = std::size_t(m_counts.x + 1), layer = row * std::size_t(m_counts.y + 1);
    const std::size_t x0 = std::size_t(b.lower.x), x1 = std::size_t(b.upper.x);
    const std::size_t y0 = row * std::size_t(b.lower.y), y1 = row * std::size_t(b.upper.y);
    const std::size_t z0 = layer * std::size_t(b.lower.z), z1 = layer * std::size_t(b.upper.z);
    const auto& s = m_sums;
    return float((s[x1 + y1 + z1] - s[x0 + y1 + z1] - s[x1 + y0 + z1] + s[x0 + y0 + z1]) -
                 (s[x1 + y1 + z0] - s[x0 + y1 + z0] - s[x1 + y0 + z0] + s[x0 + y0 + z0]));
}

FitVoxels::Range FitVoxels::grown(glm::ivec3 from, float& worthOut) const {
    Range box{from, from + 1};
    float best = worth(box);
    for (int steps = 0; steps < kMostSteps; ++steps) {
        Range better = box;
        float most = best;
        for (int side = 0; side < 6; ++side)
            for (const int stride : kStrides) {
                Range tried = box;
                const int axis = side >> 1;
                if (side & 1) {
                    tried.upper[axis] = std::min(tried.upper[axis] + stride, m_counts[axis]);
                    if (tried.upper[axis] == box.upper[axis]) continue;
                } else {
                    tried.lower[axis] = std::max(tried.lower[axis] - stride, 0);
                    if (tried.lower[axis] == box.lower[axis]) continue;
                }
                const float value = worth(tried);
                if (value > most) {
                    most = value;
                    better = tried;
                }
            }
        if (!(most > best)) break;
        best = most;
        box = better;
    }
    worthOut = best;
    return box;
}

FitBox FitVoxels::boxOf(const Range& range) const noexcept {
    return {m_origin + m_cell * glm::vec3(range.lower), m_origin + m_cell * glm::vec3(range.upper), m_frame};
}

FitVoxels::Found FitVoxels::bestBox(const Context& context, int seeds, std::uint32_t& state) const {
    const double total = m_endsSoFar.empty() ? 0 : m_endsSoFar.back();
    if (!(total > 0)) return {};
    struct Grown {
        Range box;
        float worth = 0;
    };
    std::vector<Grown> found(std::size_t(seeds), Grown{{glm::ivec3(0), glm::ivec3(0)}, 0.0f});
    const std::uint32_t from = state;
    state = kernels::hashUint(state);
    parallelFor(context, found.size(), 4, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const double at = total * double(kernels::uintToUnit(kernels::hashCombine(from, std::uint32_t(i))));
            const auto cube = std::upper_bound(m_endsSoFar.begin(), m_endsSoFar.end(), at) - m_endsSoFar.begin();
            const int n = int(std::min<std::ptrdiff_t>(cube, std::ptrdiff_t(m_ends.size()) - 1));
            const glm::ivec3 v(n % m_counts.x, n / m_counts.x % m_counts.y, n / (m_counts.x * m_counts.y));
            found[i].box = grown(v, found[i].worth);
        }
    });
    const auto best =
        std::max_element(found.begin(), found.end(), [](const Grown& a, const Grown& b) { return a.worth < b.worth; });
    if (!(best->worth > 0)) return {};
    return {boxOf(best->box), best->worth};
}

bool FitVoxels::cover(const FitBox& box, const glm::mat3& toBox) {
    // The box's bounds in this frame.
    const glm::mat3 fromBox = glm::transpose(toBox);
    const glm::vec3 half = 0.5f * (box.upper - box.lower);
    const glm::vec3 centre = fromBox * (0.5f * (box.upper + box.lower));
    glm::vec3 reach(0.0f);
    for (int axis = 0; axis < 3; ++axis) reach += glm::abs(fromBox[axis]) * half[axis];
    const glm::vec3 from = (centre - reach - m_origin) / m_cell, to = (centre + reach - m_origin) / m_cell;
    const glm::ivec3 lower = glm::clamp(glm::ivec3(glm::floor(from)), glm::ivec3(0), m_counts);
    const glm::ivec3 upper = glm::clamp(glm::ivec3(glm::ceil(to)), glm::ivec3(0), m_counts);
    bool changed = false;
    for (int z = lower.z; z < upper.z; ++z)
        for (int y = lower.y; y < upper.y; ++y)
            for (int x = lower.x; x < upper.x; ++x) {
                const glm::vec3 p = toBox * (m_origin + m_cell * (glm::vec3(x, y, z) + 0.5f));
                if (glm::any(glm::lessThan(p, box.lower)) || glm::any(glm::greaterThan(p, box.upper))) continue;
                const std::size_t at = index({x, y, z});
                changed = changed || m_worth[at] != 0;
                m_worth[at] = m_ends[at] = 0;
            }
    return changed;
}

}  // namespace probegi

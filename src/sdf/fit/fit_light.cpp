#include "sdf/fit/fit_light.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <numeric>

namespace probegi {

namespace {

constexpr float kAlbedo = 0.5f;    ///< of all surfaces
constexpr int kBounces = 6;        ///< those that follow bring less than a hundredth
constexpr int kLeastRays = 24;     ///< of a part of space
constexpr int kBins = 16;          ///< in which a part of space may be cut, along each axis
constexpr float kSlender = 0.25f;  ///< of the longest side of a part: shorter ones are not cut
constexpr double kHalving = 1e-3;  ///< squared error of a ray for which a part is halved anyway
constexpr float kBefore = 0.999f;  ///< of the way to a surface: in the air before it

/// Space in parts: a regression tree, cut where the share of rays that see the sky changes most, as it does at walls.
class Places {
public:
    Places(std::span<const FitRay> rays) : m_rays(rays), m_placeOf(rays.size()) {
        std::vector<std::uint32_t> all(rays.size());
        std::iota(all.begin(), all.end(), 0u);
        if (!all.empty()) split(all);
    }

    std::size_t count() const noexcept { return m_count; }
    std::size_t placeOf(std::size_t ray) const noexcept { return m_placeOf[ray]; }
    std::size_t placeAt(glm::vec3 point) const noexcept {
        std::size_t n = 0;
        while (m_nodes[n].axis >= 0) n = m_nodes[n].next + (point[m_nodes[n].axis] < m_nodes[n].at ? 0 : 1);
        return m_nodes[n].next;
    }

private:
    struct Node {
        int axis = -1;  ///< -1: a place
        float at = 0;
        std::size_t next = 0;  ///< the lower of two nodes, or the place's number
    };
    struct Cut {
        int axis = -1;
        float at = 0;
        double gain = 0;
    };

    void split(std::span<std::uint32_t> all) {
        struct Part {
            std::size_t node;
            std::span<std::uint32_t> rays;
        };
        m_nodes.emplace_back();
        std::vector<Part> open{{0, all}};
        while (!open.empty()) {
            const Part part = open.back();
            open.pop_back();
            const Cut cut = bestCut(part.rays);
            if (cut.axis < 0) {
                for (const std::uint32_t ray : part.rays) m_placeOf[ray] = std::uint32_t(m_count);
                m_nodes[part.node].next = m_count++;
                continue;
            }
            const auto middle = std::partition(part.rays.begin(), part.rays.end(), [&](std::uint32_t ray) {
                return m_rays[ray].origin[cut.axis] < cut.at;
            });
            const std::size_t lower = m_nodes.size();
            m_nodes[part.node] = {cut.axis, cut.at, lower};
            m_nodes.resize(lower + 2);
            const auto count = std::size_t(middle - part.rays.begin());
            open.push_back({lower, part.rays.first(count)});
            open.push_back({lower + 1, part.rays.subspan(count)});
        }
    }

    Cut bestCut(std::span<const std::uint32_t> part) const {
        Cut best;
        if (part.size() < 2 * kLeastRays) return best;
        glm::vec3 lower(1e30f), upper(-1e30f);
        for (const std::uint32_t ray : part) {
            lower = glm::min(lower, m_rays[ray].origin);
            upper = glm::max(upper, m_rays[ray].origin);
        }
        const glm::vec3 size = upper - lower;
        const float longest = std::max({size.x, size.y, size.z});
        for (int axis = 0; axis < 3; ++axis) {
            if (size[axis] < kSlender * longest || !(size[axis] > 0)) continue;
            const Cut cut = bestCut(part, axis, lower[axis], size[axis], kHalving * double(size[axis] / longest));
            if (cut.gain > best.gain) best = cut;
        }
        return best;
    }

    /// Along one axis. `halving`: what it is worth to cut a ray off where all is alike.
    Cut bestCut(std::span<const std::uint32_t> part, int axis, float lower, float size, double halving) const {
        std::array<int, kBins> rays{}, sky{};
        for (const std::uint32_t ray : part) {
            const float at = (m_rays[ray].origin[axis] - lower) / size;
            const auto bin = std::size_t(std::clamp(int(at * kBins), 0, kBins - 1));
            ++rays[bin];
            sky[bin] += m_rays[ray].distance >= kFitSky;
        }
        const double all = double(part.size()), allSky = std::accumulate(sky.begin(), sky.end(), 0.0);
        Cut best;
        double n = 0, s = 0;
        for (std::size_t bin = 0; bin + 1 < kBins; ++bin) {
            n += rays[bin];
            s += sky[bin];
            if (n < kLeastRays || all - n < kLeastRays) continue;
            // By how much two means fit better than one, in squares of errors.
            const double better = s * s / n + (allSky - s) * (allSky - s) / (all - n) - allSky * allSky / all;
            const double gain = better + halving * std::min(n, all - n);
            if (gain > best.gain) best = {axis, lower + size * float(bin + 1) / kBins, gain};
        }
        return best;
    }

    std::span<const FitRay> m_rays;
    std::vector<std::uint32_t> m_placeOf;
    std::vector<Node> m_nodes;
    std::size_t m_count = 0;
};

/// The mean light of each place.
std::vector<float> lightAt(const Places& places, std::span<const FitRay> rays) {
    std::vector<std::uint32_t> ends(rays.size());
    std::vector<float> counts(places.count(), 0.0f);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const FitRay& ray = rays[i];
        if (ray.distance < kFitSky)
            ends[i] = std::uint32_t(places.placeAt(ray.origin + ray.direction * (kBefore * ray.distance)));
        ++counts[places.placeOf(i)];
    }
    std::vector<float> light(places.count(), 0.0f);
    for (int bounce = 0; bounce < kBounces; ++bounce) {
        std::vector<float> next(places.count(), 0.0f);
        for (std::size_t i = 0; i < rays.size(); ++i)
            next[places.placeOf(i)] += rays[i].distance >= kFitSky ? 1.0f : kAlbedo * light[ends[i]];
        for (std::size_t p = 0; p < next.size(); ++p) light[p] = next[p] / std::max(counts[p], 1.0f);
    }
    return light;
}

}  // namespace

std::vector<float> lightOfStarts(std::span<const FitRay> rays, const glm::mat3& frame) {
    const std::vector<FitRay> turned = raysIn(frame, rays);
    const Places places(turned);
    const std::vector<float> light = lightAt(places, turned);
    std::vector<float> out(rays.size());
    for (std::size_t i = 0; i < rays.size(); ++i) out[i] = light[places.placeOf(i)];
    return out;
}

}  // namespace probegi

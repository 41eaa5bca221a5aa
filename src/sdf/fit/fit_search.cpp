#include "sdf/fit/fit_search.h"

#include <algorithm>
#include <glm/common.hpp>

#include "core/parallel.h"
#include "kernels/random.h"
#include "sdf/fit/fit_frames.h"
#include "sdf/fit/fit_voxels.h"

namespace probegi {

namespace {

constexpr float kOverbuild = 1.5f;           ///< boxes at first, over those wanted
constexpr std::size_t kSearchRays = 100000;  ///< by which boxes are chosen; all of them place their faces
constexpr int kSeeds = 64;                   ///< growing boxes of which the best is taken
constexpr int kMergeTrials = 96;             ///< pairs of boxes that might be one
constexpr int kMostSwapped = 4;              ///< boxes a round
constexpr float kWhim = 0.6f;                ///< by how much worths are varied at random when boxes are taken away
constexpr double kLeastWorth = 5e-5;         ///< by which a box must lower the mean cost
constexpr int kFirstSweeps = 8;
constexpr int kSweeps = 4;
constexpr int kLastSweeps = 6;

float area(glm::vec3 lower, glm::vec3 upper) {
    const glm::vec3 d = upper - lower;
    return d.x * d.y + d.y * d.z + d.z * d.x;
}

FitBox around(const FitBox& a, const FitBox& b) {
    return {glm::min(a.lower, b.lower), glm::max(a.upper, b.upper), a.frame};
}

class Search {
public:
    Search(const Context& context, const FitSearch& search)
        : m_context(context),
          m_search(search),
          m_state(kernels::hashUint(search.seed)),
          m_some(someRays()),
          m_fit(context, m_some, m_ends, search.frames, search.cost) {
        for (std::size_t f = 0; f < search.frames.size(); ++f) {
            m_rays.push_back(raysIn(search.frames[f], m_some));
            m_grids.emplace_back(m_rays[f], search.resolution, int(f));
        }
    }

    void build() {
        fillGrids([&](std::size_t ray) {
            const float distance = m_some[ray].distance;
            const bool ends = distance < kFitSky && (m_ends.empty() || m_ends[ray] > distance);
            return Wanted{distance, ends ? 1.0f : 0.0f};
        });
        std::vector<FitBox> boxes = bestBoxes(int(kOverbuild * float(m_search.most)) + 1);
        m_fit.set(std::move(boxes), step());
        sweeps(kFirstSweeps);
    }

    void shrink() {
        while (int(m_fit.boxes().size()) > m_search.most) {
            const int surplus = int(m_fit.boxes().size()) - m_search.most;
            for (int i = 0; i < (surplus + 3) / 4; ++i) takeOneAway(0);
            sweeps(2);
        }
        m_cost = sweeps(kSweeps);
    }

    /// Takes some boxes away and puts others in; keeps that if it helps.
    void swapSome() {
        FitBoxes saved = m_fit;
        const int count = 1 + int(kernels::nextRandom(m_state) * kMostSwapped);
        for (int i = 0; i < count && !m_fit.boxes().empty(); ++i) takeOneAway(kWhim);
        fillGrids([&](std::size_t ray) {
            const FitRay& r = m_some[ray];
            const float distance = m_fit.distance(ray);
            const bool late = r.distance < kFitSky && distance > r.distance;
            return Wanted{std::min(r.distance, distance), late ? m_search.cost(r.distance, r.cosine, distance) : 0.0f};
        });
        const int missing = m_search.most - int(m_fit.boxes().size());
        for (const FitBox& box : bestBoxes(missing)) m_fit.append(box, step());
        const double cost = sweeps(kSweeps);
        if (cost < m_cost) {
            m_cost = cost;
        } else {
            m_fit = std::move(saved);
        }
    }

    std::vector<FitBox> placed() {
        sweeps(kSweeps);
        FitBoxes all(m_context, m_search.rays, m_search.ends, m_search.frames, m_search.cost);
        all.set({m_fit.boxes().begin(), m_fit.boxes().end()}, 0.5f * step());
        for (int i = 0; i < kLastSweeps; ++i) all.sweep();
        for (;;) {
            const std::vector<double> worth = all.worth();
            const auto least = std::min_element(worth.begin(), worth.end());
            if (least == worth.end() || *least > kLeastWorth) break;
            all.remove(std::size_t(least - worth.begin()));
        }
        return {all.boxes().begin(), all.boxes().end()};
    }

private:
    struct Wanted {
        float passes;  ///< metres that the ray must go on passing
        float weight;  ///< of a box at its end
    };

    std::vector<FitRay> someRays() {
        std::vector<FitRay> some;
        const std::size_t stride = std::max<std::size_t>(m_search.rays.size() / kSearchRays, 1);
        for (std::size_t i = 0; i < m_search.rays.size(); i += stride) {
            some.push_back(m_search.rays[i]);
            m_normals.push_back(m_search.surfaces[i].normal);
            if (!m_search.ends.empty()) m_ends.push_back(m_search.ends[i]);
        }
        return some;
    }

    float step() const { return 0.5f * m_grids[0].cell(); }

    double sweeps(int count) {
        double cost = m_fit.cost();
        for (int i = 0; i < count; ++i) cost = m_fit.sweep();
        return cost;
    }

    template <class Want>
    void fillGrids(const Want& want) {
        parallelFor(m_context, m_grids.size(), 1, [&](std::size_t begin, std::size_t end) {
            for (std::size_t f = begin; f < end; ++f) {
                m_grids[f].clear();
                for (std::size_t i = 0; i < m_some.size(); ++i) {
                    const Wanted w = want(i);
                    // Sloping frames are for what slopes as they do.
                    const bool fits = f == 0 || facesAlong(m_search.frames[f], m_normals[i]);
                    m_grids[f].add(m_rays[f][i], w.passes, m_some[i].distance, fits ? w.weight : 0.0f);
                }
                m_grids[f].sum();
            }
        });
    }

    std::vector<FitBox> bestBoxes(int count) {
        std::vector<FitBox> boxes;
        std::vector<FitVoxels::Found> found(m_grids.size());
        for (std::size_t f = 0; f < m_grids.size(); ++f) found[f] = m_grids[f].bestBox(m_context, kSeeds, m_state);
        while (int(boxes.size()) < count) {
            const auto best = std::max_element(found.begin(), found.end(),
                                               [](const auto& a, const auto& b) { return a.worth < b.worth; });
            if (!(best->worth > 0)) break;
            boxes.push_back(best->box);
            for (std::size_t f = 0; f < m_grids.size(); ++f) {
                const glm::mat3 toBox =
                    glm::transpose(m_search.frames[std::size_t(boxes.back().frame)]) * m_search.frames[f];
                if (!m_grids[f].cover(boxes.back(), toBox)) continue;
                m_grids[f].sum();
                found[f] = m_grids[f].bestBox(m_context, kSeeds, m_state);
            }
        }
        return boxes;
    }

    /// Of the boxes the one that saves least, or two of which the box around both costs less.
    void takeOneAway(float whim) {
        const auto varied = [&](double cost) { return cost * double(1 - whim + whim * kernels::nextRandom(m_state)); };
        std::vector<double> worth = m_fit.worth();
        for (double& w : worth) w = varied(w);
        const auto least = std::min_element(worth.begin(), worth.end());
        const std::span<const FitBox> boxes = m_fit.boxes();
        struct Pair {
            float waste;
            std::size_t a, b;
        };
        std::vector<Pair> pairs;
        for (std::size_t a = 0; a < boxes.size(); ++a)
            for (std::size_t b = a + 1; b < boxes.size(); ++b) {
                if (boxes[a].frame != boxes[b].frame) continue;
                const FitBox both = around(boxes[a], boxes[b]);
                pairs.push_back({area(both.lower, both.upper) - area(boxes[a].lower, boxes[a].upper) -
                                     area(boxes[b].lower, boxes[b].upper),
                                 a, b});
            }
        const std::size_t tried = std::min<std::size_t>(pairs.size(), kMergeTrials);
        std::partial_sort(pairs.begin(), pairs.begin() + std::ptrdiff_t(tried), pairs.end(),
                          [](const Pair& x, const Pair& y) { return x.waste < y.waste; });
        // The box around both holds them, so what it costs is what it stops too early.
        std::vector<double> costs(tried);
        parallelFor(m_context, tried, 1, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                costs[i] = -m_fit.saves(around(boxes[pairs[i].a], boxes[pairs[i].b]));
        });
        for (double& c : costs) c = varied(c);
        const auto cheapest = std::min_element(costs.begin(), costs.end());
        if (cheapest != costs.end() && *cheapest < *least) {
            const Pair pair = pairs[std::size_t(cheapest - costs.begin())];
            m_fit.replace(pair.a, around(boxes[pair.a], boxes[pair.b]), step());
            m_fit.remove(pair.b);
        } else {
            m_fit.remove(std::size_t(least - worth.begin()));
        }
    }

    Context m_context;
    const FitSearch& m_search;
    std::uint32_t m_state;
    std::vector<glm::vec3> m_normals;  ///< of the ends of m_some
    std::vector<float> m_ends;         ///< of m_some
    std::vector<FitRay> m_some;
    std::vector<std::vector<FitRay>> m_rays;  ///< m_some in each frame
    std::vector<FitVoxels> m_grids;
    FitBoxes m_fit;
    double m_cost = 0;
};

}  // namespace

std::vector<FitBox> findBoxes(const Context& context, const FitSearch& search, Progress& progress) {
    if (search.rays.empty() || search.most < 1) return {};
    Search s(context, search);
    s.build();
    if (!progress.set(0.25)) return {};
    s.shrink();
    for (int round = 0; round < search.rounds; ++round) {
        if (!progress.set(0.4 + 0.45 * double(round) / double(search.rounds))) return {};
        s.swapSome();
    }
    return s.placed();
}

}  // namespace probegi

#include "measure/audit/leak_places.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>
#include <tuple>

namespace probegi {

namespace {

constexpr std::size_t kFewest = 3;     ///< points of a place
constexpr double kApart = 2.5;         ///< distance of neighbours, in sides of the square that a point stands for
constexpr double kFarthest = 1.0;      ///< the same in spacings
constexpr double kNook = 0.5;          ///< of that for points that face each other
constexpr float kAlike = 0.7f;         ///< cosine between the normals of neighbours
constexpr double kAlmostLight = 0.01;  ///< of the mean, added to both lights that are compared

/// Sets that merge, by the smallest member.
class Sets {
public:
    explicit Sets(std::size_t count) : m_parent(count) { std::iota(m_parent.begin(), m_parent.end(), std::size_t(0)); }
    std::size_t of(std::size_t i) {
        while (m_parent[i] != i) i = m_parent[i] = m_parent[m_parent[i]];
        return i;
    }
    void merge(std::size_t a, std::size_t b) {
        a = of(a), b = of(b);
        m_parent[std::max(a, b)] = std::min(a, b);
    }

private:
    std::vector<std::size_t> m_parent;
};

double reachOf(const ExplainedPoint& p, const FieldRecord& record) {
    const double spacing = double(record.volumes[std::size_t(p.point.volume)].minSpacing);
    return std::max(kApart * std::sqrt(p.point.area), kFarthest * spacing);
}

bool belongTogether(const ExplainedPoint& a, const ExplainedPoint& b, double reach) {
    const LeakPoint &p = a.point, &q = b.point;
    const glm::vec3 way = q.query.position - p.query.position;
    if (a.why.cause != b.why.cause || p.volume != q.volume || (p.leak > 0) != (q.leak > 0) ||
        !(double(glm::length(way)) < reach))
        return false;
    if (glm::dot(p.query.normal, q.query.normal) > kAlike) return true;
    // A nook has many sides, which face each other; a leaking wall has one.
    return a.why.cause == LeakCause::noProbeSees && double(glm::length(way)) < kNook * reach &&
           glm::dot(way, p.query.normal) > 0 && glm::dot(way, q.query.normal) < 0;
}

/// The median of the values above 0; 0 if most are not.
double usual(std::vector<double> values) {
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

}  // namespace

double stopsApart(double light, double right, double meanLight) {
    const double least = kAlmostLight * meanLight;
    if (!(least > 0)) return 0;
    return std::abs(std::log2((light + least) / (right + least)));
}

std::vector<std::vector<std::size_t>> groupPoints(const std::vector<ExplainedPoint>& points,
                                                  const FieldRecord& record) {
    double reach = 0;
    for (const ExplainedPoint& p : points) reach = std::max(reach, reachOf(p, record));
    using Cell = std::tuple<int, int, int>;
    const auto cellOf = [&](glm::vec3 position) {
        const glm::vec3 cell = glm::floor(position / float(reach));
        return glm::ivec3(cell);
    };
    std::map<Cell, std::vector<std::size_t>> cells;
    Sets sets(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        const glm::ivec3 cell = cellOf(points[i].point.query.position);
        for (int n = 0; n < 27; ++n) {
            const auto found = cells.find({cell.x + n % 3 - 1, cell.y + n / 3 % 3 - 1, cell.z + n / 9 - 1});
            if (found == cells.end()) continue;
            for (const std::size_t other : found->second)
                if (belongTogether(points[i], points[other],
                                   std::min(reachOf(points[i], record), reachOf(points[other], record))))
                    sets.merge(i, other);
        }
        cells[{cell.x, cell.y, cell.z}].push_back(i);
    }
    std::map<std::size_t, std::vector<std::size_t>> groups;
    for (std::size_t i = 0; i < points.size(); ++i) groups[sets.of(i)].push_back(i);
    std::vector<std::vector<std::size_t>> kept;
    for (auto& [first, group] : groups)
        if (group.size() >= kFewest) kept.push_back(std::move(group));
    return kept;
}

LeakPlace placeOf(const std::vector<ExplainedPoint>& points, const std::vector<std::size_t>& group,
                  const FieldRecord& record) {
    LeakPlace place;
    place.points = int(group.size());
    place.lower = place.upper = points[group.front()].point.query.position;
    const ExplainedPoint* worst = &points[group.front()];
    std::vector<double> wall, thicken, refine, move, extend;
    for (const std::size_t i : group) {
        const auto& [p, why] = points[i];
        place.area += p.area;
        place.leak += p.area * p.leak, place.light += p.area * p.light, place.unleaked += p.area * p.unleaked;
        place.lower = glm::min(place.lower, p.query.position), place.upper = glm::max(place.upper, p.query.position);
        if (std::abs(p.leak) > std::abs(worst->point.leak)) worst = &points[i];
        wall.push_back(why.wall), thicken.push_back(why.thicken), refine.push_back(why.refine);
        move.push_back(why.move), extend.push_back(why.extend);
    }
    place.leak /= place.area, place.light /= place.area, place.unleaked /= place.area;
    place.cause = worst->why.cause;
    place.position = worst->point.query.position;
    place.normal = worst->point.query.normal;
    place.worst = worst->point.leak;
    place.volume = worst->point.volume;
    place.spacing = record.volumes[std::size_t(place.volume)].spacing;
    place.probe = worst->point.probe;
    place.probeShare = worst->point.slotShare;
    place.wall = usual(wall), place.thicken = usual(thicken), place.refine = usual(refine), place.move = usual(move);
    place.extend = *std::max_element(extend.begin(), extend.end());
    return place;
}

}  // namespace probegi

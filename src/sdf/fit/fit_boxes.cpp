#include "sdf/fit/fit_boxes.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "core/parallel.h"

namespace probegi {

namespace {

constexpr std::size_t kGrain = 8192;     ///< rays per task
constexpr std::size_t kBlock = 1024;     ///< rays that a box is tested against in one loop
constexpr float kParallel = 1e-12f;      ///< least component of a direction
constexpr float kReach = 4;              ///< steps by which a face moves in one sweep, at most
constexpr float kLeastStep = 1.0f / 64;  ///< of the first
constexpr float kThick = 2;              ///< first steps that a box is made thick, if that costs nothing

}  // namespace

FitBoxes::FitBoxes(const Context& context, std::span<const FitRay> rays, std::span<const float> ends,
                   std::span<const glm::mat3> frames, const FitCost& cost)
    : m_context(context), m_cost(cost), m_frames(frames.size()), m_ends(ends.begin(), ends.end()) {
    for (std::size_t f = 0; f < frames.size(); ++f) {
        const std::vector<FitRay> turned = raysIn(frames[f], rays);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            for (const FitRay& ray : turned) {
                const float d = ray.direction[int(axis)];
                m_frames[f].origin[axis].push_back(ray.origin[int(axis)]);
                m_frames[f].inverse[axis].push_back(1.0f / (std::abs(d) > kParallel ? d : std::copysign(kParallel, d)));
            }
        }
    }
    for (const FitRay& ray : rays) {
        m_wanted.push_back(ray.distance);
        m_cosine.push_back(ray.cosine);
    }
    for (int k = 0; k < 2; ++k) {
        m_distance[std::size_t(k)].assign(rays.size(), kFitSky);
        m_box[std::size_t(k)].assign(rays.size(), -1);
    }
}

float FitBoxes::meets(glm::vec3 origin, glm::vec3 inverse, const FitBox& box) noexcept {
    const glm::vec3 a = (box.lower - origin) * inverse;
    const glm::vec3 b = (box.upper - origin) * inverse;
    const float enters = std::max(std::max(std::min(a.x, b.x), std::min(a.y, b.y)), std::max(std::min(a.z, b.z), 0.0f));
    const float leaves = std::min(std::min(std::max(a.x, b.x), std::max(a.y, b.y)), std::max(a.z, b.z));
    return enters <= leaves ? enters : kFitSky;
}

float FitBoxes::meets(std::size_t ray, const FitBox& box) const noexcept {
    const FrameRays& f = m_frames[std::size_t(box.frame)];
    return meets({f.origin[0][ray], f.origin[1][ray], f.origin[2][ray]},
                 {f.inverse[0][ray], f.inverse[1][ray], f.inverse[2][ray]}, box);
}

void FitBoxes::meetAll(std::size_t begin, const FitBox& box, std::span<float> out) const noexcept {
    const FrameRays& f = m_frames[std::size_t(box.frame)];
    const float *ox = f.origin[0].data() + begin, *oy = f.origin[1].data() + begin, *oz = f.origin[2].data() + begin;
    const float *ix = f.inverse[0].data() + begin, *iy = f.inverse[1].data() + begin, *iz = f.inverse[2].data() + begin;
    float* to = out.data();
    const std::size_t count = out.size();
    for (std::size_t i = 0; i < count; ++i) to[i] = meets({ox[i], oy[i], oz[i]}, {ix[i], iy[i], iz[i]}, box);
}

void FitBoxes::findNearest(std::size_t ray) {
    float first = m_ends.empty() ? kFitSky : m_ends[ray];
    float second = kFitSky;
    int firstBox = -1, secondBox = -1;
    for (std::size_t b = 0; b < m_boxes.size(); ++b) {
        const float distance = meets(ray, m_boxes[b]);
        if (distance < first) {
            second = first;
            secondBox = firstBox;
            first = distance;
            firstBox = int(b);
        } else if (distance < second) {
            second = distance;
            secondBox = int(b);
        }
    }
    m_distance[0][ray] = first;
    m_distance[1][ray] = second;
    m_box[0][ray] = firstBox;
    m_box[1][ray] = secondBox;
}

void FitBoxes::findAllNearest() {
    parallelFor(m_context, rays(), kGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) findNearest(i);
    });
}

void FitBoxes::set(std::vector<FitBox> boxes, float step) {
    m_boxes = std::move(boxes);
    m_steps.resize(m_boxes.size());
    for (Steps& s : m_steps) s.fill(step);
    m_leastStep = step * kLeastStep;
    m_thick = step * kThick;
    findAllNearest();
}

double FitBoxes::cost() const {
    double sum = 0;
    for (std::size_t i = 0; i < rays(); ++i) sum += double(costOf(i, m_distance[0][i]));
    return rays() == 0 ? 0 : sum / double(rays());
}

std::vector<double> FitBoxes::worth() const {
    std::vector<double> out(m_boxes.size(), 0.0);
    for (std::size_t i = 0; i < rays(); ++i)
        if (m_box[0][i] >= 0)
            out[std::size_t(m_box[0][i])] += double(costOf(i, m_distance[1][i])) - double(costOf(i, m_distance[0][i]));
    for (double& w : out) w /= double(rays());
    return out;
}

template <class Each>
void FitBoxes::forBlocks(const FitBox& box, const Each& each) const {
    std::array<float, kBlock> distances;
    for (std::size_t begin = 0; begin < rays(); begin += kBlock) {
        const std::span<float> out(distances.data(), std::min(kBlock, rays() - begin));
        meetAll(begin, box, out);
        for (std::size_t i = 0; i < out.size(); ++i)
            if (out[i] < kFitSky) each(begin + i, out[i]);
    }
}

double FitBoxes::saves(const FitBox& box) const {
    double sum = 0;
    forBlocks(box, [&](std::size_t i, float distance) {
        if (distance < m_distance[0][i]) sum += double(costOf(i, m_distance[0][i])) - double(costOf(i, distance));
    });
    return rays() == 0 ? 0 : sum / double(rays());
}

std::vector<FitBoxes::Touched> FitBoxes::touchedBy(std::size_t number, const FitBox& reach) const {
    std::vector<Touched> out;
    const FrameRays& f = m_frames[std::size_t(reach.frame)];
    forBlocks(reach, [&](std::size_t i, float distance) {
        const float others = m_box[0][i] == int(number) ? m_distance[1][i] : m_distance[0][i];
        if (!(distance < others)) return;
        out.push_back({{f.origin[0][i], f.origin[1][i], f.origin[2][i]},
                       m_wanted[i],
                       {f.inverse[0][i], f.inverse[1][i], f.inverse[2][i]},
                       m_cosine[i],
                       others,
                       std::uint32_t(i)});
    });
    return out;
}

double FitBoxes::costOf(std::span<const Touched> rays, const FitBox& box) const noexcept {
    double sum = 0;
    for (const Touched& t : rays) {
        const float distance = std::min(meets(t.origin, t.inverse, box), t.others);
        sum += double(m_cost(t.wanted, t.cosine, distance));
    }
    return sum;
}

bool FitBoxes::moveFace(std::span<const Touched> rays, const FitBox& reach, int side, float step, FitBox& box,
                        double& best) const {
    const int axis = side >> 1;
    const bool upper = (side & 1) != 0;
    bool moved = false;
    for (const bool outwards : {true, false}) {
        const float sign = outwards == upper ? 1.0f : -1.0f;
        for (float stride = step; stride <= kReach * step; stride *= 2) {
            FitBox tried = box;
            float& face = (upper ? tried.upper : tried.lower)[axis];
            float& other = (upper ? tried.lower : tried.upper)[axis];
            face = std::clamp(face + sign * stride, reach.lower[axis], reach.upper[axis]);
            // A thin box is pushed along.
            if (tried.upper[axis] - tried.lower[axis] < m_leastStep)
                other = std::clamp(face + (upper ? -m_leastStep : m_leastStep), reach.lower[axis], reach.upper[axis]);
            if (tried.upper[axis] - tried.lower[axis] < 0.5f * m_leastStep) break;
            const double value = costOf(rays, tried);
            // Where no ray tells, walls grow thick.
            const bool thin = box.upper[axis] - box.lower[axis] < m_thick;
            if (!(value < best || (outwards && thin && value <= best))) break;
            best = value;
            box = tried;
            moved = true;
        }
        if (moved) break;
    }
    return moved;
}

FitBox FitBoxes::improved(std::size_t number, Steps& steps) const {
    FitBox box = m_boxes[number];
    FitBox reach = box;
    for (int side = 0; side < 6; ++side) {
        const float margin = kReach * steps[std::size_t(side)];
        (side & 1 ? reach.upper : reach.lower)[side >> 1] += side & 1 ? margin : -margin;
    }
    const std::vector<Touched> rays = touchedBy(number, reach);
    double best = costOf(rays, box);
    for (int side = 0; side < 6; ++side) {
        float& step = steps[std::size_t(side)];
        const bool moved = moveFace(rays, reach, side, step, box, best);
        step = moved ? step * 1.5f : std::max(step * 0.5f, m_leastStep);
    }
    return box;
}

void FitBoxes::commit(std::size_t number, const FitBox& box) {
    m_boxes[number] = box;
    for (std::size_t i = 0; i < rays(); ++i)
        if (m_box[0][i] == int(number) || m_box[1][i] == int(number)) findNearest(i);
    forBlocks(box, [&](std::size_t i, float distance) {
        if (distance < m_distance[1][i] && m_box[0][i] != int(number)) findNearest(i);
    });
}

double FitBoxes::sweep() {
    std::vector<FitBox> better(m_boxes.size());
    parallelFor(m_context, m_boxes.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t b = begin; b < end; ++b) better[b] = improved(b, m_steps[b]);
    });
    // Each was improved as if the others stood still. What does not hold beside the others' moves is not done.
    const std::vector<FitBox> old = m_boxes;
    for (std::size_t b = 0; b < m_boxes.size(); ++b) {
        if (better[b].lower == old[b].lower && better[b].upper == old[b].upper) continue;
        const FitBox both{glm::min(old[b].lower, better[b].lower), glm::max(old[b].upper, better[b].upper),
                          old[b].frame};
        const std::vector<Touched> rays = touchedBy(b, both);
        if (!(costOf(rays, better[b]) < costOf(rays, old[b]))) continue;
        m_boxes[b] = better[b];
        for (const Touched& t : rays) findNearest(t.number);
    }
    return cost();
}

void FitBoxes::replace(std::size_t number, const FitBox& box, float step) {
    commit(number, box);
    m_steps[number].fill(step);
}

void FitBoxes::remove(std::size_t number) {
    const int last = int(m_boxes.size()) - 1;
    m_boxes[number] = m_boxes.back();
    m_steps[number] = m_steps.back();
    m_boxes.pop_back();
    m_steps.pop_back();
    for (std::size_t i = 0; i < rays(); ++i) {
        if (m_box[0][i] == int(number) || m_box[1][i] == int(number)) {
            findNearest(i);
        } else {
            for (auto& box : m_box)
                if (box[i] == last) box[i] = int(number);
        }
    }
}

void FitBoxes::append(const FitBox& box, float step) {
    m_boxes.push_back({glm::vec3(1e29f), glm::vec3(1e29f), box.frame});
    m_steps.emplace_back().fill(step);
    commit(m_boxes.size() - 1, box);
}

}  // namespace probegi

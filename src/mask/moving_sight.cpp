#include "mask/moving_sight.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace probegi {

namespace {

/// Half an extent of boxes at least, metres: sheets of no thickness have an inside too.
constexpr float kThinnest = 1e-4f;

/// From one of a cell's probes to the next along an axis.
struct Link {
    unsigned from, to;
};

/// Segments of a cell that meet boxes, each once, and their rays.
class ChangedSegments {
public:
    ChangedSegments(const MaskCell& cell, int factor, std::span<const OrientedBox> boxes)
        : m_cell(cell), m_factor(factor), m_texels(std::size_t(factor * factor * factor)), m_met(8 * m_texels) {
        for (const OrientedBox& box : boxes) {
            const BoxFrame frame(box, 2 * kReachBeyond * cell.texelSize);
            for (unsigned i = 0; i < 8; ++i) markTexels(frame, i);
            for (unsigned i = 0; i < 8; ++i)
                for (unsigned axis = 0; axis < 3; ++axis)
                    if (const unsigned next = i | 1u << axis; next != i) markLink(frame, i, next);
        }
        markOwn();
    }

    /// Calls body(probe, texel) for each.
    template <class Body>
    void forTexels(const Body& body) const {
        for (std::size_t i = 0; i < 8; ++i)
            for (std::size_t t = 0; t < m_texels; ++t)
                if (m_met[i * m_texels + t]) body(i, t);
    }
    const std::vector<Link>& links() const { return m_links; }

    /// The probe that a texel is on, or 8.
    std::size_t own(std::size_t texel) const { return m_own[texel]; }

private:
    // Of what a texel on a probe sees it is not known whether it sees that probe: it is looked at as a whole.
    void markOwn() {
        m_own.resize(m_texels);
        for (std::size_t t = 0; t < m_texels; ++t) {
            m_own[t] = ownProbe(m_cell, m_cell.texel(t, m_factor));
            if (m_own[t] == 8) continue;
            bool any = false;
            for (std::size_t i = 0; i < 8; ++i) any = any || m_met[i * m_texels + t];
            for (std::size_t i = 0; i < 8; ++i) m_met[i * m_texels + t] = any;
        }
    }
    void markTexels(const BoxFrame& frame, unsigned probe) {
        const glm::vec3 from = frame.point(m_cell.probe[probe]), origin = frame.point(m_cell.origin);
        const glm::vec3 sx = frame.direction(m_cell.step[0]), sy = frame.direction(m_cell.step[1]),
                        sz = frame.direction(m_cell.step[2]);
        char* met = m_met.data() + probe * m_texels;
        for (int z = 0; z < m_factor; ++z)
            for (int y = 0; y < m_factor; ++y)
                for (int x = 0; x < m_factor; ++x, ++met)
                    if (meetsBox(from, origin + float(x) * sx + float(y) * sy + float(z) * sz)) *met = 1;
    }
    void markLink(const BoxFrame& frame, unsigned from, unsigned to) {
        if (!meetsBox(frame.point(m_cell.probe[from]), frame.point(m_cell.probe[to]))) return;
        for (const Link& known : m_links)
            if (known.from == from && known.to == to) return;
        m_links.push_back({from, to});
    }

    const MaskCell& m_cell;
    int m_factor;
    std::size_t m_texels;
    std::vector<char> m_met;  // [probe][texel]
    std::vector<std::size_t> m_own;
    std::vector<Link> m_links;
};

void setBit(std::uint8_t& bits, unsigned bit, bool on) {
    bits = std::uint8_t(on ? bits | 1u << bit : bits & ~(1u << bit));
}

}  // namespace

BoxFrame::BoxFrame(const OrientedBox& box, float margin) : m_centre(box.centre) {
    glm::mat3 axes;
    for (int axis = 0; axis < 3; ++axis) {
        const glm::vec3 half = box.halfAxes[axis];
        const float length = glm::length(half);
        // An axis without length stands across the other two.
        const glm::vec3 a = box.halfAxes[(axis + 1) % 3], b = box.halfAxes[(axis + 2) % 3];
        glm::vec3 along = length > 0 ? half / length : glm::cross(a, b);
        if (!(glm::length(along) > 0)) along[axis] = 1;
        axes[axis] = glm::normalize(along) * (std::max(length, kThinnest) + margin);
    }
    if (!(std::abs(glm::determinant(axes)) > 1e-20f))
        for (int axis = 0; axis < 3; ++axis) axes[axis] = glm::vec3(0), axes[axis][axis] = kThinnest + margin;
    const glm::mat3 inverse = glm::transpose(glm::inverse(axes));
    for (int axis = 0; axis < 3; ++axis) m_rows[axis] = inverse[axis];
}

glm::vec3 BoxFrame::direction(glm::vec3 world) const {
    return {glm::dot(m_rows[0], world), glm::dot(m_rows[1], world), glm::dot(m_rows[2], world)};
}

bool meetsBox(glm::vec3 from, glm::vec3 to) {
    // By separating axes: those of the box, and the crosses of these with the segment.
    const glm::vec3 middle = 0.5f * (from + to), half = 0.5f * (to - from), reach = glm::abs(half);
    if (std::abs(middle.x) > 1 + reach.x || std::abs(middle.y) > 1 + reach.y || std::abs(middle.z) > 1 + reach.z)
        return false;
    const glm::vec3 across = glm::abs(glm::cross(middle, half));
    return across.x <= reach.y + reach.z && across.y <= reach.z + reach.x && across.z <= reach.x + reach.y;
}

Bounds boundsOf(const OrientedBox& box) {
    const glm::vec3 reach = glm::abs(box.halfAxes[0]) + glm::abs(box.halfAxes[1]) + glm::abs(box.halfAxes[2]);
    return {box.centre - reach, box.centre + reach};
}

void setLink(std::span<std::uint8_t> links, const LinkSight& link) {
    setBit(links[link.from], 2 * link.axis + 1, link.open);
    setBit(links[link.to], 2 * link.axis, link.open);
}

Result<CellSight> seeCellAgain(const Tracer& tracer, const MaskCell& cell, int factor,
                               std::span<const OrientedBox> boxes, std::span<const std::uint8_t> seen) {
    const ChangedSegments changed(cell, factor, boxes);
    std::vector<Ray> rays;
    changed.forTexels([&](std::size_t i, std::size_t t) {
        rays.push_back(sightRay(cell.probe[i], cell.texel(t, factor), kReachBeyond * cell.texelSize));
    });
    for (const Link& link : changed.links()) rays.push_back(sightRay(cell.probe[link.from], cell.probe[link.to], 0.0f));
    std::vector<std::uint8_t> blocked(rays.size());
    if (auto traced = tracer.occluded(rays, blocked); !traced) return traced.error();
    CellSight sight{{seen.begin(), seen.end()}};
    sight.rays = rays.size();
    std::size_t ray = 0;
    changed.forTexels([&](std::size_t i, std::size_t t) { setBit(sight.seen[t], unsigned(i), !blocked[ray++]); });
    for (std::size_t t = 0; t < seen.size(); ++t)
        if (changed.own(t) < 8) sight.seen[t] = withOwnProbe(sight.seen[t], changed.own(t));
    for (const Link& link : changed.links())
        sight.links.push_back({std::size_t(cell.slot[link.from]), std::size_t(cell.slot[link.to]),
                               (link.to ^ link.from) >> 1, !blocked[ray++]});  // 1, 2, 4 -> 0, 1, 2
    return sight;
}

}  // namespace probegi
